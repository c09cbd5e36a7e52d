// libFuzzer's entry: scripts/fuzz builds it with clang. The target is in the environment, as
// libFuzzer has the arguments.
#include "targets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Target* const target = [] {
    const char* name = std::getenv("MARKERVP_FUZZ_TARGET");
    const auto& all = fuzz::targets();
    const auto found = std::find_if(all.begin(), all.end(), [name](const fuzz::Target& one) {
      return name && one.name == name;
    });
    if (found != all.end()) return &*found;
    std::cerr << "MARKERVP_FUZZ_TARGET names one of:";
    for (const fuzz::Target& one : all) std::cerr << " " << one.name;
    std::cerr << "\n";
    std::exit(2);
  }();
  fuzz::feed(*target, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

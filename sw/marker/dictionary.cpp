#include <marker/dictionary.h>
#include <marker/dictionary_words.h>

namespace marker {

namespace {

constexpr std::array<Code, dictionary_size> first_codes() {
  std::array<Code, dictionary_size> codes{};
  for (std::uint32_t id = 0; id < dictionary_size; ++id) {
    codes[id] = static_cast<Code>(dictionary_words::aruco_4x4[id]);
  }
  return codes;
}

}  // namespace

constexpr std::array<Code, dictionary_size> dictionary = first_codes();

}  // namespace marker

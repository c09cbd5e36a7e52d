// A PS program whose static object misbehaves when it is made or destroyed: the environment
// variable EARLY names the way. The entry function does nothing.
#include <hal/hal.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include <unistd.h>

namespace {

bool is_way(std::string_view way) {
  const char* const asked = std::getenv("EARLY");
  return asked && asked == way;
}

/// For who waits until it is time to end this.
void announce() {
  std::ofstream("here");
}

volatile bool flag;
int* volatile nowhere;

struct Object {
  Object() {
    if (is_way("fault")) *nowhere = 1;
    if (is_way("throw")) throw std::runtime_error("oops");
    if (is_way("terminate")) std::terminate();
    if (is_way("hal")) hal_read32(0x4120'0000);
    if (is_way("exit")) ::_exit(0);
    if (is_way("chdir")) static_cast<void>(!::chdir("/"));
    if (is_way("spin")) spin();
    if (is_way("sleep")) announce();
    while (is_way("sleep")) ::pause();
  }
  ~Object() {
    if (is_way("late fault")) *nowhere = 1;
    if (is_way("late exit")) std::exit(0);
    if (is_way("late spin")) spin();
  }
  static void spin() {
    announce();
    while (!flag) continue;
  }
};
Object object;

const char* const names[] = {"only"};

std::uint32_t count() {
  return is_way("count") ? 4'000'000'000 : is_way("wrong count") ? 4'000 : 0;
}

}  // namespace

extern "C" {
// Not constant: the environment decides.
__attribute__((visibility("default"))) hal_program description asm("hal_program_info") = {
    HAL_ABI, "early", [] { return 0; }, names, count(), nullptr, 0, nullptr, 0};
}

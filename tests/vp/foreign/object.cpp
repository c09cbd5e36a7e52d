// A shared object whose functions end or damage the process.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace {

volatile int* volatile nowhere = nullptr;

}  // namespace

extern "C" void write_to_null() {
  *nowhere = 1;
}
extern "C" void end_the_process() {
  std::exit(0);
}
extern "C" void throw_an_error() {
  throw std::runtime_error("thrown by an object");
}
/// Writes beyond what it was given.
extern "C" void damage(std::uintptr_t* place) {
  place[1] = 8;
}
extern "C" void do_nothing() {}

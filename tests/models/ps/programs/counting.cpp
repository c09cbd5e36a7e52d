// Static variables of every kind; publishes what they were when it started.
#include <hal/hal.h>

namespace {

int data = 5;
int bss;
int array[20'000] = {1};
const char* const* pointer = nullptr;
int constructed = [] { return 17; }();

struct Object {
  Object() : value(23) {}
  ~Object() { value = -1; }
  int value;
};
Object object;

int& local() {
  static int value = constructed + 1;
  return value;
}

const char* const work[] = {"step"};

int entry() {
  const int seen[] = {data++,        bss++,          array[19'999]++, pointer == nullptr,
                      constructed++, object.value++, local()++};
  pointer = work;
  hal_work(0, 10);
  hal_publish(0, seen, sizeof seen);
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "counting", entry, work, 1, nullptr, 0, nullptr, 0};
}

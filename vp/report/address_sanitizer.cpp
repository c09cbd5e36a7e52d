// Only in builds with the address sanitizer. libsystemc 2.3.4 tells the sanitizer when it enters a
// thread's stack, but not the bounds of the main stack when it returns, nor that a thread has
// ended. A throw on the main stack then leaves poisoned memory behind, which is later reported as
// an overflow by mistake. This sets the bounds right before a throw, and for the time of a throw on
// a stack of run_on_stack(), of which SystemC knows nothing.
#if defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>
#include <pthread.h>
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace {

struct Stack {
  void* bottom = nullptr;
  std::size_t size = 0;

  bool contains(const void* address) const {
    const auto* byte = static_cast<const char*>(address);
    return byte >= bottom && byte < static_cast<const char*>(bottom) + size;
  }
};

Stack stack_of_main() {
  Stack stack;
  pthread_attr_t attributes;
  pthread_getattr_np(pthread_self(), &attributes);
  pthread_attr_getstack(&attributes, &stack.bottom, &stack.size);
  pthread_attr_destroy(&attributes);
  return stack;
}

const Stack main_stack = stack_of_main();

/// Those of run_on_stack(), the latest ones: a place for each core, and for objects.
std::array<Stack, 8> own_stacks;
std::size_t noted = 0;

/// Returns the bounds that the sanitizer had before.
__attribute__((no_sanitize("address"))) Stack set_bounds(const Stack& stack) {
  Stack before;
  const void* bottom = nullptr;
  __sanitizer_start_switch_fiber(nullptr, stack.bottom, stack.size);
  __sanitizer_finish_switch_fiber(nullptr, &bottom, &before.size);
  before.bottom = const_cast<void*>(bottom);
  return before;
}

}  // namespace

/// A visit to a stack begins (vp/foreign/own_stack.cpp). What was left on it without a return is
/// poisoned memory, too.
extern "C" void markervp_note_stack(void* first, std::size_t size) {
  __asan_unpoison_memory_region(first, size);
  const bool known = std::any_of(own_stacks.begin(), own_stacks.end(), [&](const Stack& stack) {
    return stack.bottom == first && stack.size == size;
  });
  if (known) return;
  own_stacks[noted % own_stacks.size()] = {first, size};
  ++noted;
}

extern "C" __attribute__((no_sanitize("address"))) void __asan_handle_no_return() {
  static const auto original =
      reinterpret_cast<void (*)()>(dlsym(RTLD_NEXT, "__asan_handle_no_return"));
  const void* const here = __builtin_frame_address(0);
  if (main_stack.contains(here)) set_bounds(main_stack);
  for (const Stack& stack : own_stacks) {
    if (!stack.contains(here)) continue;
    const Stack before = set_bounds(stack);
    original();
    set_bounds(before);
    return;
  }
  original();
}
#endif

// Only in builds with the address sanitizer. libsystemc 2.3.4 tells the sanitizer when it enters a
// thread's stack, but not the bounds of the main stack when it returns, nor that a thread has
// ended. A throw on the main stack then leaves poisoned memory behind, which is later reported as
// an overflow by mistake. This sets the bounds right before a throw.
#if defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include <cstddef>

namespace {

struct Stack {
  void* bottom = nullptr;
  std::size_t size = 0;

  Stack() {
    pthread_attr_t attributes;
    pthread_getattr_np(pthread_self(), &attributes);
    pthread_attr_getstack(&attributes, &bottom, &size);
    pthread_attr_destroy(&attributes);
  }
  bool contains(const void* address) const {
    const auto* byte = static_cast<const char*>(address);
    return byte >= bottom && byte < static_cast<const char*>(bottom) + size;
  }
};

const Stack main_stack;

}  // namespace

extern "C" __attribute__((no_sanitize("address"))) void __asan_handle_no_return() {
  static const auto original =
      reinterpret_cast<void (*)()>(dlsym(RTLD_NEXT, "__asan_handle_no_return"));
  if (main_stack.contains(__builtin_frame_address(0))) {
    __sanitizer_start_switch_fiber(nullptr, main_stack.bottom, main_stack.size);
    __sanitizer_finish_switch_fiber(nullptr, nullptr, nullptr);
  }
  original();
}
#endif

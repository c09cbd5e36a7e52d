// The stacks of the application's threads: where they end, and one beside each for its faults.

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "client.h"

namespace shim {

namespace {

/// Enough to walk the stack of a thread and to look up its lines.
constexpr std::size_t signal_stack_size = 256 * 1024;

/// What is known of a thread.
struct Stack {
  std::uintptr_t end;  ///< its lowest address; 0: not known
  std::size_t size;
};
thread_local Stack stack __attribute__((tls_model("initial-exec")));

/// What pthread_create() is to call; in front of the stack for signals.
struct Start {
  void* (*call)(void*);
  void* argument;
};
pthread_key_t memory_of_thread;

void* new_memory() {
  void* const memory = REAL(mmap)(nullptr, signal_stack_size, PROT_READ | PROT_WRITE,
                                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

// One that is there is that of a sanitizer, which takes it down again.
void use_for_signals(void* memory) {
  stack_t now{};
  if (::sigaltstack(nullptr, &now) != 0 || (now.ss_flags & SS_DISABLE) == 0) return;
  stack_t next{};
  next.ss_sp = static_cast<char*>(memory) + sizeof(Start);
  next.ss_size = signal_stack_size - sizeof(Start);
  ::sigaltstack(&next, nullptr);
}

void release(void* memory) {
  stack_t now{};
  if (::sigaltstack(nullptr, &now) == 0 &&
      now.ss_sp == static_cast<char*>(memory) + sizeof(Start)) {
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    ::sigaltstack(&none, nullptr);
  }
  REAL(munmap)(memory, signal_stack_size);
}

void note_stack() {
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return;
  void* end = nullptr;
  std::size_t size = 0;
  if (::pthread_attr_getstack(&attributes, &end, &size) == 0)
    stack = {reinterpret_cast<std::uintptr_t>(end), size};
  ::pthread_attr_destroy(&attributes);
}

void* begin_thread(void* memory) {
  const Start start = *static_cast<Start*>(memory);
  ::pthread_setspecific(memory_of_thread, memory);
  use_for_signals(memory);
  note_stack();
  return start.call(start.argument);
}

bool is_overflow(std::uintptr_t address, std::uintptr_t pointer) {
  // What a large local variable may reach beyond the end, and how near a frame comes to it.
  constexpr std::uintptr_t beyond = 64 << 20, reach = 1 << 20, near = 64 << 10;
  return stack.end != 0 && address < stack.end + near && pointer < stack.end + reach &&
         pointer + beyond > stack.end && address + reach > pointer;
}

}  // namespace

void prepare_stack() {
  ::pthread_key_create(&memory_of_thread, release);
  note_stack();
  rlimit limit{};  // the C library leaves a page of it out
  if (::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    stack.size = limit.rlim_cur;
  if (void* const memory = new_memory()) use_for_signals(memory);
}

void describe_overflow(std::uintptr_t address, std::uintptr_t stack_pointer, char* text,
                       std::size_t size) {
  text[0] = '\0';
  if (!is_overflow(address, stack_pointer)) return;
  constexpr std::size_t longest_name = 16;  // prctl(2)
  char name[longest_name] = "";
  ::prctl(PR_GET_NAME, name);
  if (REAL(syscall)(SYS_gettid) == ::getpid()) {
    ::snprintf(text, size,
               "overflowed the stack of its main thread, which may have %zu KiB here (ulimit -s)",
               stack.size / 1024);
  } else {
    ::snprintf(text, size,
               "overflowed the stack of its thread '%s', which has %zu KiB "
               "(pthread_attr_setstacksize())",
               name, stack.size / 1024);
  }
}

}  // namespace shim

#pragma GCC visibility push(default)
extern "C" {

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*call)(void*),
                   void* argument) noexcept {
  void* const memory = shim::is_application() ? shim::new_memory() : nullptr;
  if (!memory) return REAL(pthread_create)(thread, attributes, call, argument);
  *static_cast<shim::Start*>(memory) = {call, argument};
  const int error = REAL(pthread_create)(thread, attributes, shim::begin_thread, memory);
  if (error != 0) REAL(munmap)(memory, shim::signal_stack_size);
  return error;
}

}  // extern "C"
#pragma GCC visibility pop

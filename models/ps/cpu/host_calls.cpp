// Calls of the C library that would end the whole process, or double it. A program that makes one
// is ended as by a fault; for everybody else they are what they always are.
//
// Defined here rather than wrapped when a program is linked: the loader looks into the executable
// first, so it holds for whatever a program consists of. What the C library calls inside itself
// (err(), daemon()) does not come here, and neither do raw system calls and the exec() family.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <ps/cpu/fault_trap.h>
#include <ps/cpu/host_calls.h>
#include <cstdlib>

namespace {

/// The function of that name which the loader would have found without this file.
template <class Function>
Function* the_real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

template <class... Argument>
[[noreturn]] void end(const char* name, Argument... argument) {
  static_cast<void>((the_real<void(Argument...)>(name)(argument...), 0));
  std::abort();
}

void leave_program(const char* name, int code) {
  if (ps::FaultTrap::can_leave()) ps::FaultTrap::leave(ps::Fault::Kind::exit, name, code);
}

// Without a look at the loader's tables: it is called in signal handlers.
[[noreturn]] void end_process(int code) {
  while (true) ::syscall(SYS_exit_group, code);
}

pid_t fork_by(const char* name) {
  if (ps::FaultTrap::can_leave()) ps::FaultTrap::leave(ps::Fault::Kind::forbidden, name);
  return the_real<pid_t()>("fork")();
}

}  // namespace

namespace ps {

void use_host_calls() {}

}  // namespace ps

extern "C" {

[[noreturn]] void exit(int code) noexcept {
  leave_program("exit", code);
  end("exit", code);
}

[[noreturn]] void _exit(int code) {
  leave_program("_exit", code);
  end_process(code);
}

[[noreturn]] void _Exit(int code) noexcept {
  leave_program("_Exit", code);
  end_process(code);
}

[[noreturn]] void quick_exit(int code) noexcept {
  leave_program("quick_exit", code);
  end("quick_exit", code);
}

pid_t fork(void) noexcept {
  return fork_by("fork");
}

// A child that shares its parent's stack cannot pass through here: it gets a stack of its own.
pid_t vfork(void) noexcept {
  return fork_by("vfork");
}

[[noreturn]] void pthread_exit(void* value) {
  if (ps::FaultTrap::can_leave()) {
    ps::FaultTrap::leave(ps::Fault::Kind::forbidden, "pthread_exit");
  }
  end("pthread_exit", value);
}

}  // extern "C"

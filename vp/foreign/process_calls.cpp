// Calls of the C library that would end, replace or double the whole process. Foreign code that
// makes one is ended as by a fault; for all other code they are what they always are.
//
// Defined here rather than wrapped when a program is linked: the loader looks into the executable
// first, so it holds for whatever a program consists of. What the C library calls inside itself
// (err(), daemon()) does not come here, nor does a system call of the code's own machine
// instructions.
#include <alloca.h>
#include <dlfcn.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <cstdarg>
#include <cstdlib>

#include <vp/fault_trap.h>
#include <vp/kernel.h>

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
  vp::FaultTrap::leave_if_foreign(vp::Fault::Kind::exit, name, code);
}

void forbid(const char* name) {
  vp::FaultTrap::leave_if_foreign(vp::Fault::Kind::forbidden, name);
}

pid_t fork_by(const char* name) {
  forbid(name);
  return the_real<pid_t()>("fork")();
}

/// What the functions below do.
bool is_forbidden(long number) {
  switch (number) {
    case SYS_exit:
    case SYS_exit_group:
    case SYS_execve:
    case SYS_execveat:
#if defined(SYS_fork)
    case SYS_fork:
    case SYS_vfork:
#endif
      return true;
    default:
      return false;
  }
}

/// A signal whose default action is taken, which ends or stops the process.
bool is_fatal(int signal) {
  if (signal == SIGKILL || signal == SIGSTOP) return true;
  struct sigaction action {};
  if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return false;
  return signal != SIGCHLD && signal != SIGURG && signal != SIGWINCH && signal != SIGCONT;
}

/// The arguments of execl() and its relatives as an array that `call` gets, with the rest behind
/// the null pointer.
template <class Call>
int with_arguments(const char* first, std::va_list rest, Call call) {
  std::va_list counted;
  va_copy(counted, rest);
  std::size_t count = first ? 1 : 0;
  while (first && va_arg(counted, char*)) ++count;
  va_end(counted);
  auto** const arguments = static_cast<char**>(alloca((count + 1) * sizeof(char*)));
  arguments[0] = const_cast<char*>(first);
  for (std::size_t i = 1; i <= count; ++i) arguments[i] = va_arg(rest, char*);
  return call(arguments);
}

/// A thread's signals, but never those of a fault: with these blocked, the host's kernel would end
/// the process at the next fault, and nothing could be said.
int block(const char* name, int how, const sigset_t* signals, sigset_t* before) {
  sigset_t allowed;
  if (signals && how != SIG_UNBLOCK) {
    allowed = *signals;
    for (const int fault : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP})
      sigdelset(&allowed, fault);
    signals = &allowed;
  }
  return the_real<int(int, const sigset_t*, sigset_t*)>(name)(how, signals, before);
}

using Execute = int(const char*, char* const*);
using ExecuteWith = int(const char*, char* const*, char* const*);

}  // namespace

void vp::run_exit_handlers(int code) {
  end("exit", code);
}

extern "C" {

void exit(int code) noexcept {
  leave_program("exit", code);
  end("exit", code);
}

void _exit(int code) {
  leave_program("_exit", code);
  vp::end_process(code);
}

void _Exit(int code) noexcept {
  leave_program("_Exit", code);
  vp::end_process(code);
}

void quick_exit(int code) noexcept {
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

void pthread_exit(void* value) {
  forbid("pthread_exit");
  end("pthread_exit", value);
}

int raise(int signal) noexcept {
  if (is_fatal(signal)) forbid("raise");
  return the_real<int(int)>("raise")(signal);
}

// Its own process, its group, and all.
int kill(pid_t process, int signal) noexcept {
  const bool itself = process == ::getpid() || process == 0 || process == -1 ||
                      (process < -1 && -process == ::getpgrp());
  if (itself && signal != 0 && is_fatal(signal)) forbid("kill");
  return static_cast<int>(vp::call_kernel(SYS_kill, process, signal));
}

int sigprocmask(int how, const sigset_t* signals, sigset_t* before) noexcept {
  return block("sigprocmask", how, signals, before);
}

int pthread_sigmask(int how, const sigset_t* signals, sigset_t* before) noexcept {
  return block("pthread_sigmask", how, signals, before);
}

int execve(const char* path, char* const arguments[], char* const environment[]) noexcept {
  forbid("execve");
  return the_real<ExecuteWith>("execve")(path, arguments, environment);
}

int execv(const char* path, char* const arguments[]) noexcept {
  forbid("execv");
  return the_real<Execute>("execv")(path, arguments);
}

int execvp(const char* file, char* const arguments[]) noexcept {
  forbid("execvp");
  return the_real<Execute>("execvp")(file, arguments);
}

int execvpe(const char* file, char* const arguments[], char* const environment[]) noexcept {
  forbid("execvpe");
  return the_real<ExecuteWith>("execvpe")(file, arguments, environment);
}

int execl(const char* path, const char* first, ...) noexcept {
  forbid("execl");
  std::va_list rest;
  va_start(rest, first);
  const int result = with_arguments(
      first, rest, [path](char** list) { return the_real<Execute>("execv")(path, list); });
  va_end(rest);
  return result;
}

int execlp(const char* file, const char* first, ...) noexcept {
  forbid("execlp");
  std::va_list rest;
  va_start(rest, first);
  const int result = with_arguments(
      first, rest, [file](char** list) { return the_real<Execute>("execvp")(file, list); });
  va_end(rest);
  return result;
}

int execle(const char* path, const char* first, ...) noexcept {
  forbid("execle");
  std::va_list rest;
  va_start(rest, first);
  const int result = with_arguments(first, rest, [path, &rest](char** list) {
    return the_real<ExecuteWith>("execve")(path, list, va_arg(rest, char**));
  });
  va_end(rest);
  return result;
}

long syscall(long number, ...) noexcept {
  if (is_forbidden(number)) forbid("syscall");
  std::va_list arguments;
  va_start(arguments, number);
  long values[6];
  for (long& value : values) value = va_arg(arguments, long);
  va_end(arguments);
  return vp::call_kernel(number, values[0], values[1], values[2], values[3], values[4], values[5]);
}

}  // extern "C"

// The application's end of the socket, and how it begins.
#include "client.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace shim {

namespace {

bool is_one = false;   ///< this process is the application
bool is_copy = false;  ///< by fork()
thread_local char own __attribute__((tls_model("initial-exec")));  ///< each thread has another
const char* tree = nullptr;  ///< folder(), whatever becomes of the environment
const char* user = nullptr;  ///< `own` of the thread that uses devices
bool has_user = false;       ///< otherwise it is the first one, for its time

void send(const Request& request, const char* text) {
  iovec parts[2] = {{const_cast<Request*>(&request), sizeof request},
                    {const_cast<char*>(text), text ? ::strlen(text) + 1 : 0}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = text ? 2 : 1;
  while (::sendmsg(linux_app::socket_descriptor, &message, MSG_NOSIGNAL) < 0 && errno == EINTR)
    continue;
}

/// The platform is gone: nobody is left who could be told.
[[noreturn]] void leave() {
  ::syscall(SYS_exit_group, 1);
  __builtin_unreachable();
}

Reply receive() {
  Reply reply;
  while (true) {
    const ssize_t count = ::recv(linux_app::socket_descriptor, &reply, sizeof reply, 0);
    if (count == static_cast<ssize_t>(sizeof reply)) return reply;
    if (count >= 0 || errno != EINTR) leave();
  }
}

void tell_where() {
  char text[linux_app::longest_text];
  locate(text, sizeof text);
  send({What::place, 0, 0, 0, 0}, text);
}

}  // namespace

NoSignals::NoSignals() {
  sigset_t all;
  ::sigfillset(&all);
  for (const int fault : faults) ::sigdelset(&all, fault);
  ::pthread_sigmask(SIG_SETMASK, &all, &before_);
}

NoSignals::~NoSignals() {
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

const char* folder() {
  return is_one ? tree : ::getenv(linux_app::folder_variable);
}

bool is_application() {
  return is_one;
}

bool is_in_lock_step() {
  return is_one && !is_copy && user == &own;
}

void take_devices() {
  if (!has_user && !is_copy) user = &own;
  has_user = true;
}

namespace {

void check_caller() {
  if (is_copy)
    fail(
        "a copy of the application, made by fork(), uses its devices: let the process that was "
        "started use them, the other one has the run's time no more");
  if (user != &own)
    fail(
        "a second thread of the application uses its devices: the order of both would be the "
        "host's, and each run another one; let one thread do it");
}

Reply exchange(const Request& request, const char* text) {
  const int error = errno;
  send(request, text);
  Reply reply = receive();
  while (reply.kind == Reply::Kind::where) {
    tell_where();
    reply = receive();
  }
  errno = error;
  note_interrupts(reply);
  return reply;
}

}  // namespace

Reply ask(What what, std::uint64_t a, std::uint64_t b, std::uint64_t c, const char* text) {
  check_caller();
  const NoSignals none;
  return exchange({what, 0, a, b, c}, text);
}

Reply ask_in_handler(What what, std::uint64_t a, std::uint64_t b, std::uint32_t size) {
  check_caller();
  return exchange({what, size, a, b, 0}, nullptr);
}

void warn_of_invalid(const char* format, ...) {
  char text[linux_app::longest_text];
  va_list values;
  va_start(values, format);
  ::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  ask(What::refused, 0, 0, 0, text);
  errno = EINVAL;
}

void fail(const char* format, ...) {
  char text[linux_app::longest_text];
  va_list values;
  va_start(values, format);
  const int used = ::vsnprintf(text, sizeof text / 2, format, values);
  va_end(values);
  std::size_t length = static_cast<std::size_t>(used) < sizeof text / 2 ? used : sizeof text / 2;
  text[length++] = '\n';
  locate(text + length, sizeof text - length);
  const NoSignals none;
  send({What::failure, 0, 0, 0, 0}, text);
  while (true) ::pause();  // the platform ends it
}

void tell_death(int signal, std::uint64_t address) {
  char text[linux_app::longest_text];
  locate(text, sizeof text);
  send({What::died, 0, static_cast<std::uint64_t>(signal), address, 0}, text);
}

namespace {

bool is_open_socket() {
  int type = 0;
  socklen_t size = sizeof type;
  return ::getsockopt(linux_app::socket_descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
}

// In what the application starts by exec() the socket is closed.
__attribute__((constructor)) void begin() {
  if (!::getenv(linux_app::folder_variable) || !is_open_socket()) return;
  ::fcntl(linux_app::socket_descriptor, F_SETFD, FD_CLOEXEC);
  ::fcntl(linux_app::memory_descriptor, F_SETFD, FD_CLOEXEC);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  is_one = true;
  tree = ::strdup(::getenv(linux_app::folder_variable));
  user = &own;
  ::pthread_atfork(nullptr, nullptr, [] { is_copy = true; });
  // A line is read when it is written, though nobody looks from a terminal.
  ::setvbuf(stdout, nullptr, _IOLBF, 0);
  prepare_to_locate();
  catch_faults();
  const Reply hello = ask(What::hello);
  set_memory(hello.a, hello.b);
}

}  // namespace

}  // namespace shim

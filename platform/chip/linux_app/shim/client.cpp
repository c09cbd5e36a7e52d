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

bool is_one = false;  ///< this process is the application
int socket = linux_app::socket_descriptor, memory = linux_app::memory_descriptor;
thread_local char own __attribute__((tls_model("initial-exec")));  ///< each thread has another
const char* tree = nullptr;  ///< folder(), whatever becomes of the environment
const char* user = nullptr;  ///< `own` of the thread that uses devices
bool has_user = false;       ///< otherwise it is the first one, for its time

void send(Request request, const char* text) {
  request.process = ::getpid();
  iovec parts[2] = {{&request, sizeof request},
                    {const_cast<char*>(text), text ? ::strlen(text) + 1 : 0}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = text ? 2 : 1;
  while (::sendmsg(socket, &message, MSG_NOSIGNAL) < 0 && errno == EINTR) continue;
}

/// The platform is gone, or cannot be reached any more; then it ends this process.
[[noreturn]] void leave(int error) {
  if (error != EBADF && error != ENOTSOCK && error != ENOTCONN) REAL(syscall)(SYS_exit_group, 1);
  ::dprintf(
      STDERR_FILENO,
      "markervp: '%s' closed or replaced the descriptor %d, by which it reaches the platform, "
      "with a system call of its own: call functions of the C library, which leave it "
      "alone\n",
      program_invocation_short_name, socket);
  while (true) ::pause();
}

Reply receive() {
  Reply reply;
  while (true) {
    const ssize_t count = ::recv(socket, &reply, sizeof reply, 0);
    if (count == static_cast<ssize_t>(sizeof reply)) return reply;
    if (count >= 0) leave(0);
    if (errno != EINTR) leave(errno);
  }
}

void tell_where() {
  char text[linux_app::longest_text];
  locate(text, sizeof text);
  send({What::place, 0, 0, 0, 0, 0}, text);
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
  return is_one && user == &own && may_take_turn();
}

void take_devices() {
  if (!has_user) user = &own;
  has_user = true;
}

void become_user() {
  user = &own;
}

int* own_descriptor(int descriptor) {
  if (!is_one) return nullptr;
  return descriptor == socket ? &socket : descriptor == memory ? &memory : nullptr;
}

int memory_file() {
  return memory;
}

namespace {

void begin_turn() {
  if (user != &own)
    fail(
        "a second thread of the application uses its devices: the order of both would be the "
        "host's, and each run another one; let one thread do it");
  if (take_turn()) return;
  fail(
      "the application and a copy of it, made by fork(), both use its devices: the order of both "
      "would be the host's, and each run another one; let one of them do it, or wait for the end "
      "of the copy with waitpid() before you use them again");
}

/// In a turn of this process'.
Reply question(const Request& request, const char* text) {
  send(request, text);
  Reply reply = receive();
  while (reply.kind == Reply::Kind::where) {
    tell_where();
    reply = receive();
  }
  note_interrupts(reply);
  return reply;
}

Reply exchange(const Request& request, const char* text) {
  const int error = errno;
  if (had_other_time())
    question({What::refused, 0, 0, 0, 0, 0},
             "a copy of the application, made by fork(), uses its devices, and asked for time "
             "before, which was the host's and not the run's: let it use a device first, or call "
             "daemon() or setsid()");
  const Reply reply = question(request, text);
  end_turn(reply);
  errno = error;
  return reply;
}

}  // namespace

Reply ask(What what, std::uint64_t a, std::uint64_t b, std::uint64_t c, const char* text) {
  const NoSignals none;
  begin_turn();
  return exchange({what, 0, 0, a, b, c}, text);
}

Reply ask_in_handler(What what, std::uint64_t a, std::uint64_t b, std::uint32_t size) {
  begin_turn();
  return exchange({what, size, 0, a, b, 0}, nullptr);
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
  send({What::failure, 0, 0, 0, 0, 0}, text);
  while (true) ::pause();  // the platform ends it
}

void tell_death(int signal, std::uint64_t address, const char* reason) {
  char text[linux_app::longest_text];
  const int used = ::snprintf(text, sizeof text, "%s\n", reason);
  locate(text + used, sizeof text - static_cast<std::size_t>(used));
  send({What::died, 0, 0, static_cast<std::uint64_t>(signal), address, 0}, text);
}

namespace {

bool is_open_socket() {
  int type = 0;
  socklen_t size = sizeof type;
  return ::getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
}

// In what the application starts by exec() the socket is closed.
__attribute__((constructor)) void begin() {
  const char* const folder = ::getenv(linux_app::folder_variable);
  if (!folder || !is_open_socket()) return;
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  ::fcntl(memory, F_SETFD, FD_CLOEXEC);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  is_one = true;
  tree = ::strdup(folder);
  user = &own;
  // A line is read when it is written, although it does not go to a terminal.
  ::setvbuf(stdout, nullptr, _IOLBF, 0);
  prepare_to_locate();
  prepare_turns();
  prepare_stack();
  catch_faults();
  const Reply hello = ask(What::hello);
  set_memory(hello.a, hello.b);
}

}  // namespace

}  // namespace shim

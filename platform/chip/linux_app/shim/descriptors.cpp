// Descriptors of the platform's files, and those that the shim needs itself, which the application
// does not see.

#include <errno.h>
#include <fcntl.h>
#include <linux/close_range.h>
#include <stdarg.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "client.h"
#include "opens.h"

namespace shim {

namespace {

constexpr int most_descriptors = 4096;
Opens table;
std::uint8_t by_descriptor[most_descriptors];  ///< number in `table` plus 1; 0: another file

}  // namespace

Opens& opens() {
  return table;
}

Open* open_at(int descriptor) {
  if (descriptor < 0 || descriptor >= most_descriptors || by_descriptor[descriptor] == 0)
    return nullptr;
  return &table[by_descriptor[descriptor] - 1];
}

Open& new_open(Open::Kind kind) {
  for (Open& open : table) {
    if (open.kind != Open::Kind::none) continue;
    open = {};
    open.kind = kind;
    open.event = -1;
    return open;
  }
  fail("the application has more than %d device files and attributes open: close them", most_open);
}

void give(int descriptor, Open& open) {
  if (descriptor >= most_descriptors)
    fail("a device file would have the descriptor %d: close others, %d is the last that is taken",
         descriptor, most_descriptors - 1);
  by_descriptor[descriptor] = static_cast<std::uint8_t>(&open - table + 1);
  ++open.descriptors;
}

void forget(int descriptor) {
  Open* const open = open_at(descriptor);
  if (!open) return;
  by_descriptor[descriptor] = 0;
  if (--open->descriptors != 0) return;
  if (open->event >= 0) REAL(close)(open->event);
  open->kind = Open::Kind::none;
}

int* hidden(int descriptor) {
  if (!is_application()) return nullptr;
  if (int* const own = own_descriptor(descriptor)) return own;
  for (Open& open : table) {
    if (open.kind == Open::Kind::uio && open.event == descriptor) return &open.event;
  }
  return nullptr;
}

int copy_out_of_the_way(int descriptor) {
  const int copy = REAL(fcntl)(descriptor, F_DUPFD_CLOEXEC, linux_app::memory_descriptor + 1);
  if (copy >= 0) return copy;
  const int error = errno;
  REAL(close)(STDIN_FILENO);  // for the file that says where the application is
  fail(
      "no descriptor above %d is left for the platform (%s): the application has too many, or "
      "lowered its own limit (RLIMIT_NOFILE)",
      linux_app::memory_descriptor, ::strerror(error));
}

namespace {

void also_give(int descriptor, int other) {
  Open* const open = open_at(descriptor);
  if (open && other >= 0) give(other, *open);
}

/// The application is about to give a number to another file: what has it moves away.
void clear(int descriptor) {
  int* const ours = hidden(descriptor);
  if (!ours) return;
  *ours = copy_out_of_the_way(descriptor);
  REAL(close)(descriptor);
}

constexpr unsigned none = ~0u;

/// The next number from this one on that is hidden.
unsigned next_hidden(unsigned from) {
  for (int number = linux_app::socket_descriptor; number < most_descriptors; ++number) {
    if (static_cast<unsigned>(number) >= from && hidden(number))
      return static_cast<unsigned>(number);
  }
  return none;
}

/// close_range() around those that are hidden.
int close_others(unsigned first, unsigned last, int flags) {
  const bool closes = (flags & CLOSE_RANGE_CLOEXEC) == 0;
  for (unsigned i = first; closes && i <= last && i < most_descriptors; ++i)
    forget(static_cast<int>(i));
  while (true) {
    const unsigned kept = next_hidden(first);
    const bool is_last = kept == none || kept > last;
    const unsigned end = is_last ? last : kept - 1;
    if (first <= end && REAL(syscall)(SYS_close_range, first, end, flags) != 0) return -1;
    if (is_last || kept == last) return 0;
    first = kept + 1;
  }
}

int no_descriptor() {
  errno = EBADF;
  return -1;
}

}  // namespace

}  // namespace shim

#pragma GCC visibility push(default)
extern "C" {

int close_range(unsigned first, unsigned last, int flags) noexcept {
  if (!shim::is_application() || first > last) return REAL(close_range)(first, last, flags);
  return shim::close_others(first, last, flags);
}

void closefrom(int first) noexcept {
  ::close_range(first < 0 ? 0 : static_cast<unsigned>(first), ~0u, 0);
}

int dup(int descriptor) noexcept {
  if (shim::hidden(descriptor)) return shim::no_descriptor();
  const int other = REAL(dup)(descriptor);
  shim::also_give(descriptor, other);
  return other;
}

int dup2(int descriptor, int other) noexcept {
  if (shim::hidden(descriptor)) return shim::no_descriptor();
  shim::clear(other);
  const int result = REAL(dup2)(descriptor, other);
  if (result < 0 || descriptor == other) return result;
  shim::forget(other);
  shim::also_give(descriptor, other);
  return result;
}

int dup3(int descriptor, int other, int flags) noexcept {
  if (shim::hidden(descriptor)) return shim::no_descriptor();
  shim::clear(other);
  const int result = REAL(dup3)(descriptor, other, flags);
  if (result < 0) return result;
  shim::forget(other);
  shim::also_give(descriptor, other);
  return result;
}

#define FCNTL(name)                                                                            \
  int name(int descriptor, int command, ...) {                                                 \
    va_list values;                                                                            \
    va_start(values, command);                                                                 \
    void* const value = va_arg(values, void*);                                                 \
    va_end(values);                                                                            \
    const int result = REAL(name)(descriptor, command, value);                                 \
    if (command == F_DUPFD || command == F_DUPFD_CLOEXEC) shim::also_give(descriptor, result); \
    return result;                                                                             \
  }
FCNTL(fcntl)
FCNTL(fcntl64)

}  // extern "C"
#pragma GCC visibility pop

// Time: it is the simulation's for the thread that uses devices. What other threads wait for is the
// host's.
#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "client.h"

namespace shim {

namespace {

constexpr std::uint64_t ns_per_s = 1'000'000'000, ns_per_ms = 1'000'000, ns_per_us = 1'000;
constexpr std::uint64_t longest_ns = 1'000'000'000 * ns_per_s;

bool is_time(const timespec& time) {
  return time.tv_sec >= 0 && time.tv_nsec >= 0 && time.tv_nsec < static_cast<long>(ns_per_s);
}

std::uint64_t ns_of(std::uint64_t seconds, std::uint64_t ns) {
  return seconds > longest_ns / ns_per_s ? longest_ns : seconds * ns_per_s + ns;
}
std::uint64_t ns_of(const timespec& time) {
  return ns_of(static_cast<std::uint64_t>(time.tv_sec), static_cast<std::uint64_t>(time.tv_nsec));
}

timespec time_of(std::uint64_t ns) {
  return {static_cast<time_t>(ns / ns_per_s), static_cast<long>(ns % ns_per_s)};
}

void sleep_for(std::uint64_t ns) {
  ask(What::sleep, ns);
}

std::uint64_t sum_of(const Reply& reply) {
  std::uint64_t sum = 0;
  for (const std::uint32_t count : reply.interrupts) sum += count;
  return sum;
}

/// What poll() and its relatives do: `look` looks without waiting and tells what is ready, `block`
/// waits as long as the host does. Between two looks simulated time passes, up to an interrupt.
template <class Look, class Block>
int wait_until(std::uint64_t timeout_ns, Look look, Block block) {
  Reply reply = ask(What::wait, 0, 0);
  const std::uint64_t end =
      timeout_ns == linux_app::forever ? timeout_ns : reply.now_ns + timeout_ns;
  while (true) {
    const int ready = look();
    if (ready != 0 || reply.now_ns >= end) return ready;
    if (end == linux_app::forever && !may_be_interrupted()) return block();
    reply = ask(What::wait, end, sum_of(reply));
  }
}

std::uint64_t timeout_of(int ms) {
  return ms < 0 ? linux_app::forever : static_cast<std::uint64_t>(ms) * ns_per_ms;
}
std::uint64_t timeout_of(const timespec* time) {
  return time ? ns_of(*time) : linux_app::forever;
}

/// select() with sets that it changes at each look.
class Sets {
 public:
  Sets(fd_set* read, fd_set* write, fd_set* except) : sets_{read, write, except} {
    for (unsigned i = 0; i < 3; ++i) {
      if (sets_[i]) asked_[i] = *sets_[i];
    }
  }
  template <class Select>
  int look(Select select) {
    for (unsigned i = 0; i < 3; ++i) {
      if (sets_[i]) *sets_[i] = asked_[i];
    }
    return select(sets_[0], sets_[1], sets_[2]);
  }

 private:
  fd_set* sets_[3];
  fd_set asked_[3];
};

constexpr timespec at_once{0, 0};

}  // namespace

}  // namespace shim

using shim::ask;
using shim::is_in_lock_step;
using shim::What;

#pragma GCC visibility push(default)
extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (!is_in_lock_step()) return REAL(clock_gettime)(clock, time);
  *time = shim::time_of(ask(What::clock).now_ns);
  return 0;
}

int gettimeofday(timeval* time, void* zone) noexcept {
  if (!is_in_lock_step()) return REAL(gettimeofday)(time, zone);
  const timespec now = shim::time_of(ask(What::clock).now_ns);
  *time = {now.tv_sec, now.tv_nsec / static_cast<long>(shim::ns_per_us)};
  return 0;
}

time_t time(time_t* result) noexcept {
  if (!is_in_lock_step()) return REAL(time)(result);
  const time_t now = shim::time_of(ask(What::clock).now_ns).tv_sec;
  if (result) *result = now;
  return now;
}

clock_t clock(void) noexcept {
  if (!is_in_lock_step()) return REAL(clock)();
  return static_cast<clock_t>(ask(What::clock).now_ns / shim::ns_per_us);
}

int nanosleep(const timespec* time, timespec* left) {
  if (!is_in_lock_step()) return REAL(nanosleep)(time, left);
  if (!shim::is_time(*time)) {
    errno = EINVAL;
    return -1;
  }
  shim::sleep_for(shim::ns_of(*time));
  return 0;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  if (!is_in_lock_step()) return REAL(clock_nanosleep)(clock, flags, time, left);
  if (!shim::is_time(*time)) return EINVAL;
  const std::uint64_t ns = shim::ns_of(*time);
  const std::uint64_t now = (flags & TIMER_ABSTIME) != 0 ? ask(What::clock).now_ns : 0;
  if (ns > now) shim::sleep_for(ns - now);
  return 0;
}

int usleep(useconds_t us) {
  if (!is_in_lock_step()) return REAL(usleep)(us);
  shim::sleep_for(us * shim::ns_per_us);
  return 0;
}

unsigned sleep(unsigned seconds) {
  if (!is_in_lock_step()) return REAL(sleep)(seconds);
  shim::sleep_for(seconds * shim::ns_per_s);
  return 0;
}

int poll(pollfd* files, nfds_t count, int ms) {
  if (!is_in_lock_step()) return REAL(poll)(files, count, ms);
  return shim::wait_until(
      shim::timeout_of(ms), [&] { return REAL(poll)(files, count, 0); },
      [&] { return REAL(poll)(files, count, -1); });
}

int __poll_chk(pollfd*, nfds_t, int, size_t);
int __poll_chk(pollfd* files, nfds_t count, int ms, size_t room) {
  return is_in_lock_step() ? poll(files, count, ms) : REAL(__poll_chk)(files, count, ms, room);
}

int ppoll(pollfd* files, nfds_t count, const timespec* time, const sigset_t* mask) {
  if (!is_in_lock_step()) return REAL(ppoll)(files, count, time, mask);
  return shim::wait_until(
      shim::timeout_of(time), [&] { return REAL(ppoll)(files, count, &shim::at_once, mask); },
      [&] { return REAL(ppoll)(files, count, nullptr, mask); });
}

int pselect(int count, fd_set* read, fd_set* write, fd_set* except, const timespec* time,
            const sigset_t* mask) {
  if (!is_in_lock_step()) return REAL(pselect)(count, read, write, except, time, mask);
  shim::Sets sets(read, write, except);
  const auto select_for = [&](const timespec* limit) {
    return sets.look([&](fd_set* r, fd_set* w, fd_set* e) {
      return REAL(pselect)(count, r, w, e, limit, mask);
    });
  };
  return shim::wait_until(
      shim::timeout_of(time), [&] { return select_for(&shim::at_once); },
      [&] { return select_for(nullptr); });
}

int select(int count, fd_set* read, fd_set* write, fd_set* except, timeval* time) {
  if (!is_in_lock_step()) return REAL(select)(count, read, write, except, time);
  timespec limit{};
  if (time) limit = {time->tv_sec, time->tv_usec * static_cast<long>(shim::ns_per_us)};
  return pselect(count, read, write, except, time ? &limit : nullptr, nullptr);
}

int epoll_pwait(int epoll, epoll_event* events, int most, int ms, const sigset_t* mask) {
  if (!is_in_lock_step()) return REAL(epoll_pwait)(epoll, events, most, ms, mask);
  return shim::wait_until(
      shim::timeout_of(ms), [&] { return REAL(epoll_pwait)(epoll, events, most, 0, mask); },
      [&] { return REAL(epoll_pwait)(epoll, events, most, -1, mask); });
}

int epoll_wait(int epoll, epoll_event* events, int most, int ms) {
  if (!is_in_lock_step()) return REAL(epoll_wait)(epoll, events, most, ms);
  return epoll_pwait(epoll, events, most, ms, nullptr);
}

}  // extern "C"
#pragma GCC visibility pop

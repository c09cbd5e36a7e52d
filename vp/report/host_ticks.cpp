#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>
#include <vp/host_ticks.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <ctime>

namespace vp {

namespace {

constexpr std::uint64_t ns_per_us = 1'000;
constexpr std::uint64_t ns_per_s = 1'000'000'000;

std::atomic<HostTicks::Listener*> listeners[8];

struct Times {
  std::uint64_t processor_ns = 0;  ///< of this process
  std::uint64_t followed_ns = 0;   ///< of those that it waits for
  std::uint64_t passed_ns = 0;
  long waits = 0;  ///< how often this thread gave the processor away of its own accord
};
Times last;
pid_t last_of = 0;  ///< the process: a forked one has listeners, but other times
std::atomic<pid_t> followed;

std::uint64_t read(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * ns_per_s +
         static_cast<std::uint64_t>(time.tv_nsec);
}

char* append(char* to, const char* text) {
  while (*text != '\0') *to++ = *text++;
  return to;
}

/// The numbers of a process' children that fit; an empty text if it has gone. proc_pid_children(5)
void read_children(pid_t process, char* text, std::size_t size) {
  char path[64];
  char* end = append(path, "/proc/");
  end = std::to_chars(end, path + sizeof path, process).ptr;
  end = append(end, "/task/");
  end = std::to_chars(end, path + sizeof path, process).ptr;
  *append(end, "/children") = '\0';
  ssize_t count = 0;
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file >= 0) {
    count = ::read(file, text, size - 1);
    ::close(file);
  }
  text[count > 0 ? count : 0] = '\0';
}

/// Of a process and its descendants, as far as they fit.
std::uint64_t processor_time_of(pid_t root) {
  constexpr std::size_t most = 64;
  pid_t processes[most] = {root};
  std::size_t count = root != 0 ? 1 : 0;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    clockid_t clock{};
    if (::clock_getcpuclockid(processes[i], &clock) == 0) sum += read(clock);
    char text[512];
    read_children(processes[i], text, sizeof text);
    const char* const end = text + __builtin_strlen(text);
    for (const char* next = text; next < end && count < most; ++next) {
      pid_t child = 0;
      next = std::from_chars(next, end, child).ptr;
      if (child != 0) processes[count++] = child;
    }
  }
  return sum;
}

Times times() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return {read(CLOCK_PROCESS_CPUTIME_ID), processor_time_of(followed), read(CLOCK_MONOTONIC),
          usage.ru_nvcsw};
}

// One tick at a time: a program that uses the timer itself, with alarm(), does not stop the ticks.
void plan_tick(std::uint64_t ns) {
  const itimerval timer{{0, 0}, {0, static_cast<suseconds_t>(ns / ns_per_us)}};
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

// Little use of the processor may mean that others had it: a waiting thread gave it away. A tick
// that comes late says that the process was stopped, as by a debugger.
std::uint64_t spent(const Times& from, const Times& to) {
  // The time of a process that has ended is no longer in the sum.
  const bool follows = to.followed_ns > from.followed_ns;
  const std::uint64_t followed_ns = follows ? to.followed_ns - from.followed_ns : 0;
  const std::uint64_t processor = to.processor_ns - from.processor_ns + followed_ns;
  const std::uint64_t passed = to.passed_ns - from.passed_ns;
  const bool late = passed > 2 * HostTicks::period_ns;
  const bool waited = to.waits != from.waits && processor < passed / 100 && !late;
  return waited ? passed : processor;
}

void on_alarm(int, siginfo_t*, void* context) {
  const int kept = errno;
  const Times now = times();
  const std::uint64_t spent_ns = spent(last, now);
  last = now;
  bool heard = false;
  for (const auto& listener : listeners) heard = heard || listener.load() != nullptr;
  if (heard) plan_tick(HostTicks::period_ns);
  for (const auto& place : listeners) {
    if (HostTicks::Listener* const listener = place.load())
      listener->on_host_tick(spent_ns, context);
  }
  errno = kept;
}

}  // namespace

void HostTicks::add(Listener& listener) {
  bool first = true;
  for (const auto& place : listeners) first = first && place.load() == nullptr;
  for (auto& place : listeners) {
    Listener* none = nullptr;
    if (place.compare_exchange_strong(none, &listener)) break;
  }
  struct sigaction action {};
  action.sa_sigaction = on_alarm;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_RESTART;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGALRM, &action, nullptr);
  if (first || last_of != ::getpid()) last = times();
  last_of = ::getpid();
  plan_tick(period_ns);
}

void HostTicks::follow(pid_t process) {
  followed = process;
}

void HostTicks::hurry() {
  plan_tick(period_ns / 100);
}

// A tick already in flight finds no listener.
void HostTicks::remove(Listener& listener) {
  for (auto& place : listeners) {
    Listener* expected = &listener;
    place.compare_exchange_strong(expected, nullptr);
  }
}

}  // namespace vp

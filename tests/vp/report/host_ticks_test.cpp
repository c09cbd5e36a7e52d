#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <vp/host_ticks.h>

#include <atomic>
#include <boost/test/unit_test.hpp>
#include <csignal>

namespace {

struct Counter : vp::HostTicks::Listener {
  void on_host_tick(std::uint64_t spent_ns, void*) override {
    spent += spent_ns;
    ticks = ticks + 1;
  }
  std::atomic<std::uint64_t> spent{0};
  std::atomic<unsigned> ticks{0};
};

std::uint64_t processor_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 +
         static_cast<std::uint64_t>(time.tv_nsec);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(host_ticks)

BOOST_AUTO_TEST_CASE(work_counts_by_the_time_of_the_processor) {
  Counter counter;
  const std::uint64_t start = processor_ns();
  vp::HostTicks::add(counter);
  while (counter.ticks < 3) continue;
  vp::HostTicks::remove(counter);
  // A busy machine may have let us wait for a whole tick.
  BOOST_TEST(counter.spent <= processor_ns() - start + 2 * vp::HostTicks::period_ns);
  BOOST_TEST(counter.spent > 0u);
}

// Its processor time begins at 0, and it has the listeners of its parent.
BOOST_AUTO_TEST_CASE(a_forked_process_counts_from_its_own_start) {
  Counter inherited;
  vp::HostTicks::add(inherited);
  while (inherited.ticks < 3) continue;
  const std::uint64_t before = inherited.spent;
  const pid_t child = ::fork();
  if (child == 0) {
    Counter own;
    vp::HostTicks::add(own);
    while (own.ticks < 1) continue;
    const std::uint64_t most = processor_ns() + 2 * vp::HostTicks::period_ns;
    ::_exit(own.spent <= most && inherited.spent - before <= most ? 0 : 1);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) continue;
  vp::HostTicks::remove(inherited);
  BOOST_TEST(WIFEXITED(status));
  BOOST_TEST(WEXITSTATUS(status) == 0);
}

BOOST_AUTO_TEST_CASE(waiting_counts_too) {
  Counter counter;
  vp::HostTicks::add(counter);
  while (counter.spent < 2 * vp::HostTicks::period_ns) ::pause();
  vp::HostTicks::remove(counter);
  BOOST_TEST(counter.ticks >= 2u);
}

// As on a busy machine: a process that computes has the processor for a small part of the time.
BOOST_AUTO_TEST_CASE(waiting_for_processes_that_compute_counts_by_their_processor_time) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    while (::fork() != 0) ::pause();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (std::uint64_t until = 0;; ::usleep(18'000))
      for (until = processor_ns() + 2'000'000; processor_ns() < until;) continue;
  }
  Counter counter;
  vp::HostTicks::follow(parent);
  vp::HostTicks::add(counter);
  while (counter.ticks < 8) ::pause();
  vp::HostTicks::remove(counter);
  vp::HostTicks::follow(0);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  BOOST_TEST(counter.spent > 0u);
  BOOST_TEST(counter.spent < 4 * vp::HostTicks::period_ns);
}

BOOST_AUTO_TEST_CASE(two_hear_and_who_left_hears_nothing) {
  Counter first, second;
  vp::HostTicks::add(first);
  vp::HostTicks::add(second);
  while (first.ticks < 1 || second.ticks < 1) ::pause();
  vp::HostTicks::remove(first);
  const unsigned before = first.ticks;
  const unsigned then = second.ticks;
  while (second.ticks < then + 2) ::pause();
  BOOST_TEST(first.ticks == before);
  vp::HostTicks::remove(second);
}

BOOST_AUTO_TEST_CASE(a_tick_in_a_hurry_counts_less) {
  struct Hurried : Counter {
    void on_host_tick(std::uint64_t spent_ns, void* context) override {
      Counter::on_host_tick(spent_ns, context);
      vp::HostTicks::hurry();
    }
  } counter;
  vp::HostTicks::add(counter);
  const std::uint64_t start = processor_ns();
  while (counter.ticks < 20) continue;
  vp::HostTicks::remove(counter);
  BOOST_TEST(counter.spent <= processor_ns() - start + 2 * vp::HostTicks::period_ns);
}

/// As a program may do: the timer is the same.
BOOST_AUTO_TEST_CASE(a_foreign_alarm_is_a_tick) {
  Counter counter;
  vp::HostTicks::add(counter);
  ::alarm(1);
  while (counter.ticks < 3) ::pause();
  vp::HostTicks::remove(counter);
}

BOOST_AUTO_TEST_SUITE_END()

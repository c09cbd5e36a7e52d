// What a signal ends that does not end by itself.
#include <host/process.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>

using platform::host::Child;
using platform::host::ChildEnd;
using platform::host::InterruptGuard;

namespace {

volatile std::sig_atomic_t asked = 0;

/// Runs `work` after a signal that was noted.
ChildEnd end_of(int signal, void (*work)()) {
  Child child([&](std::ostream&, std::ostream&) {
    asked = 0;
    const InterruptGuard guard([] { asked = asked + 1; });
    std::raise(signal);
    work();
    return InterruptGuard::noted() ? 7 : 8;
  });
  return child.wait();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(interrupt)

BOOST_AUTO_TEST_CASE(what_ends_soon_ends_by_itself) {
  for (const int signal : {SIGINT, SIGTERM}) {
    BOOST_TEST(end_of(signal, [] {}).exit_code == 7);
  }
}

BOOST_AUTO_TEST_CASE(the_simulation_is_interrupted_first) {
  const ChildEnd end = end_of(SIGTERM, [] {
    while (asked == 0) continue;
  });
  BOOST_TEST(end.exit_code == 7);
}

BOOST_AUTO_TEST_CASE(what_does_not_end_is_ended) {
  const auto busy = [] {
    for (volatile unsigned i = 0;;) i = i + 1;
  };
  const auto waits = [] {
    while (true) ::pause();
  };
  for (void (*work)() : {+busy, +waits}) {
    const ChildEnd end = end_of(SIGTERM, work);
    BOOST_TEST(end.exit_code == 130);
    BOOST_TEST(end.err == "markervp: interrupted\n");
  }
}

BOOST_AUTO_TEST_CASE(a_second_signal_ends_at_once) {
  const ChildEnd end = end_of(SIGINT, [] { std::raise(SIGTERM); });
  BOOST_TEST(end.exit_code == 130);
}

BOOST_AUTO_TEST_CASE(without_a_guard_the_first_does) {
  Child child([](std::ostream&, std::ostream&) {
    platform::host::prepare_signals();
    std::raise(SIGTERM);
    return 0;
  });
  BOOST_TEST(child.wait().exit_code == 130);
}

BOOST_AUTO_TEST_SUITE_END()

// What a signal ends that does not end by itself.
#include <cli/interrupt.h>
#include <cli/run_child.h>
#include <host/ending.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>

using platform::cli::ChildEnd;
using platform::cli::InterruptGuard;
using platform::cli::RunChild;

namespace {

struct Deaf : platform::cli::Simulation {
  platform::input::ImageSize image_size() const override { return {}; }
  platform::report::RunFacts facts() const override { return {}; }
  platform::report::HardwareMap map() override { return {}; }
  void run(const NextFrame&, const FrameDone&) override {}
  void interrupt() override { ++asked; }
  volatile int asked = 0;
};

/// Runs `work` after a signal that was noted.
ChildEnd end_of(int signal, void (*work)(Deaf&)) {
  RunChild child([&](std::ostream&, std::ostream&) {
    Deaf simulation;
    const InterruptGuard guard(simulation);
    std::raise(signal);
    work(simulation);
    return InterruptGuard::interrupted() ? 7 : 8;
  });
  return child.wait();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(interrupt)

BOOST_AUTO_TEST_CASE(what_ends_soon_ends_by_itself) {
  for (const int signal : {SIGINT, SIGTERM}) {
    BOOST_TEST(end_of(signal, [](Deaf&) {}).exit_code == 7);
  }
}

BOOST_AUTO_TEST_CASE(the_simulation_is_interrupted_first) {
  const ChildEnd end = end_of(SIGTERM, [](Deaf& simulation) {
    while (simulation.asked == 0) continue;
  });
  BOOST_TEST(end.exit_code == 7);
}

BOOST_AUTO_TEST_CASE(what_does_not_end_is_ended) {
  const auto busy = [](Deaf&) {
    for (volatile int i = 0;;) i = i + 1;
  };
  const auto waits = [](Deaf&) {
    while (true) ::pause();
  };
  for (void (*work)(Deaf&) : {+busy, +waits}) {
    const ChildEnd end = end_of(SIGTERM, work);
    BOOST_TEST(end.exit_code == 130);
    BOOST_TEST(end.err == "markervp: interrupted\n");
  }
}

BOOST_AUTO_TEST_CASE(a_second_signal_ends_at_once) {
  const ChildEnd end = end_of(SIGINT, [](Deaf&) { std::raise(SIGTERM); });
  BOOST_TEST(end.exit_code == 130);
}

BOOST_AUTO_TEST_CASE(without_a_guard_the_first_does) {
  RunChild child([](std::ostream&, std::ostream&) {
    platform::host::prepare_signals();
    std::raise(SIGTERM);
    return 0;
  });
  BOOST_TEST(child.wait().exit_code == 130);
}

BOOST_AUTO_TEST_SUITE_END()

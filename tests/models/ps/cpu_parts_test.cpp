// The parts of a core that do their work without a simulation.
#include <ps/cpu/cores.h>
#include <ps/cpu/cpu_time.h>
#include <ps/cpu/deadline.h>
#include <ps/cpu/irq.h>
#include <ps/cpu/wait_signs.h>
#include <vp/error.h>
#include <array>
#include <boost/test/unit_test.hpp>
#include <string>

namespace {

constexpr std::uint32_t status = 0x4000'0004;

std::string signs_text(const ps::WaitSigns& signs) {
  ps::Surroundings around;
  around.wait_reason = [](const ps::Surroundings::Wait& wait) {
    return std::string("; ") + (wait.polled ? "polls" : "waits") +
           (wait.irq_masked ? " masked" : "");
  };
  return signs.text(around, true);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cpu_parts)

BOOST_AUTO_TEST_CASE(a_deadline_is_the_look_before_the_timeout_then_the_timeout) {
  ps::Deadline deadline;
  unsigned looks = 0;
  deadline.set_timeout(300);
  BOOST_TEST(deadline.ps() == 300u);
  deadline.want_look(100, [&] { ++looks; });
  BOOST_TEST(deadline.ps() == 100u);
  BOOST_TEST(!deadline.is_timeout(deadline.ps()));
  deadline.set_timeout(400);
  BOOST_TEST(deadline.ps() == 100u);
  deadline.look();
  BOOST_TEST(looks == 1u);
  BOOST_TEST(deadline.ps() == 400u);
  BOOST_TEST(!deadline.is_timeout(399));
  BOOST_TEST(deadline.is_timeout(400));
}

BOOST_AUTO_TEST_CASE(a_look_behind_the_timeout_does_not_move_it) {
  ps::Deadline deadline;
  deadline.set_timeout(300);
  deadline.want_look(301, [] {});
  BOOST_TEST(deadline.ps() == 300u);
  BOOST_TEST(deadline.is_timeout(deadline.ps()));
}

BOOST_AUTO_TEST_CASE(a_core_takes_no_interrupt_masked_or_in_a_handler) {
  ps::Irq irq;
  BOOST_TEST(!irq.interruptible());  // as after a reset
  BOOST_TEST(irq.masked_by_program());
  irq.mask(false);
  BOOST_TEST(irq.interruptible());
  irq.enter();
  BOOST_TEST(!irq.interruptible());
  BOOST_TEST(!irq.masked_by_program());
  irq.mask(false);
  BOOST_TEST(!irq.interruptible());
  irq.leave();
  BOOST_TEST(irq.interruptible());
}

BOOST_AUTO_TEST_CASE(handlers_that_leave_an_interrupt_pending_are_counted_in_a_row) {
  ps::Irq irq;
  const auto leave_pending = [&](unsigned times, std::uint64_t from_ps) {
    unsigned told = 0;
    for (unsigned i = 0; i < times; ++i) told += irq.leaves_too_many(true, from_ps + i) ? 1 : 0;
    return told;
  };
  BOOST_TEST(leave_pending(ps::Irq::many_handlers - 1, 0) == 0u);
  BOOST_TEST(!irq.leaves_too_many(false, 2'000));
  BOOST_TEST(leave_pending(ps::Irq::many_handlers - 1, 5'000) == 0u);
  BOOST_TEST(leave_pending(ps::Irq::many_handlers, 9'000) == 1u);  // once
  BOOST_TEST(irq.pending_since_ps() == 5'000u);
}

BOOST_AUTO_TEST_CASE(signs_of_waiting_name_what_was_seen_last) {
  ps::WaitSigns signs;
  BOOST_TEST(signs_text(signs) == "");
  signs.note_read(status, 1);
  BOOST_TEST(signs_text(signs) == "; the last register that it read was 0x40000004: 0x00000001");
  signs.note_read(status, 3);
  signs.note_read(status, 1);
  BOOST_TEST(signs_text(signs) ==
             "; the last register that it read was 0x40000004: 0x00000001, 3 times in a row, of "
             "which only the bits 0x00000002 changed; polls masked");
  signs.note_poll(status, 7, 50);
  BOOST_TEST(signs_text(signs) ==
             "; it polls for a change of any bit of 0x40000004: 0x00000007; polls masked");
  signs.set_loops(true);
  BOOST_TEST(signs_text(signs) ==
             "; it loops without a call of the HAL, as one does that waits for a variable; waits "
             "masked");
}

BOOST_AUTO_TEST_CASE(many_equal_reads_of_one_register_see_no_change) {
  ps::WaitSigns signs;
  for (unsigned i = 0; i < 1'000; ++i) signs.note_read(status, 5);
  BOOST_TEST(!signs.sees_no_change());  // the first one is not again
  signs.note_read(status, 5);
  BOOST_TEST(signs.sees_no_change());
  signs.note_read(status, 4);
  BOOST_TEST(!signs.sees_no_change());
  signs.note_read(status + 4, 4);
  for (unsigned i = 0; i < 1'000; ++i) signs.note_read(status + 4, 4);
  BOOST_TEST(signs.sees_no_change());
}

BOOST_AUTO_TEST_CASE(a_reservation_is_lost_to_a_write_of_its_cache_line) {
  alignas(32) std::array<volatile std::uint32_t, 16> words{};
  ps::ExclusiveMonitor monitor;
  BOOST_TEST(!monitor.take(&words[0]));
  monitor.reserve(&words[0], 0);
  BOOST_TEST(!monitor.take(&words[1]));
  BOOST_TEST(!monitor.take(&words[0]));  // the store to another word ended it
  monitor.reserve(&words[0], 0);
  monitor.note_write(&words[8]);  // the next line
  BOOST_TEST(monitor.take(&words[0]));
  monitor.reserve(&words[0], 0);
  monitor.note_write(&words[7]);
  BOOST_TEST(!monitor.take(&words[0]));
  monitor.reserve(&words[0], 0);
  words[0] = 1;  // outside the HAL
  BOOST_TEST(!monitor.take(&words[0]));
}

BOOST_AUTO_TEST_CASE(a_work_meter_adds_up_units_and_code) {
  const char* const names[] = {"step", "load"};
  hal_program program{};
  program.name = "p";
  program.work = names;
  program.work_count = 2;
  ps::CostTable costs("test");
  costs.set("step", {2, 0});
  ps::WorkMeter meter;
  BOOST_CHECK_THROW(meter.load(program, costs), vp::InputError);
  costs.set("load", {0.5, 3});
  meter.load(program, costs);
  meter.set_frequency(1'000'000'000);
  meter.set_code_cycles(4);
  BOOST_TEST(meter.add(2, 1) == nullptr);
  BOOST_REQUIRE(meter.add(1, 10) != nullptr);
  BOOST_TEST(meter.add(0, 7)->count == 7u);
  BOOST_TEST(static_cast<std::uint64_t>(meter.add_code(5, 10)) == 200 * ps::LocalTime::one_cycle);
  const ps::WorkMeter::Counted counted = meter.counted();
  BOOST_TEST(static_cast<std::uint64_t>(counted.cycles) == 219 * ps::LocalTime::one_cycle);
  BOOST_TEST(static_cast<std::uint64_t>(counted.stall_fs) == 30'000'000u);
  BOOST_TEST(meter.counts()[1].cycles == 0.5);
  // Of one unit, rounded up.
  BOOST_TEST(static_cast<std::uint64_t>(meter.add(1, 0)->most_fs) == 3'500'001u);
}

BOOST_AUTO_TEST_SUITE_END()

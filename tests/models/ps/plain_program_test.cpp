// Programs that are a main() and count no work: what their code takes, where their data lie, and
// how they end.
#include <ps/cpu/program_watch.h>
#include <ps/memory/memory.h>
#include <vp/error.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <numeric>

#include "bench.h"

using namespace bench;

namespace {

/// What plain.c does.
enum class Case : std::uint32_t {
  writes_for_ever,
  loops_for_ever,
  waits,
  waits_for_ever,
  sleeps_for_ever,
  shows_data,
  uses_heap,
  overflows,
  computes,
  leaves_interrupts_on,
  switches_for_ever,
  switches,
  starts_second,
  shows_arguments,
  leaves_all_to_handlers,
  uses_pointers,
};

/// The second core and the memory of the boot code.
struct SecondCore {
  explicit SecondCore(Bench& bench)
      : ocm("ocm", bench.cpu_clock), cpu("cpu1", bench.cpu_clock, bench.cpu) {
    bench.bus.map("ocm", ps::Ocm::base, ps::Ocm::size).bind(ocm.socket);
    cpu.n_irq(n_irq);
    cpu.m_axi.socket.bind(bench.bus.socket);
  }
  ps::Ocm ocm;
  vp::Signal<bool> n_irq{"n_irq1", 1, true};
  ps::Cpu cpu;
};

/// A core with DDR that ran a program.
struct Run : Bench {
  Run(const std::string& name, const Settings& settings = {}, Case what = Case::writes_for_ever)
      : Bench(settings), program(ps::Program::load(MARKERVP_TEST_PROGRAMS "/" + name + ".so")) {
    ddr.emplace("ddr");
    bus.map("ddr", ps::Ddr::base, ddr->size, vp::Router::Addresses::absolute).bind(ddr->socket);
    cpu.connect(ddr->dma_memory());
    cpu.end_stack_at(ddr->dma_memory().first());
    cpu.surroundings.device = [](std::uint32_t address) {
      return ps::Answerer{address / 0x1000 == device_address / 0x1000 ? "device" : ""};
    };
    first = what;
    device.value = [this](std::uint64_t) {
      return std::exchange(asked, true) ? 0x89AB'CDEFu : static_cast<std::uint32_t>(first);
    };
  }
  void start() {
    cpu.load(*program, costs());
    sc_core::sc_start();
  }
  std::vector<std::uint32_t> written() const {
    std::vector<std::uint32_t> words;
    for (const Device::Access& access : device.log) {
      if (access.write) words.push_back(access.value);
    }
    return words;
  }

  vp::ReportRouter reports;
  std::unique_ptr<ps::Program> program;
  std::optional<ps::Ddr> ddr;
  Case first;
  bool asked = false;
};

/// Of the four computations of kernels.c, in cycles of 1 ns.
std::vector<double> kernel_cycles(const Settings& settings = {},
                                  const std::string& program = "kernels") {
  Run run(program, settings);
  run.start();
  run.cpu.check();
  const std::vector<std::uint64_t> times = run.device.times();
  std::vector<double> cycles;
  for (std::size_t i = 0; i + 1 < times.size(); i += 2)
    cycles.push_back(static_cast<double>(times[i + 1] - times[i]) / 1'000);
  return cycles;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(plain_program)

// Measured as scripts/calibrate does: kernels.c compiled for a Cortex-A9 with -O0, cycles by
// llvm-mca, stalls by the cache model (L2 hit 25 cycles, DDR 100).
BOOST_AUTO_TEST_CASE(code_takes_what_was_calibrated_within_30_percent) {
  const double calibrated[] = {107'857, 169'382, 71'289, 122'883};
  const std::vector<double> cycles = kernel_cycles();
  BOOST_TEST_REQUIRE(cycles.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const double error = cycles[i] / calibrated[i] - 1;
    BOOST_TEST_MESSAGE("kernel " << i << ": " << cycles[i] << " cycles, " << 100 * error << " %");
    BOOST_TEST(std::abs(error) < 0.3);
  }
}

BOOST_AUTO_TEST_CASE(the_same_time_in_each_run_and_when_blocks_are_counted) {
  const std::vector<double> once = kernel_cycles();
  BOOST_TEST(kernel_cycles() == once, boost::test_tools::per_element());
  ps::ProgramWatch::BlockCounts counts;
  ps::ProgramWatch::block_counts = &counts;
  const std::vector<double> counted = kernel_cycles();
  ps::ProgramWatch::block_counts = nullptr;
  BOOST_TEST(counted == once, boost::test_tools::per_element());
  BOOST_TEST(counts.size() > 20);
}

// In line where the compiler leaves room, by calls elsewhere.
BOOST_AUTO_TEST_CASE(however_blocks_are_charged_they_take_the_same_time) {
  BOOST_TEST(kernel_cycles({}, "kernels_called") == kernel_cycles(),
             boost::test_tools::per_element());
  for (const bool room : {true, false}) {
    ps::ProgramWatch::BlockCounts counts;
    ps::ProgramWatch::block_counts = &counts;
    Run run(room ? "kernels" : "kernels_called");
    run.start();
    ps::ProgramWatch::block_counts = nullptr;
    for (const auto& [block, count] : counts) BOOST_TEST(ps::MachineCode::has_room(block) == room);
  }
}

BOOST_AUTO_TEST_CASE(the_scale_multiplies_it_and_0_is_no_time) {
  const std::vector<double> once = kernel_cycles();
  const std::vector<double> doubled = kernel_cycles({"cpu.code_scale=2"});
  for (std::size_t i = 0; i < 4; ++i) BOOST_TEST(std::abs(doubled[i] - 2 * once[i]) <= 1);
  const std::vector<double> none = kernel_cycles({"cpu.code_scale=0"});
  BOOST_TEST(std::accumulate(none.begin(), none.end(), 0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(interrupts_come_at_their_time_while_it_computes) {
  Run run("plain", {}, Case::computes);
  run.device.written = [&](std::uint32_t) { run.n_irq = true; };
  for (std::uint64_t ms = 1; ms <= 8; ++ms) run.set_n_irq_at(ms * 1'000'000'000 / 2, false);
  run.start();
  run.cpu.check();
  const std::vector<std::uint64_t> times = run.device.times();
  BOOST_TEST(run.cpu.exit_code() >= 4);  // 300 000 passes of some 7 cycles
  BOOST_TEST(run.cpu.exit_code() <= 8);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const std::uint64_t due = i * 500'000'000 + 100'000;  // entry of the handler
    BOOST_TEST(times[i] >= due);
    BOOST_TEST(times[i] <= due + 100'000);  // the handler's own code
  }
}

BOOST_AUTO_TEST_CASE(an_endless_loop_by_design_ends_at_the_limit_without_failure) {
  for (const Case what : {Case::writes_for_ever, Case::loops_for_ever, Case::switches_for_ever}) {
    Run run("plain", {"cpu.timeout=200 us"}, what);
    run.start();
    run.cpu.check();
    BOOST_TEST((run.cpu.state() == ps::Cpu::State::finished));
    BOOST_TEST(run.cpu.reached_limit());
    BOOST_TEST(run.cpu.end_ps() == 200'000'000u);
    BOOST_TEST(run.reports.warnings().empty());
  }
}

BOOST_AUTO_TEST_CASE(the_second_core_starts_at_the_word_of_the_boot_code) {
  Run run("plain", {}, Case::starts_second);
  const SecondCore second(run);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.written() == std::vector<std::uint32_t>{21});
  BOOST_TEST(run.reports.warnings().empty());
}

// Where the second file would lie, there is no code.
BOOST_AUTO_TEST_CASE(each_core_may_have_a_program_of_its_own) {
  BOOST_TEST(ps::Program::load(MARKERVP_TEST_PROGRAMS "/files.so")->may_start_core());
  Run run("files");
  const SecondCore second(run);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.written() == std::vector<std::uint32_t>{41});
  BOOST_TEST(run.reports.warnings().empty());
}

BOOST_AUTO_TEST_CASE(a_second_program_that_is_not_there_is_told) {
  BOOST_TEST(!ps::Program::load(MARKERVP_TEST_PROGRAMS "/file.so")->may_start_core());
  Run run("file", {"cpu.timeout=1 ms"});
  const SecondCore second(run);
  run.start();
  BOOST_TEST(!run.failure().empty());
  BOOST_TEST_REQUIRE(run.reports.warnings().size() == 1u);
  const std::string told = run.reports.warnings().front().message;
  BOOST_TEST(contains(told, "starts core 1 at 0x02000000, where it has no code"), told);
  BOOST_TEST(contains(told, "markervp_add_program(… CORE1 file…)"), told);
}

BOOST_AUTO_TEST_CASE(a_word_of_the_boot_code_starts_no_core_that_the_platform_lacks) {
  Run run("plain", {}, Case::starts_second);
  ps::Ocm ocm("ocm", run.cpu_clock);
  run.bus.map("ocm", ps::Ocm::base, ps::Ocm::size).bind(ocm.socket);
  run.start();
  const std::string error = run.failure();
  BOOST_TEST(contains(error, "the platform has one core: set ps.cores to 2"), error);
  BOOST_TEST(run.written().empty());
}

// The loop behind main() is the vendor's exit().
BOOST_AUTO_TEST_CASE(interrupts_are_served_after_main_until_nothing_is_left_to_happen) {
  Run run("plain", {}, Case::leaves_interrupts_on);
  run.cpu.surroundings.any_interrupt = [] { return true; };
  run.device.written = [&](std::uint32_t) { run.n_irq = true; };
  run.set_n_irq_at(500'000'000, false);
  run.set_n_irq_at(7'000'000'000, false);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.cpu.exit_code() == 3);
  BOOST_TEST(!run.cpu.reached_limit());
  BOOST_TEST(run.written().size() == 2);
  BOOST_TEST_REQUIRE(run.cpu.main_end_ps().has_value());
  BOOST_TEST(*run.cpu.main_end_ps() < 1'000'000u);
  BOOST_TEST(run.cpu.end_ps() == 7'000'168'750u);  // entry 100 ns, exit 60 ns, the handler's code
  BOOST_TEST(run.reports.warnings().empty());
}

BOOST_AUTO_TEST_CASE(interrupts_without_end_are_served_after_main_up_to_the_limit) {
  Run run("plain", {"cpu.after_main=3 ms"}, Case::leaves_interrupts_on);
  run.cpu.surroundings.any_interrupt = [] { return true; };
  run.device.written = [&](std::uint32_t) { run.n_irq = true; };
  for (std::uint64_t ms = 1; ms <= 9; ++ms) run.set_n_irq_at(ms * 1'000'000'000 - 500'000, false);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.cpu.exit_code() == 3);
  BOOST_TEST(run.cpu.reached_limit());
  BOOST_TEST_REQUIRE(run.cpu.main_end_ps().has_value());
  BOOST_TEST(run.cpu.end_ps() == *run.cpu.main_end_ps() + 3'000'000'000u);
  BOOST_TEST(run.written().size() == 3);
  BOOST_TEST(run.reports.warnings().empty());
}

BOOST_AUTO_TEST_CASE(main_is_the_end_where_no_interrupt_is_enabled_or_none_can_come) {
  for (const bool enabled : {false, true}) {
    Run run("plain", {}, Case::leaves_interrupts_on);
    run.cpu.surroundings.any_interrupt = [=] { return enabled; };
    if (!enabled) run.set_n_irq_at(500'000'000, false);
    run.start();
    run.cpu.check();
    BOOST_TEST(run.cpu.exit_code() == 3);
    BOOST_TEST(!run.cpu.main_end_ps().has_value());
    BOOST_TEST(run.cpu.end_ps() < 1'000'000u);
    BOOST_TEST(run.written().empty());
  }
}

BOOST_AUTO_TEST_CASE(what_waits_in_an_endless_loop_is_told) {
  const std::pair<Case, const char*> cases[] = {
      {Case::waits_for_ever, "it loops without a call of the HAL"},
      {Case::sleeps_for_ever, "it waits for an interrupt, and none came"}};
  for (const auto& [what, reason] : cases) {
    Run run("plain", {"cpu.timeout=300 us"}, what);
    run.start();
    run.cpu.check();
    BOOST_TEST(run.cpu.reached_limit());
    BOOST_TEST_REQUIRE(run.reports.warnings().size() == 1);
    const std::string& text = run.reports.warnings().front().message;
    BOOST_TEST(contains(text, reason), text);
  }
}

// The task of a kernel that idles looks at variables of the kernel.
BOOST_AUTO_TEST_CASE(a_kernel_with_tasks_idles_for_ever_without_failure) {
  Run run("plain", {"cpu.timeout=300 us"}, Case::waits_for_ever);
  run.cpu.after_interrupt([] {});
  run.start();
  run.cpu.check();
  BOOST_TEST(run.cpu.reached_limit());
  BOOST_TEST(run.reports.warnings().empty());
}

BOOST_AUTO_TEST_CASE(what_keeps_an_interrupt_from_a_program_that_leaves_all_to_handlers_is_told) {
  for (const std::string stopped : {"; interrupt 61 is not enabled", ""}) {
    Run run("plain", {"cpu.timeout=300 us"}, Case::leaves_all_to_handlers);
    run.cpu.surroundings.wait_reason = [&](const ps::Surroundings::Wait& wait) {
      return wait.only_stopped ? stopped : "; something else";
    };
    run.start();
    run.cpu.check();
    BOOST_TEST(run.cpu.reached_limit());
    const auto warnings = run.reports.warnings();
    BOOST_TEST_REQUIRE(warnings.size() == (stopped.empty() ? 0u : 1u));
    if (stopped.empty()) continue;
    const std::string& text = warnings.front().message;
    BOOST_TEST(contains(text, "in an endless loop" + stopped), text);
    BOOST_TEST(!contains(text, "something else"), text);
  }
}

BOOST_AUTO_TEST_CASE(main_gets_no_arguments) {
  Run run("plain", {}, Case::shows_arguments);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.cpu.exit_code() == 0);
}

BOOST_AUTO_TEST_CASE(a_loop_that_a_case_of_a_switch_leaves_is_a_failure) {
  Run run("plain", {"cpu.timeout=300 us"}, Case::switches);
  run.start();
  const std::string error = run.failure();
  BOOST_TEST(contains(error, "no end within 300 us"), error);
  BOOST_TEST(!run.cpu.reached_limit());
}

BOOST_AUTO_TEST_CASE(a_loop_that_could_end_is_a_failure) {
  Run run("plain", {"cpu.timeout=300 us"}, Case::waits);
  run.start();
  const std::string error = run.failure();
  BOOST_TEST(contains(error, "no end within 300 us"), error);
  BOOST_TEST(contains(error, "it loops without a call of the HAL"), error);
  BOOST_TEST(contains(error, "plain.c:"), error);
}

BOOST_AUTO_TEST_CASE(data_heap_and_stack_lie_in_the_ddr_at_the_same_addresses) {
  std::vector<std::uint32_t> before;
  for (int i = 0; i < 2; ++i) {
    Run run("plain", {}, Case::shows_data);
    run.start();
    run.cpu.check();
    const std::vector<std::uint32_t> words = run.written();
    BOOST_TEST_REQUIRE(words.size() == 8);
    const std::uint32_t contents[] = {0x1234'5678, 1, 2, 3};
    for (std::size_t k = 0; k < 4; ++k) {
      BOOST_TEST(words[2 * k + 1] == 0);  // the upper half
      std::uint32_t seen = 0;
      std::memcpy(&seen, run.ddr->behind(words[2 * k], sizeof seen), sizeof seen);
      if (k < 2) BOOST_TEST(seen == contents[k]);
    }
    if (i != 0) BOOST_TEST(words == before, boost::test_tools::per_element());
    before = words;
  }
}

BOOST_AUTO_TEST_CASE(the_heap_gives_and_takes) {
  Run run("plain", {}, Case::uses_heap);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.cpu.exit_code() == 0);
}

BOOST_AUTO_TEST_CASE(a_stack_overflow_names_the_function) {
  Run run("plain", {"cpu.stack_size=1 MiB"}, Case::overflows);
  run.start();
  const std::string error = run.failure();
  BOOST_TEST(contains(error, "stack overflow: its 1024 KiB are used up"), error);
  BOOST_TEST(contains(error, "deep"), error);
}

BOOST_AUTO_TEST_CASE(a_stack_without_room_is_refused) {
  Run run("plain", {"cpu.stack_size=255 MiB"});
  BOOST_CHECK_EXCEPTION(run.start(), vp::InputError, [](const auto& error) {
    return contains(error.what(), "cpu.stack_size") && contains(error.what(), "ends at");
  });
}

BOOST_AUTO_TEST_CASE(registers_are_reached_through_pointers) {
  Run run("plain", {}, Case::uses_pointers);
  run.start();
  run.cpu.check();
  BOOST_TEST(run.cpu.exit_code() == 0);
  const std::vector<std::uint32_t> expected{0xCAFE'0001, 0x89AB'CD55, 0x3F80'0000, 0x89AB'CDFF, 7};
  BOOST_TEST(run.written() == expected, boost::test_tools::per_element());
  BOOST_TEST_REQUIRE(run.reports.warnings().size() == 1);
  BOOST_TEST(contains(run.reports.warnings().front().message, "unsigned long"));
}

BOOST_AUTO_TEST_SUITE_END()

// PS programs that crash, or spin without the HAL: exit code 3, one line, and the results are kept.
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "command_line.h"

using namespace negative;

namespace {

struct Faults : CommandLine {
  // A program that crashed is frozen with all that its stack holds.
  Faults() { ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1); }
  ~Faults() { ::unsetenv("LSAN_OPTIONS"); }

  /// Runs the crashing program on two frames.
  kit::Outcome run(int way, const Words& more = {}) const {
    std::filesystem::remove_all(*this / "out");
    Words arguments{"run",       "z1.0",
                    "z1.5",      "--no-pictures",
                    "--program", MARKERVP_CRASHING,
                    "--set",     "sw.way=" + std::to_string(way)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments);
  }

  /// It must end with one line that has all of `parts`, and keep its first frame.
  void fails(int way, const Words& parts, const Words& more = {}) const {
    BOOST_TEST_CONTEXT("way " << way) {
      const kit::Outcome outcome = run(way, more);
      BOOST_TEST(outcome.signal == 0);
      BOOST_TEST(outcome.exit_code == 3);
      check_one_line(outcome.err, parts);
      const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
      BOOST_TEST(result["incomplete"] == "stopped by an error");
      BOOST_TEST(result["frames"].size() == 1u);
    }
  }
};

const std::string where = ", at 320 ns in function 'crash' of program 'crashing'";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(faults, Faults)

BOOST_AUTO_TEST_CASE(a_pointer_to_a_device) {
  fails(0, {"accesses 0x41200000 (axi_gpio_0) with an instruction that computes with it",
            "volatile uint32_t", where, "dereference_device()+"});
}

BOOST_AUTO_TEST_CASE(null_pointers) {
  fails(1, {"write to 0x00000008 (a null pointer)", where, "write_null()+"});
  fails(3, {"jump to 0x00000000 (a null pointer)", where, "call_null()+"});
  fails(11, {"read of 0x00000010 (a null pointer)", where, "publish_nothing()+"});
}

BOOST_AUTO_TEST_CASE(a_stack_that_overflows) {
  fails(2, {"stack overflow", "8192 KiB", "ps.cpu.stack_size", where, "recurse(int)+"});
  fails(2, {"stack overflow", "64 KiB", where}, {"--set", "ps.cpu.stack_size=64 KiB"});
}

BOOST_AUTO_TEST_CASE(traps) {
  fails(4, {"illegal instruction", where, "trap()+"});
  fails(5, {"integer division by zero", where, "divide()+"});
  fails(6, {"floating point division by zero", where, "divide_floating()+"});
}

BOOST_AUTO_TEST_CASE(programs_that_want_to_end_everything) {
  fails(7, {"called abort()", where, "give_up()+"});
  fails(8, {"called exit(0)", where, "leave()+"});
  fails(9, {"threw an exception: oops", where});
  fails(17, {"called _exit(0): return from its entry function", where, "leave_at_once()+"});
  fails(18, {"called _Exit(0)", where, "leave_for_good()+"});
  fails(19, {"called quick_exit(0)", where, "leave_quickly()+"});
  fails(20, {"called fork()", where});
  fails(21, {"called pthread_exit()", where, "end_thread()+"});
}

BOOST_AUTO_TEST_CASE(a_fault_in_an_interrupt_handler) {
  fails(12, {"write to 0x00000008", "in the interrupt handler", "write_null()+"});
}

BOOST_AUTO_TEST_CASE(a_handler_that_never_returns) {
  const kit::Outcome outcome = run(22);
  BOOST_TEST(outcome.exit_code == 3);
  check_one_line(outcome.err, {"interrupt handler never returned", "longjmp()", "'crashing'"});
}

BOOST_AUTO_TEST_CASE(a_jump_inside_the_program_is_allowed) {
  BOOST_TEST(run(23).exit_code == 0);
}

BOOST_AUTO_TEST_CASE(another_working_folder_moves_no_input_and_no_result) {
  write_image("grey.pgm");
  const kit::Outcome outcome =
      start({"run", "z1.0", "z1.5", "grey.pgm", "--program", MARKERVP_CRASHING, "--set",
             "sw.way=24", "--register-coverage", "used.md"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
  BOOST_TEST(result["frames"].size() == 3u);
  BOOST_TEST(std::filesystem::exists(*this / "out/0002_grey.png"));
  BOOST_TEST(std::filesystem::exists(*this / "used.md"));
}

BOOST_AUTO_TEST_CASE(a_destroyed_stack) {
  fails(13, {"segmentation fault", "0x123456789", where});
}

BOOST_AUTO_TEST_CASE(low_addresses_of_the_on_chip_memory_are_reached_by_pointers) {
  const kit::Outcome outcome =
      start({"run", "z1.0", "--program", MARKERVP_CRASHING, "--set", "sw.way=25"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
}

BOOST_AUTO_TEST_CASE(a_loop_without_hal_call) {
  fails(14, {"no end within 10 ms", "ps.cpu.timeout", "function 'crash'", "spin()+"},
        {"--set", "ps.cpu.timeout=10 ms"});
}

BOOST_AUTO_TEST_CASE(a_loop_without_a_statement) {
  fails(16, {"no end within 10 ms", "ps.cpu.timeout", "function 'crash'", "stand_still()+"},
        {"--set", "ps.cpu.timeout=10 ms"});
}

BOOST_AUTO_TEST_CASE(a_bus_error_names_who_asked) {
  fails(15, {"read of 0x50000000", "DECERR", "function 'crash'", "read_unmapped()+"});
}

BOOST_AUTO_TEST_CASE(logs_that_cannot_be) {
  run_refuses({"z1.0", "--log-bus-filter", "ddr"}, {"--log-bus"});
  run_refuses({"z1.0", "--log-bus", "log", "--log-bus-filter", "axi_dma_9"},
              {"axi_dma_9", "axi_dma_1"});
  run_refuses({"z1.0", "--log-bus", "nowhere/log"}, {"nowhere/log"});
  run_refuses({"z1.0", "--register-coverage", "nowhere/used.md"}, {"nowhere/used.md"});
}

BOOST_AUTO_TEST_CASE(a_log_up_to_the_crash) {
  fails(15, {"read of 0x50000000"},
        {"--log-bus", "log", "--log-bus-filter", "0x50000000", "--register-coverage", "used.md"});
  BOOST_TEST(kit::read_file(*this / "log") == "320 ns  cpu  read   0x50000000  -  -  DECERR\n");
  const std::string used = kit::read_file(*this / "used.md");
  BOOST_TEST(contains(used, "## axi_gpio_0: 1 of"));
  BOOST_TEST(contains(used, "| GPIO_DATA | 2 | 0 | 0x00000000 | 0xFFFFFFFF | - | - |"));
}

BOOST_AUTO_TEST_SUITE_END()

// Programs written for Vitis standalone, unchanged: built outside of the tree, on the installed
// executable.
#include <boost/test/unit_test.hpp>

#include <nlohmann/json.hpp>

#include "installation.h"

using namespace install_test;

namespace {

struct Vitis {
  Vitis() { installed.build(project("vitis"), "vitis"); }

  kit::Outcome run(const std::string& program, const Words& more = {}) const {
    Words arguments{"run",
                    "--design",
                    installed.beside("vitis/loop.so"),
                    "--program",
                    installed.beside("vitis/" + program + ".so"),
                    "--output",
                    "vitis_out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return installed.markervp(arguments);
  }
  nlohmann::json result() const {
    return nlohmann::json::parse(kit::read_file(installed.beside("vitis_out/result.json")));
  }

  const Installation& installed = Installation::get();
};

const Words scatter_gather{"--set", "pl.axi_dma_0.include_sg=true"};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(vitis, Vitis)

// Each ends as on the board: with its message and 0.
BOOST_AUTO_TEST_CASE(examples_end_as_on_the_board) {
  struct Example {
    const char *program, *says;
    bool scatter_gather;
  };
  const Example examples[] = {
      {"gpio", "Successfully ran Gpio Example", false},
      {"gpio_low_level", "Successfully ran Gpio Low Level Example", false},
      {"gpio_interrupt", "Successfully ran Gpio Interrupt Tapp Example", false},
      {"dma_simple_poll", "Successfully ran XAxiDma_SimplePoll Example", false},
      {"dma_simple_interrupt", "Successfully ran AXI DMA interrupt Example", false},
      {"dma_sg_poll", "Successfully ran AXI DMA SG Polling Example", true},
      {"dma_sg_interrupt", "Successfully ran AXI DMA SG interrupt Example", true},
      {"dma_sg_cyclic", "Successfully ran AXI DMA Cyclic SG Example", true},
      {"scutimer_polled", "Successfully ran SCU Timer Polled Mode Example Test", false},
      {"scutimer_interrupt", "expired 3", false},
      {"scuwdt", "Successfully ran SCU WDT Example", false},
      {"uart_hello", "uart1: Hello World from the UART", false},
      {"uart_polled", "Successfully ran Uartps polled Example", false},
      {"uart_interrupt", "Successfully ran Uartps interrupt Example", false},
      {"gic_software", "Successfully ran GIC Example", false},
      {"bsp_odds", "Successfully ran the odds and ends", false},
      {"sdt", "Successfully ran what has an address", false},
  };
  for (const Example& example : examples) {
    const kit::Outcome outcome =
        run(example.program, example.scatter_gather ? scatter_gather : Words{});
    BOOST_TEST(outcome.exit_code == 0, example.program << ": " << outcome.out << outcome.err);
    BOOST_TEST(contains(outcome.out, example.says), example.program << ": " << outcome.out);
    BOOST_TEST(outcome.err == "", example.program);
    BOOST_TEST(result()["system"] == example.program);
  }
}

// What main() returns is the program's exit code.
BOOST_AUTO_TEST_CASE(a_main_that_fails) {
  const kit::Outcome outcome = run("dma_sg_poll");
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.out, "Device configured as Simple mode"));
  BOOST_TEST(run("dma_simple_poll", scatter_gather).exit_code == 1);
}

// Its statements take time, as on the board.
BOOST_AUTO_TEST_CASE(a_main_that_waits_by_working) {
  const kit::Outcome none = run("dma_hurried", {"--set", "ps.cpu.code_scale=0"});
  BOOST_TEST(none.exit_code == 1);
  BOOST_TEST(contains(none.err, "XAxiDma_SimpleTransfer while the channel is busy"), none.err);
  const kit::Outcome some = run("dma_hurried");
  BOOST_TEST(some.exit_code == 0, some.err);
  BOOST_TEST(contains(some.out, "Successfully ran AXI DMA interrupt Example"), some.out);
}

// The vendor's examples take UART 0 with the interrupt of UART 1: on a board the only UART is both.
BOOST_AUTO_TEST_CASE(a_board_with_one_uart) {
  const kit::Outcome one = run("uart_only", {"--set", "ps.uart0.enabled=false"});
  BOOST_TEST(one.exit_code == 0, one.err);
  BOOST_TEST(contains(one.out, "Successfully ran Uartps interrupt Example"), one.out);
  const kit::Outcome two = run("uart_only", {"--set", "ps.cpu.timeout=100 ms"});
  BOOST_TEST(two.exit_code == 3);
  BOOST_TEST(contains(two.err, "no end within 100 ms"), two.err);
}

BOOST_AUTO_TEST_CASE(a_watchdog_that_nobody_serves) {
  const kit::Outcome outcome = run("scuwdt_unserved");
  BOOST_TEST(outcome.exit_code == 1);
  BOOST_TEST(contains(outcome.err, "warning: ps.private_timer: the watchdog expired"), outcome.err);
  // It comes while the program sleeps: where it continues is where it slept.
  BOOST_TEST(contains(outcome.err, "called from main (" + project("vitis") + "/scuwdt.c:"),
             outcome.err);
}

BOOST_AUTO_TEST_CASE(runs_are_alike) {
  run("dma_sg_interrupt", scatter_gather);
  const nlohmann::json first = result()["program_end"];
  run("dma_sg_interrupt", scatter_gather);
  BOOST_TEST(first == result()["program_end"]);
}

BOOST_AUTO_TEST_CASE(drivers_of_the_vendor_take_the_place_of_ours) {
  const kit::Outcome outcome = run("gpio_vendor");
  BOOST_TEST(outcome.exit_code == 0, outcome.out + outcome.err);
  BOOST_TEST(contains(outcome.out, "another driver, write 6\nSuccessfully ran Gpio Example"),
             outcome.out);
  BOOST_TEST(!contains(run("gpio").out, "another driver"));
}

BOOST_AUTO_TEST_CASE(a_vendor_folder_that_is_none) {
  for (const char* folder : {"nowhere", "../vitis"}) {
    const kit::Outcome outcome = installed.configure(project("vitis"), "vitis_refused",
                                                     {std::string("-DVENDOR_FOLDER=") + folder});
    BOOST_TEST(outcome.exit_code != 0);
    BOOST_TEST(contains(outcome.err, folder), outcome.err);
    BOOST_TEST(contains(outcome.err, "no driver of"), outcome.err);
  }
}

// An empty variable is reported, rather than built with our drivers.
BOOST_AUTO_TEST_CASE(a_vendor_folder_without_name) {
  const kit::Outcome outcome =
      installed.configure(project("vitis"), "vitis_refused", {"-DVENDOR_FOLDER="});
  BOOST_TEST(outcome.exit_code != 0);
  BOOST_TEST(contains(outcome.err, "[VENDOR_BSP folder]"), outcome.err);
}

BOOST_AUTO_TEST_CASE(what_is_not_modelled_does_not_build) {
  for (const auto& [program, says] :
       {std::pair{"multichannel", "AXI DMA has no multichannel mode"},
        {"card", "ff.h: There is no card in the platform's SDIO controllers"},
        {"serial", "xuartlite.h: The device is modelled, but its driver is not part of"}}) {
    const kit::Outcome outcome = installed.build_target("vitis", program);
    BOOST_TEST(outcome.exit_code != 0, program);
    BOOST_TEST(contains(outcome.out + outcome.err, says), outcome.out);
  }
}

BOOST_AUTO_TEST_CASE(calls_for_whole_caches) {
  const kit::Outcome outcome = run("whole_cache");
  BOOST_TEST(outcome.exit_code == 0, outcome.out + outcome.err);
  BOOST_TEST(contains(outcome.out, "0 warnings expected"), outcome.out);
  BOOST_TEST(!contains(outcome.err, "warning"), outcome.err);
}

BOOST_AUTO_TEST_SUITE_END()

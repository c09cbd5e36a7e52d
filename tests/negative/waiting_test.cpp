// A program that waits in vain: the message says which bit of which register stops it, and the call
// that would set it.
#include <boost/test/unit_test.hpp>

#include "command_line.h"

using namespace negative;

namespace {

struct Waiting : CommandLine {
  /// Runs the program with that mistake, and returns its message.
  std::string told(int mistake) const {
    const kit::Outcome outcome =
        start({"run", "--no-pictures", "--no-report", "--program", MARKERVP_WAITING, "--set",
               "ps.cpu.timeout=2 ms", "--set", "sw.mistake=" + std::to_string(mistake)});
    BOOST_TEST(outcome.exit_code == (mistake == 0 ? 0 : 3), outcome.err);
    return outcome.err;
  }
  void tells(int mistake, const Words& parts) const {
    const std::string text = told(mistake);
    for (const std::string& part : parts)
      BOOST_TEST(contains(text, part),
                 "mistake " << mistake << ": no '" << part << "' in " << text);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(waiting, Waiting)

BOOST_AUTO_TEST_CASE(nothing_keeps_it) {
  BOOST_TEST(!contains(told(0), "but it is"));
}

BOOST_AUTO_TEST_CASE(what_the_interrupt_controller_stops) {
  const std::string timer = "interrupt 29 (ps.private_timer.irq) ";
  tells(1, {timer, "bit 29 of ICDISER0 is 0", "XScuGic_Enable(&gic, 29)"});
  tells(2, {"interrupt 61 (", "has been high since", "bit 29 of ICDISER1 is 0",
            "29 is enabled instead", "XScuGic_Enable(&gic, 61)"});
  tells(3,
        {timer, "its priority 0xF8 is masked by ICCPMR, 0xF0", "XScuGic_SetPriorityTriggerType"});
  tells(6, {timer, "was acknowledged and never ended", "ICCEOIR"});
  tells(7, {timer, "the distributor is off, bit 0 of ICDDCR is 0"});
}

BOOST_AUTO_TEST_CASE(what_the_cpu_masks) {
  tells(4, {"IRQ is masked in the CPU: call Xil_ExceptionEnable()"});
}

BOOST_AUTO_TEST_CASE(what_the_device_keeps) {
  tells(5, {"private_timer reached 0, and bit 2 of CONTROL (IRQ_Enable) is 0",
            "XScuTimer_EnableInterrupt"});
}

// A program that polls has no use for the interrupt of what it polls.
BOOST_AUTO_TEST_CASE(an_interrupt_is_missed_only_where_one_is_waited_for) {
  const std::string call = "XAxiDma_IntrEnable";
  const std::string polls = told(12);
  BOOST_TEST(contains(polls, "axi_dma_0 MM2S stopped with an error, DMADecErr"), polls);
  BOOST_TEST(!contains(polls, call), polls);
  tells(13, {"axi_dma_0.MM2S_DMASR has 0x00005000 set", call});
}

BOOST_AUTO_TEST_CASE(why_a_dma_does_not_end) {
  tells(8, {"axi_dma_1 S2MM is not started, bit 0 of S2MM_DMACR (RS) is 0"});
  tells(9, {"axi_dma_1 S2MM runs, but S2MM_LENGTH was never written"});
  tells(11, {"axi_dma_0 MM2S has a transfer under way", "holds TREADY low"});
  tells(10, {"axi_dma_1 S2MM has a transfer under way", "TVALID is low"});
}

BOOST_AUTO_TEST_SUITE_END()

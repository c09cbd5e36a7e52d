// The IP of the shelf, each alone on a bus: central DMA, clocking wizard, XADC wizard.
#include <boost/test/unit_test.hpp>
#include <sstream>
#include <string>

#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/axi_cdma/axi_cdma.h>
#include <xilinx/clk_wiz/clk_wiz.h>
#include <xilinx/xadc_wiz/xadc_wiz.h>
#include "bus_master.h"
#include "memory_target.h"

using kit::BusMaster;

namespace {

constexpr std::uint64_t period = 10'000;  // ps: 100 MHz

struct Bench : kit::Simulation {
  Bench() { reports.redirect(text); }
  bool said(const char* words) const { return text.str().find(words) != std::string::npos; }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster master{"master"};
  std::ostringstream text;
  vp::ReportRouter reports;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(shelf_clocks)

BOOST_AUTO_TEST_CASE(cdma_copies_and_interrupts) {
  using namespace axi_cdma;
  for (const bool direct : {true, false}) {
    Bench b;
    kit::MemoryTarget memory("memory", 0x4000);
    memory.allow_dmi = direct;
    xilinx::AxiCdma cdma("axi_cdma_0", b.clock);
    cdma.m_axi.link.socket.bind(memory.socket);
    b.master.socket.bind(cdma.s_axi_lite.socket);
    for (unsigned i = 0; i < 256; ++i) memory.data()[0xFF0 + i] = static_cast<unsigned char>(i);
    b.master.simulate([&] {
      b.master.write(CDMACR, cdmacr::Reset);
      BOOST_TEST(b.master.read(CDMACR) == 0x10000u);
      b.master.write(CDMACR, cdmacr::IOC_IrqEn);
      b.master.write(SA, 0xFF0);
      b.master.write(DA, 0x2004);
      b.master.write(BTT, 256);
      BOOST_TEST((b.master.read(CDMASR) & cdmasr::Idle) == 0u);
      b.master.write(BTT, 256);  // ignored
      while (!cdma.cdma_introut.get()) BusMaster::wait_until(b.scheduler.now_ps() + period);
      BOOST_TEST(b.master.read(CDMASR) == (cdmasr::IOC_Irq | cdmasr::Idle));
      b.master.write(CDMASR, cdmasr::IOC_Irq);
      BOOST_TEST(!cdma.cdma_introut.get());
    });
    for (unsigned i = 0; i < 256; ++i) BOOST_TEST(memory.data()[0x2004 + i] == i);
    BOOST_TEST(b.said("BTT written during a transfer"));
    // 36 clocks to begin, 64 words, and a burst more at the boundary of 4 KiB: 80 to 120 clocks.
    if (direct) BOOST_TEST(b.scheduler.now_ps() < 125 * period);
  }
}

BOOST_AUTO_TEST_CASE(cdma_reports_what_fails) {
  using namespace axi_cdma;
  Bench b;
  kit::MemoryTarget memory("memory", 0x4000);
  memory.allow_dmi = false;
  memory.answer = tlm::TLM_ADDRESS_ERROR_RESPONSE;
  xilinx::AxiCdma cdma("axi_cdma_0", b.clock);
  cdma.m_axi.link.socket.bind(memory.socket);
  b.master.socket.bind(cdma.s_axi_lite.socket);
  b.master.simulate([&] {
    b.master.write(SA, 2);
    b.master.write(BTT, 8);
    BOOST_TEST((b.master.read(CDMASR) & cdmasr::DMAIntErr) != 0u);
    b.master.write(CDMACR, cdmacr::Reset);
    b.master.write(BTT, 8);
    BusMaster::wait_until(100 * period);
    BOOST_TEST(b.master.read(CDMASR) == (cdmasr::DMADecErr | cdmasr::Err_Irq | cdmasr::Idle));
  });
}

BOOST_AUTO_TEST_CASE(clk_wiz_follows_its_factors) {
  using namespace clk_wiz;
  Bench b;
  xilinx::ClkWizBuild build;
  build.multiply = 9'125;
  build.divide = {36'500, 8'000};
  xilinx::ClkWiz wizard("clk_wiz_0", b.clock, build);
  b.master.socket.bind(wizard.s_axi_lite.socket);
  BOOST_TEST(wizard.clk_out(0).frequency_hz() == 25'000'000u);
  BOOST_TEST(wizard.clk_out(1).frequency_hz() == 114'062'500u);
  b.master.simulate([&] {
    BOOST_TEST(b.master.read(SR) == sr_LOCKED);
    BOOST_TEST(b.master.read(CCR0) == (1u | 9u << ccr0::MULT_shift | 125u << ccr0::FRAC_shift));
    b.master.write(CCR2, 10);
    BOOST_TEST(wizard.clk_out(0).frequency_hz() == 25'000'000u, "not loaded yet");
    b.master.write(CCR23, ccr23::LOAD | ccr23::SADDR);
    BOOST_TEST(b.master.read(SR) == 0u);
    BOOST_TEST(wizard.clk_out(0).frequency_hz() == 0u);
    BusMaster::wait_until(100'100'000);
    BOOST_TEST(b.master.read(SR) == sr_LOCKED);
    BOOST_TEST(wizard.clk_out(0).frequency_hz() == 91'250'000u);
    b.master.write(CCR0, 1 | 20u << ccr0::MULT_shift);
    b.master.write(CCR23, ccr23::LOAD);
    BusMaster::wait_until(300'000'000);
    BOOST_TEST(b.master.read(SR) == 0u, "2 GHz: it does not lock");
    b.master.write(SRR, reset_key);
    BusMaster::wait_until(500'000'000);
    BOOST_TEST(wizard.clk_out(0).frequency_hz() == 25'000'000u);
  });
  BOOST_TEST(b.said("it does not lock"));
}

BOOST_AUTO_TEST_CASE(clk_wiz_refuses_what_no_mmcm_makes) {
  Bench b;
  xilinx::ClkWizBuild build;
  build.multiply = 5'000;
  BOOST_CHECK_THROW(xilinx::ClkWiz("low", b.clock, build), vp::InputError);
  build = {};
  build.divide.assign(8, 10'000);
  BOOST_CHECK_THROW(xilinx::ClkWiz("many", b.clock, build), vp::InputError);
}

BOOST_AUTO_TEST_CASE(xadc_wiz_measures_both_signs_where_its_build_says_so) {
  Bench b;
  xilinx::XadcWizBuild build;
  build.initial = {{0x41, 0x2000}, {0x4D, 1}};
  xilinx::XadcWiz wizard("xadc_wiz_0", b.clock, build);
  for (const unsigned channel : {0u, 1u}) wizard.set_input(board::Xadc::vaux_0 + channel, -0.25);
  BOOST_TEST(wizard.converter.read(board::Xadc::vaux_0) == 0xC000u);
  BOOST_TEST(wizard.converter.read(board::Xadc::vaux_0 + 1) == 0u, "it is unipolar");
  wizard.set_input(board::Xadc::vaux_0, 0.75);
  BOOST_TEST(wizard.converter.read(board::Xadc::vaux_0) == 0x7FF0u, "its end");
  wizard.converter.write(0x41, 0x3000);  // a single channel: bit 10 of register 0x40 says it
  BOOST_TEST(wizard.converter.read(board::Xadc::vaux_0) == 0xC000u);
}

BOOST_AUTO_TEST_CASE(xadc_wiz_has_a_pin_for_each_alarm) {
  Bench b;
  xilinx::XadcWizBuild build;
  // 85 and 60 degrees for the die; the limits of the voltages let everything pass.
  build.initial = {{0x41, 0x2000}, {0x50, 0xB5ED}, {0x54, 0xA93A}};
  for (const unsigned upper : {0x51u, 0x52u, 0x58u, 0x59u, 0x5Au, 0x5Bu})
    build.initial[upper] = 0xFFFF;
  xilinx::XadcWiz wizard("xadc_wiz_0", b.clock, build);
  wizard.set_input(board::Xadc::temperature, 70);
  BOOST_TEST(!wizard.alarm_out.get());
  wizard.set_input(board::Xadc::temperature, 90);
  BOOST_TEST(wizard.alarm_out.get());
  BOOST_TEST(wizard.alarm[0].get());
  BOOST_TEST(!wizard.alarm[1].get());
  BOOST_TEST(std::string(wizard.alarm[0].basename()) == "user_temp_alarm_out");
  std::uint32_t word = 0xFFFF;
  vp::Register& limit = wizard.s_axi_lite[xadc_wiz::drp + 4 * 0x50];
  wizard.s_axi_lite.access(limit, false, xadc_wiz::drp + 4 * 0x50, word);
  BOOST_TEST(!wizard.alarm_out.get(), "software moves the limit");
}

BOOST_AUTO_TEST_CASE(xadc_wiz_shows_inputs_and_ends_of_sequences) {
  using namespace xadc_wiz;
  Bench b;
  xilinx::XadcWizBuild build;
  build.sequence_channels = 2;
  xilinx::XadcWiz wizard("xadc_wiz_0", b.clock, build);
  wizard.converter.set(board::Xadc::vaux_0, 0.5);
  b.master.socket.bind(wizard.s_axi_lite.socket);
  b.master.simulate([&] {
    BOOST_TEST((b.master.read(SR) & (sr::EOC | sr::EOS)) == 0u);
    BOOST_TEST(b.master.read(drp + 4 * board::Xadc::vaux_0) == 0x8000u);
    BusMaster::wait_until(110 * period);  // a conversion takes 104 clocks
    BOOST_TEST((b.master.read(SR) & (sr::EOC | sr::EOS)) == sr::EOC);
    BusMaster::wait_until(215 * period);
    BOOST_TEST((b.master.read(SR) & (sr::EOC | sr::EOS)) == (sr::EOC | sr::EOS));
    BOOST_TEST((b.master.read(SR) & (sr::EOC | sr::EOS)) == 0u, "a read clears");
    b.master.write(GIER, gier_GIE);
    b.master.write(IPIER, event_EOS);
    BusMaster::wait_until(410 * period);
    BOOST_TEST(!wizard.ip2intc_irpt.get());
    BusMaster::wait_until(420 * period);
    BOOST_TEST(wizard.ip2intc_irpt.get());
  });
}

BOOST_AUTO_TEST_SUITE_END()

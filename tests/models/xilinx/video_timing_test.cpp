// Video timing controller: generator, detector, registers.
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <string>

#include <vp/error.h>
#include <xilinx/v_tc/v_tc.h>
#include "bus_master.h"
#include "input_error.h"
#include "video_bench.h"

using video_bench::Bench;
using video_bench::fixed_generator;
using video_bench::line_active;
using video_bench::line_blank;
using video_bench::Scope;
using video_bench::small_timing;
using video_bench::times;

BOOST_AUTO_TEST_SUITE(video_timing)

BOOST_AUTO_TEST_CASE(a_generator_without_registers_runs_from_the_first_clock) {
  Bench b;
  xilinx::VTc tc("tc", b.pixel_clk, fixed_generator());
  Scope scope("scope", b.pixel_clk);
  for (vp::Signal<bool>* wire :
       {&tc.active_video_out, &tc.hsync_out, &tc.hblank_out, &tc.vsync_out, &tc.vblank_out})
    scope.look_at(*wire);
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  b.run(121);
  // The scope sees on its clock n what the generator drove on clock n - 1: the first one is rest.
  const std::string frame_active = times(3, line_active) + times(3, line_blank);
  BOOST_TEST(scope.seen[0] == "0" + times(2, frame_active));
  BOOST_TEST(scope.seen[1] == "0" + times(12, "0000000110"));
  BOOST_TEST(scope.seen[2] == "1" + times(12, "0000001111"));
  BOOST_TEST(scope.seen[3] ==
             "0" + times(2, times(3, line_blank) + "0000000111" + "1111111000" + line_blank));
  BOOST_TEST(scope.seen[4] == "1" + times(2, times(2, line_blank) + "0000001111" +
                                                 times(2, "1111111111") + "1111110000"));
}

BOOST_AUTO_TEST_CASE(a_generator_waits_while_its_clock_is_not_enabled) {
  Bench b;
  xilinx::VTc tc("tc", b.pixel_clk, fixed_generator());
  vp::Signal<bool> enable("enable", 1, true);
  tc.gen_clken(enable);
  Scope scope("scope", b.pixel_clk);
  scope.look_at(tc.active_video_out);
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  b.run(3);  // pixels 0 to 2 are out
  enable = false;
  b.run(5);
  enable = true;
  b.run(10);
  BOOST_TEST(scope.seen[0] == "0111" + times(5, "1") + "11100001" + "1");
}

BOOST_AUTO_TEST_CASE(software_sets_a_frame_and_takes_its_interrupts) {
  using namespace v_tc;
  Bench b;
  xilinx::VTcBuild build;
  build.detect = false;
  build.timing = small_timing();
  build.frame_sync[0] = {2, 4};
  xilinx::VTc tc("tc", b.pixel_clk, build);
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  constexpr std::uint64_t period = 20'000;
  bus.simulate([&] {
    BOOST_TEST(bus.read(VERSION) != 0u);
    BOOST_TEST(bus.read(GENERATOR_ACTIVE_SIZE) == 0x00030006u);
    BOOST_TEST(bus.read(GENERATOR_HSYNC) == 0x00090007u);
    kit::BusMaster::wait_until(100 * period);
    BOOST_TEST(!tc.active_video_out.get());  // off
    bus.write(IRQ_ENABLE, irq::GEN_VBLANK | 1u << irq::FSYNC_shift);
    bus.write(CONTROL, control::GEN_ENABLE | control::REG_UPDATE);
    // Clock 101 shows pixel 0; the sync is at line 2, clock 4, and the blank at clock 6.
    kit::BusMaster::wait_until(124 * period);
    BOOST_TEST(!tc.irq.get());
    kit::BusMaster::wait_until(125 * period);
    BOOST_TEST(tc.irq.get());
    BOOST_TEST(bus.read(STATUS) == (irq::GEN_ACTIVE_VIDEO | 1u << irq::FSYNC_shift));
    bus.write(STATUS, 1u << irq::FSYNC_shift);
    BOOST_TEST(!tc.irq.get());
    kit::BusMaster::wait_until(127 * period);
    BOOST_TEST(tc.irq.get());
    BOOST_TEST((bus.read(STATUS) & irq::GEN_VBLANK) != 0u);
    BOOST_TEST((bus.read(GENERATOR_TIMING_STATUS) & timing::VBLANK) != 0u);
    // Five pixels a line from the next frame on, whose pixel 0 shows on clock 161.
    bus.write(GENERATOR_ACTIVE_SIZE, 0x00030005);
    kit::BusMaster::wait_until(160 * period);
    BOOST_TEST(tc.timing().hactive == 6u);
    kit::BusMaster::wait_until(161 * period);
    BOOST_TEST(tc.timing().hactive == 5u);
    bus.write(GENERATOR_HSIZE, 3);  // no frame
    kit::BusMaster::wait_until(222 * period);
    BOOST_TEST(tc.timing().htotal == 10u);
    bus.write(CONTROL, control::SW_RESET);
    BOOST_TEST(bus.read(GENERATOR_HSIZE) == 10u);
    BOOST_TEST(bus.read(CONTROL) == 0u);
    kit::BusMaster::wait_until(230 * period);
    BOOST_TEST(!tc.active_video_out.get());
  });
  BOOST_TEST(b.said("describe no frame"));
}

BOOST_AUTO_TEST_CASE(a_detector_finds_what_a_generator_sends) {
  using namespace v_tc;
  Bench b;
  xilinx::VTcBuild from = fixed_generator();
  from.polarity &= ~polarity::VSYNC;
  xilinx::VTc source("source", b.pixel_clk, from);
  xilinx::VTcBuild build;
  build.timing = small_timing();
  xilinx::VTc tc("tc", b.pixel_clk, build);
  vp::Signal<bool> enable("enable", 1, true);
  source.gen_clken(enable);
  tc.hsync_in(source.hsync_out);
  tc.vsync_in(source.vsync_out);
  tc.active_video_in(source.active_video_out);
  kit::BusMaster bus("bus"), unused("unused");
  bus.socket.bind(tc.ctrl.socket);
  unused.socket.bind(source.ctrl.socket);
  constexpr std::uint64_t period = 20'000;
  bus.simulate([&] {
    bus.write(IRQ_ENABLE, irq::DET_LOCK | irq::DET_LOCK_LOSS);
    bus.write(CONTROL, control::DET_ENABLE | control::SW_ENABLE);
    // Frames begin on clocks 1, 61 and so on. The first one comes without a sync before it, so the
    // one on 181, seen on 182, is the end of the second whole one.
    kit::BusMaster::wait_until(181 * period);
    BOOST_TEST(!tc.irq.get());
    BOOST_TEST(bus.read(DETECTOR_TIMING_STATUS) % 2 == 0u);
    kit::BusMaster::wait_until(182 * period);
    BOOST_TEST(tc.irq.get());
    BOOST_TEST((bus.read(STATUS) & irq::DET_LOCK) != 0u);
    BOOST_TEST((bus.read(DETECTOR_TIMING_STATUS) & timing::LOCKED) != 0u);
    BOOST_TEST(bus.read(DETECTOR_ACTIVE_SIZE) == 0x00030006u);
    BOOST_TEST(bus.read(DETECTOR_HSIZE) == 10u);
    BOOST_TEST(bus.read(DETECTOR_VSIZE) == 6u);
    BOOST_TEST(bus.read(DETECTOR_HSYNC) == 0x00090007u);
    BOOST_TEST(bus.read(DETECTOR_F0_VSYNC_V) == 0x00040003u);
    BOOST_TEST(bus.read(DETECTOR_F0_VSYNC_H) == 0x00070007u);
    BOOST_TEST(bus.read(DETECTOR_POLARITY) ==
               (polarity::ACTIVE_VIDEO | polarity::HSYNC | polarity::HBLANK));
    bus.write(STATUS, irq::all);
    enable = false;  // nothing comes any more
    kit::BusMaster::wait_until(500 * period);
    BOOST_TEST((bus.read(STATUS) & irq::DET_LOCK_LOSS) != 0u);
    BOOST_TEST((bus.read(DETECTOR_TIMING_STATUS) & timing::LOCKED) == 0u);
    BOOST_TEST(bus.read(ERROR) != 0u);
  });
}

BOOST_AUTO_TEST_CASE(a_timing_without_blanks_is_refused) {
  Bench b;
  xilinx::VTcBuild build = fixed_generator();
  build.timing.hactive = build.timing.htotal;
  const std::string problem = input_error([&] { xilinx::VTc tc("tc", b.pixel_clk, build); });
  BOOST_TEST(problem.find("active pixels and lines must be fewer") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_is_not_modelled_is_warned_of) {
  using namespace v_tc;
  Bench b;
  xilinx::VTc tc("tc", b.pixel_clk);
  kit::BusMaster bus("bus");
  bus.socket.bind(tc.ctrl.socket);
  bus.simulate([&] { bus.write(CONTROL, control::GEN_ENABLE | control::SYNC_ENABLE); });
  BOOST_TEST(b.said("SYNC_ENABLE"));
}

BOOST_AUTO_TEST_SUITE_END()

// What the device and its clock generators change of a platform.
#include <chip/cost/zynq_power.h>
#include <chip/system/designs.h>
#include <result/console.h>
#include <slcr_registers.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <memory>

#include <vp/configuration.h>
#include <vp/error.h>

#include "simulation.h"

using namespace platform;

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

struct Platform : kit::Simulation {
  explicit Platform(const Settings& settings) {
    for (const auto& [path, value] : settings) configuration.set(path, value);
    const vp::Configuration::Scope scope(configuration);
    zynq = std::make_unique<Zynq>(*builtin_designs().front());
    power = std::make_unique<ZynqPower>("power", *zynq, true);
    timing = std::make_unique<TimingClosure>("timing", power->parts(), zynq->chip.data);
    configuration.check_unused();
  }

  std::uint32_t slcr(std::uint32_t offset) { return zynq->ps.slcr.registers[offset]; }
  facts::ClockReport::Clock clock(const std::string& name) const {
    for (const auto& clock : power->clock_report().clocks) {
      if (clock.name == name) return clock;
    }
    throw std::out_of_range(name);
  }
  facts::TimingReport::Module module(const std::string& name) const {
    for (const auto& module : power->timing_report(*timing).modules) {
      if (module.name == name) return module;
    }
    throw std::out_of_range(name);
  }

  vp::Configuration configuration;
  std::unique_ptr<Zynq> zynq;
  std::unique_ptr<ZynqPower> power;
  std::unique_ptr<TimingClosure> timing;
};

const auto near = boost::test_tools::tolerance(1e-9);

double static_w(const Settings& settings) {
  return Platform(settings).power->power_report(1'000'000'000).static_w;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(chip)

BOOST_AUTO_TEST_CASE(the_thesis_clocks_are_what_they_were) {
  for (const char* mode : {"made", "exact"}) {
    for (const char* device : {"xc7z020-1", "xc7z010", "xc7z020-3"}) {
      Platform p(Settings{{"clocks", mode}, {"device", device}});
      BOOST_TEST(p.zynq->ps.cpu_clk.clk.frequency_hz() == 666'666'667u);
      BOOST_TEST(p.zynq->ps.fclk_clk0.clk.frequency_hz() == 100'000'000u);
      BOOST_TEST(p.zynq->ps.fclk_clk1.clk.frequency_hz() == 50'000'000u);
      BOOST_TEST(p.zynq->ps.uart1_ref_clk.frequency_hz() == 50'000'000u);
      const facts::ClockReport report = p.power->clock_report();
      BOOST_TEST(report.legal);
      BOOST_TEST(result::clock_text(report) == "");
      BOOST_TEST(result::clock_warnings(report).empty());
    }
  }
}

BOOST_AUTO_TEST_CASE(registers_show_the_plan) {
  Platform p(Settings{{"ps.fclk_clk1.frequency", "55 MHz"}, {"ps.ethernet", "false"}});
  BOOST_TEST(p.zynq->ps.fclk_clk1.clk.frequency_hz() == 55'172'414u);
  BOOST_TEST(p.slcr(slcr::IO_PLL_CTRL) == 0x0003'0008u);     // x 48
  BOOST_TEST(p.slcr(slcr::FPGA1_CLK_CTRL) == 0x0010'1D00u);  // / 29 / 1
  BOOST_TEST(p.zynq->ps.slcr.programmed_fclk_hz(1) == 55'172'414u);
  BOOST_TEST(p.zynq->ps.fclk_clk0.clk.frequency_hz() == 100'000'000u);
  BOOST_TEST(p.zynq->ps.uart1_ref_clk.frequency_hz() == 50'000'000u);
  BOOST_TEST(p.zynq->ps.slcr.cpu_clocks().cpu_6x4x == 666'666'667u);
}

BOOST_AUTO_TEST_CASE(a_wish_is_made_as_near_as_the_plls_allow) {
  Platform p(Settings{{"ps.fclk_clk1.frequency", "160 MHz"},
                      {"ps.cpu_clk.frequency", "1 GHz"},
                      {"power.ddr.frequency", "520 MHz"}});
  const auto pixel = p.clock("ps.fclk_clk1");
  BOOST_TEST(pixel.wish_mhz == 160.0);
  BOOST_TEST(pixel.frequency_mhz == 166.666667, near);
  BOOST_TEST(pixel.below_mhz == 1000.0 / 7, near);
  BOOST_TEST(pixel.within);
  BOOST_TEST(pixel.makeable);
  const auto cpu = p.clock("ps.cpu_clk");
  BOOST_TEST(cpu.frequency_mhz == 800.0);
  BOOST_TEST(!cpu.within);
  BOOST_TEST(cpu.margin_percent == -16.625, near);
  const auto ddr = p.clock("power.ddr");
  BOOST_TEST(ddr.frequency_mhz == 516.666667, near);
  const facts::ClockReport report = p.power->clock_report();
  BOOST_TEST(!report.legal);
  BOOST_TEST(result::clock_warnings(report).size() == 1u);
}

BOOST_AUTO_TEST_CASE(clocks_of_a_pl_that_is_not_configured_are_judged_by_nothing) {
  for (const char* configured : {"true", "false"}) {
    Platform p(Settings{{"ps.fclk_clk1.frequency", "400 MHz"}, {"power.pl_design", configured}});
    const bool used = configured == std::string("true");
    BOOST_TEST(!p.clock("ps.fclk_clk1").within);
    BOOST_TEST(p.clock("ps.fclk_clk1").used == used);
    BOOST_TEST(p.clock("ps.cpu_clk").used);
    BOOST_TEST(p.power->clock_report().legal == !used);
  }
}

BOOST_AUTO_TEST_CASE(exact_clocks_are_kept_and_called_impossible) {
  Platform p(Settings{{"ps.fclk_clk1.frequency", "74.2512 MHz"}, {"clocks", "exact"}});
  const auto pixel = p.clock("ps.fclk_clk1");
  BOOST_TEST(pixel.frequency_mhz == 74.2512, near);
  BOOST_TEST(pixel.made_mhz == 1000.0 / 13, near);
  BOOST_TEST(!pixel.makeable);
  BOOST_TEST(!p.power->clock_report().legal);
  BOOST_TEST(p.slcr(slcr::IO_PLL_CTRL) == 0x0001'E008u);
}

BOOST_AUTO_TEST_CASE(a_clock_that_software_sets_is_judged_too) {
  Platform p(Settings{});
  sc_core::sc_start(vp::from_ps(1'000'000));
  p.zynq->ps.fclk_clk1.clk.set_frequency(333'333'333);
  p.zynq->ps.cpu_clk.clk.set_frequency(800'000'000);
  sc_core::sc_start(vp::from_ps(1'000'000));
  p.zynq->ps.fclk_clk1.clk.set_frequency(50'000'000);
  BOOST_TEST(!p.clock("ps.fclk_clk1").within);
  BOOST_TEST(!p.clock("ps.cpu_clk").within);
  BOOST_TEST(p.clock("ps.fclk_clk0").within);
}

BOOST_AUTO_TEST_CASE(a_smaller_chip_holds_less) {
  Platform p(Settings{{"device", "xc7z010"}});
  const facts::ResourceReport resources = p.power->resource_report();
  BOOST_TEST(resources.device == "xc7z010");
  BOOST_TEST(resources.available.lut == 17'600.0);
  BOOST_TEST(resources.over == std::vector<std::string>{"bram36"});
  BOOST_TEST(p.slcr(slcr::PSS_IDCODE) == 0x0372'2093u);
}

BOOST_AUTO_TEST_CASE(the_usual_chip_has_the_usual_code) {
  BOOST_TEST(Platform(Settings{}).slcr(slcr::PSS_IDCODE) == 0x0372'7093u);
}

// 55 MHz are those of 128 labels: not less with fewer, not more with more. The other end is that of
// synthesis.
BOOST_AUTO_TEST_CASE(fmax_of_blob_detection_moves_with_its_labels) {
  const auto blobs = [](const char* labels, const char* device = "xc7z020-1") {
    return Platform(Settings{{"pl.blob_detection.label_count", labels}, {"device", device}})
        .module("pl.blob_detection");
  };
  for (const char* labels : {"100", "128"}) {
    BOOST_TEST(blobs(labels).fmax_mhz == 55.0);
    BOOST_TEST(blobs(labels).fmax_high_mhz == 55.0);
    BOOST_TEST(blobs(labels).origin == "published");
    BOOST_TEST(blobs(labels).source.find("synthesis of its RTL") != std::string::npos);
  }
  for (const char* labels : {"4", "16", "64"}) {
    BOOST_TEST(blobs(labels).fmax_mhz == 55.0);
    BOOST_TEST(blobs(labels).fmax_high_mhz > 70.0);
    BOOST_TEST(blobs(labels).origin == "synthesised");
  }
  for (const char* labels : {"200", "400"}) {
    BOOST_TEST(blobs(labels).fmax_mhz < 42.0);
    BOOST_TEST(blobs(labels).fmax_high_mhz == 55.0);
    BOOST_TEST(blobs(labels).origin == "synthesised");
  }
  BOOST_TEST(blobs("400").fmax_mhz < blobs("200").fmax_mhz);
  BOOST_TEST(std::abs(blobs("400", "xc7z020-2").fmax_mhz - 1.18 * blobs("400").fmax_mhz) < 2e-6);
  BOOST_TEST(blobs("128", "xc7z020-2").origin == "derived");
}

BOOST_AUTO_TEST_CASE(inside_the_range_of_fmax_nobody_knows) {
  const auto blobs = [](const char* clock) {
    Platform platform(
        Settings{{"pl.blob_detection.label_count", "16"}, {"ps.fclk_clk1.frequency", clock}});
    return platform.module("pl.blob_detection");
  };
  BOOST_TEST(blobs("50 MHz").met);
  BOOST_TEST(blobs("62.5 MHz").unknown());
  BOOST_TEST(!blobs("62.5 MHz").missed());
  BOOST_TEST(blobs("100 MHz").missed());
}

BOOST_AUTO_TEST_CASE(a_limit_of_the_users_own_is_one_or_a_range) {
  const auto corners = [](const Settings& settings) {
    return Platform(settings).module("pl.corner_detection");
  };
  const auto one = corners({{"timing.corner_detection.fmax", "120 MHz"}});
  BOOST_TEST(one.fmax_high_mhz == 120.0);
  BOOST_TEST(one.origin == "configuration");
  const auto range = corners({{"timing.corner_detection.fmax", "120 MHz"},
                              {"timing.corner_detection.fmax_high", "150 MHz"}});
  BOOST_TEST(range.fmax_high_mhz == 150.0);
  BOOST_CHECK_THROW(corners({{"timing.corner_detection.fmax_high", "90 MHz"}}), vp::InputError);
}

BOOST_AUTO_TEST_CASE(a_clock_beyond_its_limit_has_a_nearest_that_is_legal) {
  const auto legal = [](const char* device, const char* path, const char* wish, const char* clock) {
    return Platform(Settings{{"device", device}, {path, wish}}).clock(clock).legal_mhz;
  };
  BOOST_TEST(std::abs(legal("xc7z020-1", "ps.cpu_clk.frequency", "2 GHz", "ps.cpu_clk") -
                      666.666667) < 1e-5);
  BOOST_TEST(std::abs(legal("xc7z020-3", "ps.cpu_clk.frequency", "2 GHz", "ps.cpu_clk") -
                      866.666667) < 1e-5);
  BOOST_TEST(legal("xc7z020-1", "ps.fclk_clk0.frequency", "400 MHz", "ps.fclk_clk0") == 250.0);
  BOOST_TEST(legal("xc7z020-1", "ps.cpu_clk.frequency", "600 MHz", "ps.cpu_clk") == 0.0);
}

BOOST_AUTO_TEST_CASE(fmax_scales_with_the_speed_grade) {
  for (const auto& [device, factor] :
       {std::pair{"xc7z020-1", 1.0}, std::pair{"xc7z020-2", 1.18}, std::pair{"xc7z020-3", 1.3}}) {
    Platform p(Settings{{"device", device}});
    const auto blobs = p.module("pl.blob_detection");
    BOOST_TEST(blobs.fmax_mhz == 55 * factor, near);
    const bool scaled = factor != 1;
    BOOST_TEST((blobs.source.find("derived") == 0) == scaled, blobs.source);
    BOOST_TEST((blobs.source.find(device) != std::string::npos) == scaled, blobs.source);
  }
  // What the user says of a module is said of this chip.
  Platform own(Settings{{"device", "xc7z020-2"}, {"timing.blob_detection.fmax", "60 MHz"}});
  BOOST_TEST(own.module("pl.blob_detection").fmax_mhz == 60.0);
}

BOOST_AUTO_TEST_CASE(what_is_advised_can_be_made_and_is_within_the_speed_grade) {
  {
    const Platform usual(Settings{});
    BOOST_TEST(usual.module("pl.blob_detection").reachable_mhz == 1000.0 / 19, near);
    BOOST_TEST(usual.module("pl.corner_detection").reachable_mhz == 100.0, near);
  }
  const Platform fast(
      Settings{{"timing.blob_detection.fmax", "400 MHz"}, {"ps.ethernet", "false"}});
  BOOST_TEST(fast.module("pl.blob_detection").reachable_mhz == 1600.0 / 7, near);
}

BOOST_AUTO_TEST_CASE(power_follows_the_chip) {
  // At the same temperature the smaller die leaks 0.874 of the larger, and the same memories as
  // much as there; it stays cooler, too.
  const double large = static_w(Settings{}), small = static_w(Settings{{"device", "xc7z010"}});
  BOOST_TEST(small < large * 0.90);
  BOOST_TEST(small > large * 0.80);
  BOOST_TEST(static_w(Settings{{"device", "xc7z020-3"}}) == large);
  // The vendor bills two cores on a device that has one, too: each of 666.67 MHz x 0.415 nJ, half
  // of the time.
  const auto cores_w = [](const char* device) {
    const Platform platform(Settings{{"device", device}});
    for (const auto& module : platform.power->power_report(1'000'000'000).modules) {
      if (module.name == "ps.cores") return module.w;
    }
    return 0.0;
  };
  BOOST_TEST(cores_w("xc7z007s") == 666.666667e6 * 0.415e-9, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(cores_w("xc7z010") == cores_w("xc7z007s"));
}

BOOST_AUTO_TEST_CASE(what_nobody_sells_is_refused) {
  BOOST_CHECK_THROW(Platform(Settings{{"device", "xc7z045"}}), vp::InputError);
  BOOST_CHECK_THROW(Platform(Settings{{"device", "xc7z007s-3"}}), vp::InputError);
  BOOST_CHECK_THROW(Platform(Settings{{"clocks", "nearly"}}), vp::InputError);
  BOOST_CHECK_THROW(Platform(Settings{{"ps.slcr.ps_clk", "61 MHz"}}), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()

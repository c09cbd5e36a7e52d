// Energy of the platform without a program: clocks and states are set by hand.
#include <chip/cost/zynq_power.h>
#include <chip/system/designs.h>
#include <marker/designs/marker/marker_design.h>
#include <result/console.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <vp/configuration.h>
#include <vp/error.h>

#include "simulation.h"

using namespace platform;

namespace {

constexpr std::uint64_t ms = 1'000'000'000;
const auto near = boost::test_tools::tolerance(1e-9);

using Settings = std::vector<std::pair<std::string, std::string>>;

/// The platform with these parameters.
struct Platform : kit::Simulation {
  explicit Platform(const Settings& settings = {}, bool uses_pl = true) {
    for (const auto& [path, value] : settings) configuration.set(path, value);
    const vp::Configuration::Scope scope(configuration);
    zynq = std::make_unique<Zynq>(*builtin_designs().front());
    power = std::make_unique<ZynqPower>("power", *zynq, uses_pl);
    timing = std::make_unique<TimingClosure>("timing", power->parts(), zynq->chip.data);
    configuration.check_unused();
  }

  void run_until(std::uint64_t ps) { sc_core::sc_start(vp::from_ps(ps - kit::now_ps())); }

  /// Energy of the modules in a frame of that time, mJ by module.
  std::map<std::string, double> frame(std::uint64_t from_ps, std::uint64_t to_ps) {
    run_until(to_ps);
    facts::UnitReport report;
    report.start_ps = from_ps;
    report.end_ps = to_ps;
    power->frame_ends(report);
    std::map<std::string, double> mj;
    for (const auto& [module, band] : power->ledger().by_module()) mj[module] = 1e3 * band.nominal;
    return mj;
  }

  vp::Configuration configuration;
  std::unique_ptr<Zynq> zynq;
  std::unique_ptr<ZynqPower> power;
  std::unique_ptr<TimingClosure> timing;
};

MarkerDesign& logic(Platform& platform) {
  return dynamic_cast<MarkerDesign&>(platform.zynq->design());
}

facts::PowerReport report_of(const Settings& settings, bool uses_pl = true) {
  Platform platform(settings, uses_pl);
  platform.frame(0, ms);
  return platform.power->power_report(ms);
}

double module_w(const facts::PowerReport& report, const std::string& name) {
  double sum = 0;
  for (const auto& module : report.modules) sum += module.name == name ? module.w : 0;
  return sum;
}

Settings ps7(const std::string& cpu, const std::string& ddr, const std::string& width,
             const std::string& volts) {
  return {{"ps.cpu_clk.frequency", cpu + " MHz"},
          {"power.ddr.frequency", ddr + " MHz"},
          {"power.ddr.width", width},
          {"power.ddr.voltage", volts}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(zynq_power)

// Reports of xc7z020 designs, by the configuration of the PS.
BOOST_AUTO_TEST_CASE(the_ps_takes_what_the_vendor_says) {
  const auto within = boost::test_tools::tolerance(0.01);
  BOOST_TEST(report_of({}).ps_w == 1.527, within);
  BOOST_TEST(report_of({}, false).ps_w == 1.527, boost::test_tools::tolerance(0.001));
  BOOST_TEST(report_of(ps7("650", "525", "16", "1.5 V"), false).ps_w == 1.256, within);
  BOOST_TEST(report_of(ps7("666.666667", "400", "32", "1.5 V"), false).ps_w == 1.473, within);
  BOOST_TEST(report_of(ps7("666.666667", "533.333333", "32", "1.35 V"), false).ps_w == 1.399,
             within);
}

BOOST_AUTO_TEST_CASE(another_ps_is_noticed) {
  BOOST_TEST(std::abs(report_of(ps7("400", "400", "16", "1.35 V")).ps_w - 1.527) > 0.01 * 1.527);
}

BOOST_AUTO_TEST_CASE(blob_detection_takes_what_the_thesis_says) {
  BOOST_TEST(module_w(report_of({}), "pl.blob_detection") == 0.4, near);
  BOOST_TEST(module_w(report_of({{"power.blob.figure_includes_static", "true"}}),
                      "pl.blob_detection") == 0.295,
             near);
  BOOST_TEST(module_w(report_of({{"pl.blob_detection.label_count", "256"}}), "pl.blob_detection") >
             0.7);
}

BOOST_AUTO_TEST_CASE(the_whole_system_is_that_of_the_estimate) {
  const facts::PowerReport power = report_of({});
  BOOST_TEST(power.total_w == 2.23, boost::test_tools::tolerance(0.01));
  BOOST_TEST(power.junction_c == 51.0, boost::test_tools::tolerance(0.02));
  BOOST_TEST(power.low_w < power.total_w);
  BOOST_TEST(power.total_w < power.high_w);
  const facts::PowerReport idle = report_of({}, false);
  BOOST_TEST(idle.total_w == 1.667, boost::test_tools::tolerance(0.01));
  BOOST_TEST(idle.pl_w == 0.0);
}

BOOST_AUTO_TEST_CASE(the_ledger_adds_up) {
  for (const char* mode : {"vivado-default", "activity"}) {
    const facts::PowerReport power = report_of({{"power.mode", mode}});
    double modules = 0, rails = 0, mj = 0;
    for (const auto& module : power.modules) modules += module.w, mj += module.mj;
    for (const auto& rail : power.rails) rails += rail.second;
    BOOST_TEST(modules == power.total_w, near);
    BOOST_TEST(rails == power.total_w, near);
    BOOST_TEST(power.ps_w + power.pl_w + power.static_w == power.total_w, near);
    BOOST_TEST(mj == power.energy_per_frame_mj, near);
  }
}

BOOST_AUTO_TEST_CASE(static_power_and_temperature_agree) {
  const facts::PowerReport power = report_of({});
  BOOST_TEST(power.junction_c == 25 + 11.5 * power.total_w, near);
  BOOST_TEST(power.static_w == 0.0634 + 0.0399 * std::exp(0.0342 * (power.junction_c - 25)), near);
  BOOST_TEST(report_of({{"power.ambient", "50 C"}}).static_w > power.static_w);
  BOOST_TEST(report_of({{"power.theta_ja", "5"}}).junction_c < power.junction_c);
}

BOOST_AUTO_TEST_CASE(a_thermal_runaway_is_refused_before_anything_runs) {
  BOOST_CHECK_THROW(Platform(Settings{{"power.theta_ja", "60"}}), vp::InputError);
  BOOST_CHECK_THROW(Platform(Settings{{"power.ddr.width", "24"}}), vp::InputError);
  BOOST_CHECK_THROW(Platform(Settings{{"power.table", "none"}}), vp::InputError);
  BOOST_CHECK_THROW(Platform(Settings{{"power.mode", "guess"}}), vp::InputError);
}

BOOST_AUTO_TEST_CASE(the_dynamic_power_of_the_pl_is_linear_in_the_clock) {
  for (const char* mode : {"vivado-default", "activity"}) {
    const auto pl_w = [&](const char* pixel, const char* system) {
      return report_of({{"power.mode", mode},
                        {"ps.fclk_clk1.frequency", pixel},
                        {"ps.fclk_clk0.frequency", system}})
          .pl_w;
    };
    BOOST_TEST(pl_w("100 MHz", "200 MHz") == 2 * pl_w("50 MHz", "100 MHz"), near);
    BOOST_TEST(pl_w("25 MHz", "50 MHz") == 0.5 * pl_w("50 MHz", "100 MHz"), near);
  }
}

BOOST_AUTO_TEST_CASE(a_clock_that_software_changes_is_integrated) {
  Platform platform;
  platform.run_until(ms);
  platform.zynq->ps.fclk_clk1.clk.set_frequency(100'000'000);
  platform.run_until(3 * ms);
  platform.zynq->ps.fclk_clk1.clk.set_frequency(0);
  const double blob_mj = platform.frame(0, 4 * ms).at("pl.blob_detection");
  BOOST_TEST(blob_mj == 8.0e-6 * (50e6 * 0.001 + 100e6 * 0.002), near);
}

BOOST_AUTO_TEST_CASE(what_came_before_a_frame_is_not_in_it) {
  Platform platform;
  platform.run_until(2 * ms);
  platform.zynq->ps.fclk_clk1.clk.set_frequency(100'000'000);
  BOOST_TEST(platform.frame(3 * ms, 4 * ms).at("pl.blob_detection") == 8.0e-6 * 100e6 * 0.001,
             near);
}

BOOST_AUTO_TEST_CASE(the_next_frame_begins_where_the_last_one_ended_without_its_upload) {
  Platform platform;
  platform.frame(0, 2 * ms);
  platform.run_until(10 * ms);
  facts::UnitReport second;
  second.start_ps = 7 * ms;
  second.upload_ps = 4 * ms;  // from 3 to 7 ms
  second.end_ps = 10 * ms;
  platform.power->frame_ends(second);
  double mj = 0;
  for (const auto& part : second.energy) mj += part.mj;
  BOOST_TEST(mj == 4 * platform.power->power_report(0).total_w, near);
}

BOOST_AUTO_TEST_CASE(the_energy_of_a_frame_given_up_is_that_of_the_next_result) {
  Platform platform;
  platform.frame(0, 2 * ms);
  const auto ends = [&](std::uint64_t from_ms, std::uint64_t to_ms, const char* gave_up) {
    platform.run_until(to_ms * ms);
    facts::UnitReport frame;
    frame.start_ps = from_ms * ms;
    frame.end_ps = to_ms * ms;
    frame.gave_up = gave_up;
    platform.power->frame_ends(frame);
    double mj = 0;
    for (const auto& part : frame.energy) mj += part.mj;
    return mj;
  };
  BOOST_TEST(ends(2, 7, "no DMA memory") == 0.0);
  const double both = ends(7, 10, "");
  BOOST_TEST(ends(10, 20, "no DMA memory") == 0.0);
  const facts::PowerReport power = platform.power->power_report(20 * ms);
  BOOST_TEST(both == 8 * power.total_w, near);
  BOOST_TEST(power.energy_per_frame_mj == 10 * power.total_w / 2, near);
}

BOOST_AUTO_TEST_CASE(a_run_that_gave_up_takes_power_and_no_energy_per_frame) {
  const double usual = report_of({}).total_w;
  Platform platform;
  platform.run_until(2 * ms);
  facts::UnitReport frame;
  frame.start_ps = ms;
  frame.end_ps = 2 * ms;
  frame.gave_up = "no DMA memory";
  platform.power->frame_ends(frame);
  const facts::PowerReport power = platform.power->power_report(2 * ms);
  BOOST_TEST(!power.per_frame);
  BOOST_TEST(power.total_w == usual, near);
}

/// A frame of 4 ms in mode `activity`; after the first `change` happens.
facts::PowerReport activity_of(const std::function<void(Zynq&)>& change) {
  // Clock by clock: at transaction level there is no busy sensor without a frame.
  Platform platform(Settings{{"power.mode", "activity"}, {"fidelity", "clocked"}});
  platform.run_until(ms);
  change(*platform.zynq);
  platform.frame(0, 4 * ms);
  return platform.power->power_report(0);
}

BOOST_AUTO_TEST_CASE(idle_is_below_busy) {
  const facts::PowerReport idle = activity_of([](Zynq&) {});
  // What the sensor shows while it plays a frame.
  const facts::PowerReport busy = activity_of([](Zynq& zynq) { *zynq.design().busy() = true; });
  const facts::PowerReport asleep = activity_of([](Zynq& zynq) { zynq.ps.cpu.asleep = true; });
  BOOST_TEST(idle.pl_w < busy.pl_w);
  BOOST_TEST(idle.ps_w == busy.ps_w, near);
  BOOST_TEST(asleep.ps_w < idle.ps_w);
  // A quarter awake at 415 pJ a cycle.
  BOOST_TEST(module_w(asleep, "ps.cores") == 0.25 * module_w(idle, "ps.cores"), near);
  // The frame ran for three quarters: 8 nJ a clock less what the idle clock tree takes.
  const double clock = module_w(idle, "pl.blob_detection");
  BOOST_TEST(module_w(busy, "pl.blob_detection") == clock + 0.75 * (0.4 - clock), near);
}

// A vendor's estimate knows no time: it is the same for an idle chip.
BOOST_AUTO_TEST_CASE(the_vendors_estimate_does_not_look_at_the_load) {
  const double usual = report_of({}).total_w;
  Platform platform;
  platform.zynq->ps.cpu.asleep = true;
  platform.frame(0, ms);
  BOOST_TEST(platform.power->power_report(0).total_w == usual, near);
}

BOOST_AUTO_TEST_CASE(events_take_their_energy) {
  Platform platform(Settings{{"power.mode", "activity"}});
  platform.power->frame_begins();
  logic(platform).bram.reads_b.add(1'000'000);
  BOOST_TEST(platform.frame(0, ms).at("pl.bram") > 8.5e-3 * 0.999);
  BOOST_TEST(platform.power->ledger().by_kind().at(vp::PowerKind::event).nominal == 8.5e-6, near);
}

// By direct access, as nearly all of it goes: the DDR itself sees none of that.
BOOST_AUTO_TEST_CASE(what_a_dma_writes_takes_its_energy) {
  const auto mj_of = [](std::uint64_t bytes) {
    Platform platform(Settings{{"power.mode", "activity"}});
    platform.power->frame_begins();
    vp::MmLink& link = logic(platform).axi_dma_1.s2mm().m_axi.link;
    link.account(tlm::TLM_WRITE_COMMAND, ps::Ddr::base, bytes);
    return platform.frame(0, ms);
  };
  auto idle = mj_of(0), once = mj_of(38'400), twice = mj_of(2 * 38'400);
  for (const char* module : {"pl.axi_dma_1", "pl.axi_threshold_bridge", "pl.axi_mem_interconnect",
                             "ps.s_axi_hp0", "ps.ddr_io"}) {
    BOOST_TEST_CONTEXT(module) {
      BOOST_TEST(once[module] > idle[module]);
      BOOST_TEST(twice[module] - once[module] == once[module] - idle[module],
                 boost::test_tools::tolerance(1e-6));
    }
  }
  BOOST_TEST(once["pl.axi_dma_0"] == idle["pl.axi_dma_0"]);
}

BOOST_AUTO_TEST_CASE(the_timeline_integrates_to_the_energy) {
  for (const char* mode : {"vivado-default", "activity"}) {
    Platform platform(Settings{{"power.mode", mode}, {"fidelity", "clocked"}});
    platform.power->record_timeline();
    platform.run_until(ms);
    *platform.zynq->design().busy() = true;
    logic(platform).bram.reads_b.add(307'200);
    platform.run_until(2 * ms);
    platform.zynq->ps.fclk_clk0.clk.set_frequency(40'000'000);
    platform.frame(0, 4 * ms);
    const PowerTimeline& line = platform.power->timeline();
    double joules = 0;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const double seconds = 1e-12 * static_cast<double>(line.points[i + 1].ps - line.points[i].ps);
      for (const double w : line.points[i].watts) joules += w * seconds;
    }
    BOOST_TEST(joules == platform.power->ledger().total().nominal, near);
    BOOST_TEST(line.points.front().ps == 0u);
    BOOST_TEST(line.points.back().ps == 4 * ms);
    BOOST_TEST(line.points.size() >= 3u);
  }
}

BOOST_AUTO_TEST_CASE(signals_show_what_flows_now) {
  Platform platform(Settings{{"power.mode", "activity"}});
  platform.power->follow();
  const double before = platform.power->pl;
  platform.run_until(ms);
  *platform.zynq->design().busy() = true;
  BOOST_TEST(platform.power->pl > before);
  BOOST_TEST(platform.power->total ==
                 platform.power->ps + platform.power->pl + platform.power->static_power,
             near);
  logic(platform).sensor_input.frame_ena = false;
  BOOST_TEST(platform.power->pl == before, near);
}

BOOST_AUTO_TEST_CASE(without_frames_the_whole_run_counts) {
  const double usual = report_of({}).total_w;
  Platform platform;
  platform.run_until(5 * ms);
  const facts::PowerReport power = platform.power->power_report(5 * ms);
  BOOST_TEST(!power.per_frame);
  BOOST_TEST(power.total_w == usual, near);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(zynq_design)

BOOST_AUTO_TEST_CASE(the_thesis_design_fits_and_meets_timing) {
  Platform platform;
  const facts::ResourceReport resources = platform.power->resource_report();
  BOOST_TEST(resources.over.empty());
  BOOST_TEST(resources.available.lut == 53'200.0);
  BOOST_TEST(resources.available.bram36 == 140.0);
  BOOST_TEST(resources.modules.size() == 17u);
  double bram = 0;
  for (const auto& module : resources.modules) {
    if (module.name == "pl.bram") BOOST_TEST(module.amount.bram36 == 75.0);
    bram += module.amount.bram36;
  }
  BOOST_TEST(bram == resources.total.bram36);
  const facts::TimingReport timing = platform.power->timing_report(*platform.timing);
  BOOST_TEST(timing.met);
  BOOST_TEST(result::timing_warnings(timing).empty());
}

BOOST_AUTO_TEST_CASE(more_labels_take_more_logic_until_it_is_too_much) {
  const auto with_labels = [](const char* labels) {
    return Platform(Settings{{"pl.blob_detection.label_count", labels},
                             {"device", "xc7z010"},
                             {"pl.width", "320 px"},
                             {"pl.height", "240 px"}})
        .power->resource_report();
  };
  BOOST_TEST(with_labels("64").total.lut < with_labels("128").total.lut);
  const facts::ResourceReport large = with_labels("512");
  BOOST_TEST(large.over == std::vector<std::string>{"lut"});
  const auto warnings = result::resource_warnings(large);
  BOOST_REQUIRE(warnings.size() == 1u);
  BOOST_TEST(warnings[0].find("does not fit") != std::string::npos, warnings[0]);
}

BOOST_AUTO_TEST_CASE(larger_images_and_deeper_buffers_take_block_memory) {
  const auto bram = [](const Settings& settings) {
    return Platform(settings).power->resource_report().total.bram36;
  };
  BOOST_TEST(bram({{"pl.width", "1024 px"}, {"pl.height", "512 px"}}) == bram({}) + 128 - 75);
  BOOST_TEST(bram({{"pl.feature_packaging.buffer_depth", "1024"}}) == bram({}) + 2 - 0.5);
}

BOOST_AUTO_TEST_CASE(a_clock_above_fmax_is_infeasible_and_says_by_how_much) {
  Platform platform(Settings{{"ps.fclk_clk1.frequency", "62.5 MHz"}});
  const facts::TimingReport timing = platform.power->timing_report(*platform.timing);
  BOOST_TEST(!timing.met);
  for (const auto& module : timing.modules) {
    BOOST_TEST(module.met == (module.name != "pl.blob_detection"), module.name);
    if (module.met) continue;
    BOOST_TEST(module.fmax_mhz == 55.0);
    BOOST_TEST(module.fmax_high_mhz == 55.0);
    BOOST_TEST(module.margin_percent == -12.0, near);
  }
  const auto warnings = result::timing_warnings(timing);
  BOOST_REQUIRE(warnings.size() == 1u);
  BOOST_TEST(warnings[0].find("pl.blob_detection misses timing") == 0u, warnings[0]);
  BOOST_TEST(warnings[0].find("12.0 %") != std::string::npos, warnings[0]);
}

BOOST_AUTO_TEST_CASE(above_a_lower_bound_nobody_knows) {
  Platform platform(
      {{"ps.fclk_clk1.frequency", "111.111 MHz"}, {"timing.blob_detection.fmax", "200 MHz"}});
  const facts::TimingReport timing = platform.power->timing_report(*platform.timing);
  BOOST_TEST(!timing.met);
  const auto warnings = result::timing_warnings(timing);
  BOOST_REQUIRE(warnings.size() == 1u);
  BOOST_TEST(warnings[0].find("whether timing is met is not known") == 0u, warnings[0]);
  BOOST_TEST(warnings[0].find("pl.corner_detection") != std::string::npos, warnings[0]);
}

BOOST_AUTO_TEST_CASE(a_non_maximum_suppression_of_one_clock_would_not_do) {
  Platform platform(Settings{{"timing.corner_detection.fmax", "36.63 MHz"}});
  BOOST_TEST(!platform.power->timing_report(*platform.timing).met);
}

BOOST_AUTO_TEST_CASE(the_highest_frequency_of_a_run_counts) {
  Platform platform;
  platform.run_until(ms);
  platform.zynq->ps.fclk_clk1.clk.set_frequency(60'000'000);
  platform.run_until(2 * ms);
  platform.zynq->ps.fclk_clk1.clk.set_frequency(50'000'000);
  BOOST_TEST(!platform.power->timing_report(*platform.timing).met);
}

BOOST_AUTO_TEST_CASE(a_system_without_design_takes_nothing) {
  Platform platform(Settings{{"ps.fclk_clk1.frequency", "62.5 MHz"}}, false);
  BOOST_TEST(platform.power->resource_report().modules.empty());
  BOOST_TEST(platform.power->timing_report(*platform.timing).met);
}

BOOST_AUTO_TEST_SUITE_END()

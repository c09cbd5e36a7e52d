#include <result/console.h>
#include <result/result_members.h>
#include <result/verdict.h>

#include <boost/test/unit_test.hpp>

#include <vp/text.h>

#include "report_kit.h"

using namespace platform;
using namespace platform::facts;
using namespace platform::result;
using namespace report_test;

namespace {

TimingReport::Module module(const char* name, double fmax_mhz, bool lower_bound = false) {
  constexpr double mhz = 100;
  TimingReport::Module module;
  module.name = name;
  module.clock = "ps.fclk_clk0";
  module.frequency_mhz = mhz;
  module.fmax_mhz = fmax_mhz;
  module.fmax_high_mhz = lower_bound ? 400 : fmax_mhz;
  module.met = mhz <= fmax_mhz;
  module.margin_percent = 100 * (fmax_mhz / mhz - 1);
  return module;
}

ClockReport::Clock clock(const char* name, double margin_percent, bool makeable = true) {
  ClockReport::Clock clock;
  clock.name = name;
  clock.margin_percent = margin_percent;
  clock.within = margin_percent >= 0;
  clock.makeable = makeable;
  return clock;
}

/// A point without fault.
struct Point {
  Point() {
    facts.end = ProgramEnd{0, 1, false, {}};
    facts.resources.emplace();
    facts.resources->device = "xc7z010";
    facts.resources->total = {100, 50, 40, 0};
    facts.resources->available = {150, 150, 60, 80};
    facts.timing = {true, {module("a", 110), module("b", 120), module("c", 130, true)}};
    facts.clocks.emplace();
    facts.clocks->device = "xc7z010-1";
    facts.clocks->clocks = {clock("ps.cpu_clk", 0.05), clock("ps.fclk_clk0", 150)};
    frame();
  }

  UnitReport& frame() { return frames.emplace_back(found_frame("z1.0")); }
  Verdict verdict() const {
    Summary summary;
    for (const UnitReport& frame : frames) summary.add(judged(frame));
    return verdict_of(facts, summary);
  }
  Verdict::Part part(const std::string& name) const {
    for (const Verdict::Part& part : verdict().parts) {
      if (part.name == name) return part;
    }
    throw std::out_of_range(name);
  }
  /// It is not feasible, only because of that part.
  void fails(const std::string& name, Holds how, const std::string& why) const {
    BOOST_TEST_CONTEXT(why) {
      const Verdict verdict = this->verdict();
      for (const Verdict::Part& part : verdict.parts)
        BOOST_TEST((part.holds == (part.name == name ? how : Holds::yes)), part.name);
      BOOST_TEST((verdict.feasible() == how));
      BOOST_TEST(vp::join(verdict.reasons(), "; ") == why);
    }
  }

  RunFacts facts = report_test::run_facts();
  std::vector<UnitReport> frames;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(verdicts)

BOOST_AUTO_TEST_CASE(a_point_without_fault_has_its_margins) {
  const Point point;
  BOOST_TEST((point.verdict().feasible() == Holds::yes));
  BOOST_TEST(point.verdict().reasons().empty());
  BOOST_TEST(!point.part("ran").margin_percent.has_value());
  BOOST_TEST(*point.part("job").margin_percent == 0);
  BOOST_TEST(*point.part("fits").margin_percent == 50);
  BOOST_TEST(point.part("fits").by == "lut");
  BOOST_TEST(*point.part("clocks").margin_percent == 0.05);
  BOOST_TEST(point.part("clocks").by == "ps.cpu_clk");
  // To the nearest limit that is known: c may reach more.
  BOOST_TEST(*point.part("timing").margin_percent == 10, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(point.part("timing").by == "a");
}

BOOST_AUTO_TEST_CASE(a_program_that_does_not_end_well) {
  Point point;
  point.facts.end = ProgramEnd{3, 1, false, {}};
  point.fails("ran", Holds::no, "the program ended with exit code 3");
  point.facts.end.reset();
  point.fails("ran", Holds::no, "the program did not end");
  point.facts.end = ProgramEnd{0, 1, false, {}};
  point.facts.incomplete = "interrupted";
  point.fails("ran", Holds::no, "interrupted");
}

BOOST_AUTO_TEST_CASE(a_job_that_is_not_done) {
  Point point;
  point.frames.clear();
  point.fails("job", Holds::no, "no frames");
  point.frame() = given_up_frame("z1.0");
  point.fails("job", Holds::no, "1 of 1 frame without a result");
  BOOST_TEST(*point.part("job").margin_percent == -100);
  point.frame();
  marker_frame(point.frame()).markers.clear();
  marker_frame(point.frame()).markers[0].id += 1;
  point.fails("job", Holds::no,
              "1 of 4 frames without a result, 2 of 4 frames without the marker of the scene");
  BOOST_TEST(*point.part("job").margin_percent == -75);
}

BOOST_AUTO_TEST_CASE(a_job_that_rests_on_a_stub_is_not_known) {
  Point point;
  point.facts.stubs = {"filter_0"};
  point.fails("job", Holds::unknown, "job not known: a stub answered in the place of filter_0");
  point.facts.stubs.push_back("can_0");
  point.fails("job", Holds::unknown,
              "job not known: stubs answered in the place of filter_0, can_0");
}

BOOST_AUTO_TEST_CASE(frames_that_were_dropped_or_never_published_are_no_job_done) {
  Point point;
  point.facts.camera = CameraReport{60, 1, 0, 1e10, 1e10};
  BOOST_TEST((point.part("job").holds == Holds::yes));
  point.facts.camera->offered = 4;
  point.facts.camera->dropped = 2;
  point.facts.unpublished = 1;
  point.fails("job", Holds::no,
              "2 of 4 frames of the camera dropped, 1 of 4 frames taken and never published");
  BOOST_TEST(*point.part("job").margin_percent == -75);
  point.frames.clear();
  point.facts.camera.reset();
  point.fails("job", Holds::no, "1 of 1 frame taken and never published");
}

BOOST_AUTO_TEST_CASE(whatever_a_design_counts_as_lost_counts) {
  Point point;
  point.frames[0].counts.lose("feature_overflow", 0);
  point.frames[0].counts.set("overflow", 1);
  BOOST_TEST(point.frames[0].counts.lost() == 0u);
  BOOST_TEST((point.part("job").holds == Holds::yes));
  point.frames[0].counts.lose("drops", 1);
  BOOST_TEST(point.frames[0].counts["drops"] == 1u);
  BOOST_TEST(point.frames[0].counts["nothing"] == 0u);
  point.fails("job", Holds::no, "1 of 1 frame with losses");
}

BOOST_AUTO_TEST_CASE(an_image_of_which_nobody_knows_needs_no_marker) {
  Point point;
  marker_frame(point.frames[0]).truth.reset();
  marker_frame(point.frames[0]).markers.clear();
  BOOST_TEST((point.verdict().feasible() == Holds::yes));
}

BOOST_AUTO_TEST_CASE(a_job_by_the_designs_own_rule) {
  Point point;
  point.facts.work = {"batch", "no batch has an echo", "batches"};
  point.frames = {UnitReport(), UnitReport(), UnitReport()};
  BOOST_TEST((point.part("job").holds == Holds::yes), "nothing must be detected");
  Summary summary;
  for (UnitReport& unit : point.frames) {
    unit.failures = {"with an echo"};
    summary.add(unit);
  }
  const Verdict::Part part = job_of(point.facts, summary);
  BOOST_TEST((part.holds == Holds::no));
  BOOST_TEST(part.why == "3 of 3 batches with an echo");
  BOOST_TEST(*part.margin_percent == -100);
  BOOST_TEST(job_of(point.facts, {}).why == "no batches");
}

BOOST_AUTO_TEST_CASE(a_design_that_delivers_nothing_ends_well_or_not) {
  Point point;
  point.frames.clear();
  point.facts.work = {"", "the program ends well"};
  BOOST_TEST((point.verdict().feasible() == Holds::yes));
  BOOST_TEST(!point.part("job").margin_percent.has_value());
  point.facts.end = ProgramEnd{3, 1, false, {}};
  point.fails("ran", Holds::no, "the program ended with exit code 3");
}

BOOST_AUTO_TEST_CASE(a_design_that_is_too_big) {
  Point point;
  point.facts.resources->total.bram36 = 80;
  point.facts.resources->over = {"bram36"};
  point.fails("fits", Holds::no, "too big for an xc7z010 (bram36)");
  BOOST_TEST(*point.part("fits").margin_percent == -25);
}

BOOST_AUTO_TEST_CASE(clocks_that_no_chip_has) {
  Point point;
  point.facts.clocks->clocks = {clock("ps.cpu_clk", -33), clock("ps.fclk_clk0", 150, false)};
  point.facts.clocks->legal = false;
  point.fails("clocks", Holds::no,
              "ps.cpu_clk too fast for an xc7z010-1, no PLL makes ps.fclk_clk0");
  BOOST_TEST(*point.part("clocks").margin_percent == -33);
  point.facts.clocks->clocks.erase(point.facts.clocks->clocks.begin());
  point.fails("clocks", Holds::no, "no PLL makes ps.fclk_clk0");
}

BOOST_AUTO_TEST_CASE(a_clock_that_the_design_does_not_use_is_not_impossible) {
  Point point;
  ClockReport& report = *point.facts.clocks;
  report.clocks = {clock("ps.cpu_clk", 5), clock("ps.fclk_clk1", -40)};
  report.clocks[1].used = false;
  report.clocks[1].frequency_mhz = 416;
  report.clocks[1].limit_mhz = 250;
  BOOST_TEST((point.part("clocks").holds == Holds::yes));
  BOOST_TEST(point.part("clocks").by == "ps.cpu_clk");
  BOOST_TEST(clock_warnings(report).empty());
  BOOST_TEST(clock_text(report) ==
             "clock    ps.fclk_clk1 runs at 416 MHz, above the 250 MHz of an xc7z010-1: the design "
             "does not use it\n");
  report.clocks[1].used = true;
  BOOST_TEST(clock_warnings(report).size() == 1u);
  BOOST_TEST(clock_text(report) == "");
}

BOOST_AUTO_TEST_CASE(timing_is_missed_or_unknown) {
  Point point;
  point.facts.timing = {false, {module("a", 110), module("b", 90, true), module("c", 80, true)}};
  point.fails("timing", Holds::unknown, "timing unknown for c and 1 more");
  BOOST_TEST(*point.part("timing").margin_percent == -20, boost::test_tools::tolerance(1e-9));
  point.facts.timing->modules.push_back(module("d", 95));
  point.fails("timing", Holds::no, "timing missed by d");
}

// Up to where it may still work does not count: it is not known.
BOOST_AUTO_TEST_CASE(the_ip_with_the_least_margin_is_named) {
  const auto nearest = [](std::vector<TimingReport::Module> modules) {
    return critical_module({true, std::move(modules)}).name;
  };
  BOOST_TEST(nearest({module("a", 108), module("b", 106, true), module("c", 120)}) == "b");
  BOOST_TEST(nearest({module("a", 105), module("b", 106, true), module("c", 120)}) == "a");
  BOOST_TEST(nearest({module("a", 95), module("b", 90), module("c", 120)}) == "b", "both miss it");
  BOOST_TEST(nearest({module("a", 95), module("b", 90, true)}) == "a", "b may work");
}

// RTL of a user's that was not synthesised: no number takes the place of what is not known.
BOOST_AUTO_TEST_CASE(a_part_without_figures_makes_fits_and_timing_unknown) {
  Point point;
  point.facts.resources->unknown = {"pl.mine"};
  point.fails("fits", Holds::unknown, "what pl.mine takes is not known");
  BOOST_TEST(!point.part("fits").margin_percent.has_value());
  point.facts.resources->over = {"lut"};  // of the others alone
  BOOST_TEST((point.part("fits").holds == Holds::no));

  Point slow;
  TimingReport::Module mine = module("pl.mine", 1);
  mine.known = false;
  slow.facts.timing = {false, {module("a", 110), mine}};
  slow.fails("timing", Holds::unknown, "timing unknown for pl.mine");
  BOOST_TEST(!slow.part("timing").margin_percent.has_value());
  slow.facts.timing->modules.push_back(module("b", 95));
  slow.fails("timing", Holds::no, "timing missed by b");
}

BOOST_AUTO_TEST_CASE(without_a_pl_nothing_must_fit_or_be_fast) {
  Point point;
  point.facts.resources->total = {};
  point.facts.timing = TimingReport{};
  BOOST_TEST((point.verdict().feasible() == Holds::yes));
  BOOST_TEST(!point.part("fits").margin_percent.has_value());
  BOOST_TEST(!point.part("timing").margin_percent.has_value());
}

BOOST_AUTO_TEST_CASE(the_worst_part_decides) {
  Point point;
  point.facts.resources.reset();
  point.fails("fits", Holds::unknown, "fits not known");
  point.facts.end = ProgramEnd{1, 1, false, {}};
  BOOST_TEST((point.verdict().feasible() == Holds::no));
  BOOST_TEST(point.verdict().reasons() ==
             (std::vector<std::string>{"the program ended with exit code 1", "fits not known"}));
}

BOOST_AUTO_TEST_CASE(what_result_json_says) {
  Point point;
  BOOST_TEST(verdict_members().json(point.verdict()) == Json::parse(R"({"feasible": "yes",
      "ran": {"holds": "yes"}, "job": {"holds": "yes", "margin_percent": 0.0},
      "fits": {"holds": "yes", "margin_percent": 50.0, "by": "lut"},
      "clocks": {"holds": "yes", "margin_percent": 0.05, "by": "ps.cpu_clk"},
      "timing": {"holds": "yes", "margin_percent": 10.0, "by": "a"}})"));
  point.facts.timing = {false, {module("b", 90, true)}};
  BOOST_TEST(verdict_members().json(point.verdict())["feasible"] == "unknown");
  BOOST_TEST(verdict_members().json(point.verdict())["timing"] ==
             Json::parse(R"({"holds": "unknown",
      "margin_percent": -10.0, "by": "b", "why": "timing unknown for b"})"));
}

BOOST_AUTO_TEST_SUITE_END()

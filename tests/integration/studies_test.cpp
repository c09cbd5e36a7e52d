// What the texts of the studies say, against the data that the studies give.
#include <cmath>
#include <map>
#include <sstream>

#include <vp/text.h>

#include "sweeps.h"

using namespace sweep_test;

namespace {

using Row = std::map<std::string, std::string>;

/// A shipped study, computed.
class Study : public Sweeps {
 public:
  explicit Study(const std::string& name, int exit_code = 0) {
    const kit::Outcome outcome = run({"sweep", name, "--no-report", "--output", "out"});
    said = outcome.out;
    BOOST_TEST(outcome.exit_code == exit_code, outcome.err);
    std::istringstream lines(kit::read_file(*this / "out/sweep.csv"));
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> head = vp::split(line, ',');
    while (std::getline(lines, line)) {
      const std::vector<std::string> fields = vp::split(line, ',');
      Row row;
      for (std::size_t i = 0; i < std::min(head.size(), fields.size()); ++i)
        row[head[i]] = fields[i];
      rows.push_back(row);
    }
  }

  /// The metric of the point with these values.
  double at(const Row& values, const std::string& metric) const {
    for (const Row& row : rows) {
      const bool fits = std::all_of(values.begin(), values.end(), [&](const auto& value) {
        return row.at(value.first) == value.second;
      });
      if (fits) return std::stod(row.at(metric));
    }
    BOOST_FAIL("no such point");
    return 0;
  }

  /// Checks that the points for which `wanted` is true are feasible, and no others.
  template <class Wanted>
  void feasible(const Wanted& wanted) const {
    for (const Row& row : rows)
      BOOST_TEST((row.at("feasible") == "yes") == wanted(row), row.at("key"));
  }

  /// The text has the number, rounded to so many places, where `{}` is in `phrase`.
  void says(const std::string& phrase, double number, int places = 0) const {
    std::string expected = phrase;
    expected.replace(expected.find("{}"), 2, vp::format_fixed(number, places));
    std::string flat = said;
    std::replace(flat.begin(), flat.end(), '\n', ' ');
    BOOST_TEST(contains(flat, expected), "'" << expected << "' is not in: " << flat);
  }

  std::string said;
  std::vector<Row> rows;
};

constexpr const char* fps = "summary.fps.mean";

/// "50 MHz" is 50.
double number(const std::string& text) {
  return std::stod(text);
}

bool all_feasible(const Row&) {
  return true;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(studies)

BOOST_AUTO_TEST_CASE(pixel_clock) {
  const Study study("pixel-clock");
  const auto at = [&](const std::string& clock) {
    return study.at({{"ps.fclk_clk1.frequency", clock}}, fps);
  };
  study.says("50 MHz give {} frames", at("50 MHz"));
  study.says("100 MHz {} and", at("100 MHz"));
  study.says("200 MHz {}, and", at("200 MHz"));
  const double software_ms = 1e3 / at("50 MHz") - 6.144;
  study.says("{} ms belong to the software", software_ms, 2);
  study.says("no pixel clock gives more than {}", 1e3 / software_ms);
  study.says("Only 25 and {} MHz can be built", 50);
  study.feasible([](const Row& row) { return number(row.at("ps.fclk_clk1.frequency")) <= 50; });
}

BOOST_AUTO_TEST_CASE(cpu_clock) {
  const Study study("cpu-clock");
  std::map<std::string, double> least, most;
  for (const Row& row : study.rows) {
    const double rate = std::stod(row.at(fps));
    const std::string& system = row.at("system");
    if (least.count(system) == 0 || rate < least[system]) least[system] = rate;
    most[system] = std::max(most[system], rate);
  }
  study.says("still {} times slower", least["hybrid"] / most["ps-only"], 1);
  study.says("give {} and", most["hybrid"]);
  study.says("and {}. The hybrid waits", most["ps-only"], 1);
  study.says("frames ({} to", least["hybrid"]);
  study.says("times ({} to", least["ps-only"], 1);
  study.feasible(all_feasible);
}

BOOST_AUTO_TEST_CASE(hybrid_or_ps_only) {
  const Study study("hybrid-or-ps-only");
  const auto mean = [&](const std::string& system, const std::string& opt, const char* metric) {
    double sum = 0, count = 0;
    for (const Row& row : study.rows) {
      if (row.at("system") != system || row.at("sw.opt") != opt) continue;
      sum += std::stod(row.at(metric));
      ++count;
    }
    return sum / count;
  };
  study.says("brings {} times the frames at -O0",
             mean("hybrid", "O0", fps) / mean("ps-only", "O0", fps), 1);
  study.says("and {} times at -O2", mean("hybrid", "O2", fps) / mean("ps-only", "O2", fps), 1);
  study.says("{} instead of", mean("hybrid", "O0", "summary.energy_per_frame_mj"));
  study.says("instead of {} mJ", mean("ps-only", "O0", "summary.energy_per_frame_mj"));
  study.feasible(all_feasible);
}

BOOST_AUTO_TEST_CASE(opt_level) {
  const Study study("opt-level");
  const auto ratio = [&](const std::string& system, const std::string& metric) {
    return study.at({{"system", system}, {"sw.opt", "O0"}}, metric) /
           study.at({{"system", system}, {"sw.opt", "O2"}}, metric);
  };
  study.says("shortens evaluation {} times", ratio("hybrid", "frames.time_us.evaluation.mean"), 1);
  study.says("the pose {} times", ratio("hybrid", "frames.time_us.pose.mean"), 1);
  study.says("identification {} times", ratio("hybrid", "frames.time_us.identification.mean"), 1);
  study.says("{} % more frames", 100 / ratio("hybrid", fps) - 100);
  study.says("{} times as many", 1 / ratio("ps-only", fps), 1);
  study.says("has {} % of the hybrid's frames",
             100 * study.at({{"system", "ps-only"}, {"sw.opt", "O2"}}, fps) /
                 study.at({{"system", "hybrid"}, {"sw.opt", "O0"}}, fps));
  study.feasible(all_feasible);
}

BOOST_AUTO_TEST_CASE(canonical_width) {
  const Study study("canonical-width");
  const auto at = [&](const std::string& width, const char* metric) {
    return study.at({{"sw.canonical_width", width}}, metric);
  };
  constexpr const char* time = "frames.time_us.identification.mean";
  study.says("({} instead of", at("24 px", time));
  study.says("instead of {} us for identification", at("60 px", time));
  BOOST_TEST(std::lround(at("60 px", time) / at("24 px", time)) == 14);
  study.says("{} instead of 140 frames", at("24 px", fps));
  study.says("instead of {} frames a second", at("60 px", fps));
  for (const Row& row : study.rows)
    study.says("same {} markers", number(row.at("summary.detected")));
  study.feasible(all_feasible);
}

BOOST_AUTO_TEST_CASE(labels_and_fifo) {
  const Study study("labels-and-fifo");
  const auto at = [&](const std::string& labels, const std::string& words, const char* metric) {
    return study.at(
        {{"pl.blob_detection.label_count", labels}, {"pl.feature_packaging.buffer_depth", words}},
        metric);
  };
  study.says("With 8 labels {} pixels", at("8", "4", "frames.counts.label_overflow.max"));
  BOOST_TEST(at("16", "2", "frames.counts.feature_overflow.max") == 1);
  constexpr const char* lut = "resources.total.lut";
  study.says("cost {} LUT more", at("128", "100", lut) - at("16", "100", lut));
  for (const Row& row : study.rows) study.says("all {} scenes", number(row.at("summary.detected")));
  study.feasible([](const Row& row) {
    return number(row.at("pl.blob_detection.label_count")) >= 16 &&
           number(row.at("pl.feature_packaging.buffer_depth")) >= 4;
  });
}

BOOST_AUTO_TEST_CASE(burst_length) {
  const Study study("burst-length", 4);
  const auto upload_ms = [&](const std::string& words) {
    return study.at({{"pl.burst_words", words}}, "frames.time_us.upload.mean") / 1000;
  };
  study.says("takes {} ms with 4 words", upload_ms("4"), 1);
  study.says("{} ms with the thesis' 32", upload_ms("32"), 1);
  study.says("{} ms with 128", upload_ms("128"), 1);
  for (const Row& row : study.rows) {
    if (row.at("pl.burst_words") != "2")
      study.says("The rate stays at {} frames/s", number(row.at(fps)), 1);
  }
  BOOST_TEST(contains(study.said, "ended with exit code 1: the software gave up: binary image"));
  study.feasible([](const Row& row) { return row.at("pl.burst_words") != "2"; });
}

BOOST_AUTO_TEST_CASE(pixel_and_system_clock) {
  const Study study("pixel-and-system-clock", 4);
  const std::map<int, int> follows{{10, 50}, {15, 77}, {20, 100}, {25, 143}, {50, 200}, {100, 200}};
  std::map<double, std::pair<double, double>> rates;  // least and most, by pixel clock
  double failed = 0, missed = 0;
  for (const Row& row : study.rows) {
    const double pixels = number(row.at("ps.fclk_clk1.frequency"));
    const bool holds =
        pixels <= follows.at(static_cast<int>(number(row.at("ps.fclk_clk0.frequency"))));
    BOOST_TEST((row.at("status") == "done") == holds);
    failed += holds ? 0 : 1;
    if (!holds) continue;
    missed += row.at("feasible") == "no" ? 1 : 0;
    for (const char* buffer : {"feature", "crossing"})
      BOOST_TEST(row.at("frames.counts." + std::string(buffer) + "_overflow.max") == "0");
    const double rate = number(row.at(fps));
    auto& [least, most] = rates.try_emplace(pixels, rate, rate).first->second;
    least = std::min(least, rate);
    most = std::max(most, rate);
  }
  for (const auto& [pixels, range] : rates) BOOST_TEST(range.second / range.first < 1.001, pixels);
  study.says("these {} points failed", failed);
  study.says("{} more work", missed);
  study.feasible([](const Row& row) { return number(row.at("ps.fclk_clk1.frequency")) <= 50; });
}

BOOST_AUTO_TEST_CASE(resolution) {
  const Study study("resolution");
  const auto at = [&](const std::string& width, const std::string& metric) {
    return study.at({{"pl.width", width}}, metric);
  };
  study.says("pose error from {} to", at("640 px", "frames.error.translation_mm.mean"));
  study.says("to {} mm, not by", at("1024 px", "frames.error.translation_mm.mean"));
  study.says("({} to", at("640 px", "frames.error.corner_px.mean"), 1);
  study.says("to {} px) but", at("1024 px", "frames.error.corner_px.mean"), 1);
  study.says("cost {} % of the frame rate", 100 - 100 * at("1024 px", fps) / at("640 px", fps));
  study.says("{} of 140 BRAM36", at("1024 px", "resources.total.bram36"), 1);
  study.feasible([](const Row& row) { return number(row.at("pl.width")) >= 640; });
}

// The settings of the design eco.
BOOST_AUTO_TEST_CASE(sixty_fps) {
  const Study study("sixty-fps");
  const char* energy = "summary.energy_per_frame_mj";
  const Row best{{"ps.fclk_clk0.frequency", "25 MHz"},
                 {"ps.cpu_clk.frequency", "333.333333 MHz"},
                 {"power.ddr.width", "16"},
                 {"power.ddr.voltage", "1.35 V"},
                 {"power.ddr.frequency", "400 MHz"}};
  const double least = study.at(best, energy);
  for (const Row& row : study.rows) {
    if (row.at("feasible") == "yes") BOOST_TEST(number(row.at(energy)) >= least, row.at("key"));
  }
  const auto saved = [&](const Row& others) {
    Row point = best;
    for (const auto& [path, value] : others) point[path] = value;
    return 100 - 100 * least / study.at(point, energy);
  };
  study.says("{} mJ a frame", least, 1);
  study.says("with {} ms to spare", study.at(best, "camera.slack_us.min") / 1000, 2);
  study.says("instead of two saves {} %", saved({{"power.ddr.width", "32"}}));
  study.says("voltage and clock {} %",
             saved({{"power.ddr.voltage", "1.5 V"}, {"power.ddr.frequency", "533.333333 MHz"}}));
  study.says("logic and CPU {} %", saved({{"ps.fclk_clk0.frequency", "100 MHz"},
                                          {"ps.cpu_clk.frequency", "666.666667 MHz"}}));
}

// The question of docs/exploration.md, with the commands that stand there.
BOOST_AUTO_TEST_CASE(least_energy) {
  const Study study("least-energy");
  double least = 1e9, rate = 0, most = 0;
  std::string best;
  for (const Row& row : study.rows) {
    const bool meets = number(row.at("ps.fclk_clk1.frequency")) < 60;
    if (row.at("pl.width") == "640 px" && meets) most = std::max(most, number(row.at(fps)));
    const double energy = number(row.at("summary.energy_per_frame_mj"));
    if (row.at("feasible") != "yes" || energy >= least) continue;
    least = energy;
    rate = number(row.at(fps));
    best = row.at("pl.width") + row.at("ps.fclk_clk1.frequency") + row.at("ps.cpu_clk.frequency");
  }
  BOOST_TEST(best == "480 px52.6 MHz333 MHz");
  study.says("at 333 MHz: {} mJ a frame", least, 1);
  study.says("mJ a frame, {} frames a second", rate);
  study.says("at most {} frames a second within timing", most);
  study.feasible([](const Row& row) {
    return number(row.at("ps.fclk_clk1.frequency")) < 60 && number(row.at(fps)) >= 200;
  });
}

BOOST_FIXTURE_TEST_CASE(three_commands_of_the_docs_answer_the_question, Sweeps) {
  std::istringstream page(kit::read_file(MARKERVP_SOURCE "/docs/exploration.md"));
  std::vector<kit::Outcome> outcomes;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("markervp ", 0) != 0 || !contains(line, "least-energy")) continue;
    outcomes.push_back(kit::run_process(
        "/bin/bash", {"-c", MARKERVP_EXECUTABLE + line.substr(std::string("markervp").size())},
        path()));
  }
  BOOST_REQUIRE(outcomes.size() == 4u);
  for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(outcomes[i].exit_code == 0, outcomes[i].err);
  BOOST_TEST(contains(outcomes[0].out, "36 points; nothing was run"), outcomes[0].out);
  BOOST_TEST(
      contains(outcomes[2].out, " 480 px     352 px             52.6 MHz            333 MHz"),
      outcomes[2].out);
  // At full size nothing reaches it.
  BOOST_TEST(outcomes[3].exit_code == 2);
  BOOST_TEST(contains(outcomes[3].err, "no point is feasible: 0 of 36 points feasible"),
             outcomes[3].err);
  BOOST_TEST(contains(outcomes[3].err, "the nearest is "), outcomes[3].err);
}

// A part of the points cannot prove what is said of all.
BOOST_FIXTURE_TEST_CASE(a_part_of_a_study_says_nothing_of_the_rest, Sweeps) {
  const std::string said = run({"sweep", "pixel-clock", "--no-report", "--limit", "2"}).out;
  BOOST_TEST(contains(said, "How many frames a second"), said);
  BOOST_TEST(!contains(said, "belong to the software"), said);
  BOOST_TEST(contains(run({"sweep", "pixel-clock", "--no-report", "--limit", "100"}).out,
                      "belong to the software"));
}

BOOST_AUTO_TEST_SUITE_END()

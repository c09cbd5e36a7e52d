// traces/checks: each check of ours passes on a good trace and alone fails on one that breaks it.
#include <boost/test/unit_test.hpp>

#include <functional>
#include <map>
#include <utility>

#include <trace/tools.h>
#include <vp/wave_writer.h>

#include "temporary_files.h"

namespace {

constexpr std::uint64_t end_word = 0xFFFFFFFF;

/// A short trace of the signals that the checks look at: values by time, ns.
class Story {
 public:
  Story() {
    stream("pl.image_stream");
    stream("pl.binary_stream");
    set(10, "pl.sensor_input.frame_ena", 1);
    set(30, "pl.sensor_input.pixel_x", 1);
    set(50, "pl.sensor_input.pixel_x", 2);
    set(70, "pl.sensor_input.pixel_x", 0);
    set(70, "pl.sensor_input.pixel_y", 1);
    set(90, "pl.sensor_input.frame_ena", 0);
    corner(50, 7, 3);
    corner(80, 2, 4);
    set(85, "pl.feature_packaging.corner_count", 2);
    set(200, "pl.control_block.ready", 1);
    set(220, "pl.feature_packaging.feature", 0x80000C07);
    set(220, "pl.feature_packaging.corner_count", 1);
    set(300, "pl.feature_packaging.feature", end_word);
    set(500, "ps.cpu.results", 1);
    set(600, "pl.control_block.rst_out", 1);
    set(610, "pl.feature_packaging.feature", 0);
    set(700, "pl.control_block.rst_out", 0);
    interrupt(1'000, "pl.axi_dma_0.mm2s_introut", 61);
    interrupt(2'000, "pl.axi_dma_1.s2mm_introut", 62);
    set(450, "pl.feature_packaging.corner_count", 100);
    set(460, "pl.feature_packaging.corner_count", 0);
  }
  void set(std::uint64_t ns, const std::string& signal, std::uint64_t value) {
    values_[ns][signal] = value;
  }
  void drop(std::uint64_t ns, const std::string& signal) { values_[ns].erase(signal); }

  void write(const std::string& file) const {
    // Widths and what is at 0 ns.
    using Signal = std::pair<unsigned, std::uint64_t>;
    std::map<std::string, Signal> signals = {{"pl.feature_packaging.depth", {17, 100}},
                                             {"pl.feature_packaging.blob_count", {16, 0}},
                                             {"ps.gic.active", {10, 1023}}};
    for (const char* counter :
         {"pl.feature_packaging.feature_overflow", "pl.blob_detection.label_overflow",
          "pl.axi_threshold_bridge.bridge_overflow", "pl.clock_crossing.crossing_overflow"}) {
      signals[counter] = {32, 0};
    }
    for (const auto& [ns, changes] : values_) {
      for (const auto& [signal, value] : changes) signals.insert({signal, {32, 0}});
    }
    const auto writer = vp::open_wave_writer(file);
    std::map<std::string, vp::WaveWriter::Id> ids;
    std::vector<std::uint64_t> standing;
    for (const auto& [path, signal] : signals) {
      ids[path] = writer->add(path, vp::WaveWriter::Kind::wire, signal.first);
      standing.push_back(signal.second);
    }
    writer->begin(0, standing);
    for (const auto& [ns, changes] : values_) {
      writer->set_time(ns * 1000);
      for (const auto& [signal, value] : changes) writer->change(ids.at(signal), value);
    }
    writer->close(40'000'000);
  }

 private:
  /// A packet of 32 beats on the edges from 50 to 360 ns, after a stall.
  void stream(const std::string& link) {
    set(10, link + ".tvalid", 1);
    set(10, link + ".tdata", 1);
    set(40, link + ".tready", 1);
    for (std::uint64_t ns = 50; ns < 360; ns += 10) set(ns, link + ".tdata", ns);
    set(350, link + ".tlast", 1);
    set(360, link + ".tlast", 0);
    set(360, link + ".tvalid", 0);
  }
  void corner(std::uint64_t ns, std::uint64_t x, std::uint64_t y) {
    set(ns, "pl.corner_detection.corner_out", 1);
    set(ns, "pl.corner_detection.corner_data", y << 10 | x);
    set(ns + 10, "pl.corner_detection.corner_out", 0);
  }
  void interrupt(std::uint64_t ns, const std::string& line, std::uint64_t id) {
    set(ns, line, 1);
    set(ns + 200, "ps.gic.active", id);
    set(ns + 300, line, 0);
    set(ns + 400, "ps.gic.active", 1023);
  }

  std::map<std::uint64_t, std::map<std::string, std::uint64_t>> values_;
};

using Doctor = std::function<void(Story&)>;

Doctor rises(std::uint64_t ns, const std::string& signal, std::uint64_t value) {
  return [=](Story& story) { story.set(ns, signal, value); };
}

/// By check: what breaks it and nothing else.
const std::map<std::string, Doctor>& doctors() {
  static const std::map<std::string, Doctor> all = {
      {"image_data_stable", rises(20, "pl.image_stream.tdata", 9)},
      {"image_valid_stays",
       [](Story& story) {
         story.set(20, "pl.image_stream.tvalid", 0);
         story.set(30, "pl.image_stream.tvalid", 1);
       }},
      {"image_last_stable",
       [](Story& story) {
         story.set(20, "pl.image_stream.tlast", 1);
         story.set(30, "pl.image_stream.tlast", 0);
       }},
      {"image_bursts", rises(340, "pl.image_stream.tlast", 1)},
      {"binary_data_stable", rises(20, "pl.binary_stream.tdata", 9)},
      {"binary_valid_stays",
       [](Story& story) {
         story.set(20, "pl.binary_stream.tvalid", 0);
         story.set(30, "pl.binary_stream.tvalid", 1);
       }},
      {"binary_last_stable",
       [](Story& story) {
         story.set(20, "pl.binary_stream.tlast", 1);
         story.set(30, "pl.binary_stream.tlast", 0);
       }},
      {"binary_bursts", [](Story& story) { story.drop(350, "pl.binary_stream.tlast"); }},
      {"pixels_in_order", rises(50, "pl.sensor_input.pixel_x", 0)},
      {"corners_in_order", rises(80, "pl.corner_detection.corner_data", 3 << 10 | 6)},
      {"end_word_before_result",
       [](Story& story) { story.drop(300, "pl.feature_packaging.feature"); }},
      {"end_word_last", rises(510, "pl.feature_packaging.feature", 5)},
      {"next_word",
       [](Story& story) {
         story.drop(220, "pl.feature_packaging.feature");
         story.set(240, "pl.feature_packaging.feature", 0x80000C07);
       }},
      {"image_interrupt_served", [](Story& story) { story.drop(1'200, "ps.gic.active"); }},
      {"binary_interrupt_served", [](Story& story) { story.drop(2'200, "ps.gic.active"); }},
      {"no_feature_lost", rises(400, "pl.feature_packaging.feature_overflow", 1)},
      {"no_label_lost", rises(400, "pl.blob_detection.label_overflow", 1)},
      {"no_binary_word_lost", rises(400, "pl.axi_threshold_bridge.bridge_overflow", 1)},
      {"no_crossing_lost", rises(400, "pl.clock_crossing.crossing_overflow", 1)},
      {"buffers_within_depth", rises(450, "pl.feature_packaging.corner_count", 101)}};
  return all;
}

const std::string shipped = MARKERVP_SOURCE "/traces/checks/system.checks";

/// The names of the checks that fail; "unseen NAME" of one that had nothing to look at.
std::vector<std::string> failures(const Story& story, bool all_seen) {
  const kit::TemporaryFolder folder;
  story.write(folder / "t.vcd");
  const auto checks = platform::trace::read_checks(shipped);
  platform::trace::TraceFile file(folder / "t.vcd");
  std::vector<std::string> failing;
  for (const auto& result : run_checks(file, checks, false)) {
    if (result.failures != 0) failing.push_back(result.check->name);
    if (all_seen && result.occasions == 0) failing.push_back("unseen " + result.check->name);
  }
  return failing;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shipped_checks)

BOOST_AUTO_TEST_CASE(a_good_trace_passes_and_gives_each_check_something_to_look_at) {
  BOOST_TEST(failures(Story(), true) == std::vector<std::string>(),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(each_check_fails_alone_when_its_rule_is_broken) {
  for (const auto& check : platform::trace::read_checks(shipped)) {
    BOOST_TEST_CONTEXT(check.name) {
      const auto doctor = doctors().find(check.name);
      BOOST_TEST_REQUIRE((doctor != doctors().end()), "a new check needs a trace that breaks it");
      Story story;
      doctor->second(story);
      BOOST_TEST(failures(story, false) == std::vector<std::string>{check.name},
                 boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

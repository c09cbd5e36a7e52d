// Bugs planted into the RTL: lock-step finds each at the port where it shows, behind the clock in
// which it shows first.
#include <vp/unit.h>

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <systemc>

#include "child_process.h"
#include "pipeline.h"

namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

struct Bug {
  const char* name;
  const char* ip;
  const char* file;
  const char* right;
  const char* wrong;
  const char* port;  ///< that differs first
};

const Bug bugs[] = {
    {"brighter_or_equal", "corner_detection", "fast_module.sv",
     "<= {1'b0, circle[n*8+:8]} > limit;", "<= {1'b0, circle[n*8+:8]} >= limit;", "corner_"},
    {"eight_suffice", "corner_detection", "fast_module.sv", "|nine", "|eight", "corner_"},
    {"south_at_a_tie", "corner_detection", "fast_module.sv", "south > north", "south >= north",
     "corner_data"},
    {"strength_shifted", "corner_detection", "corner_detection.sv", "centre[11:2]", "centre[10:1]",
     "corner_data"},
    {"tie_below", "corner_detection", "corner_detection.sv", "centre >= below", "centre > below",
     "corner_out"},
    {"tie_in_the_row", "corner_detection", "corner_detection.sv",
     "score(scores, 1, 1) >= score(scores, 1, 2)", "score(scores, 1, 1) > score(scores, 1, 2)",
     "corner_out"},
    {"window_wraps", "corner_detection", "corner_detection.sv", "x >= 2 * REACH &&",
     "x >= 2 * REACH - 10'd1 &&", "corner_out"},
    {"first_column_lost", "corner_detection", "corner_detection.sv", "x >= 2 * REACH &&",
     "x > 2 * REACH &&", "corner_out"},
    {"one_to_the_right", "corner_detection", "corner_detection.sv", "x_at[30+:10] - REACH",
     "x_at[30+:10] - REACH + 10'd1", "corner_data"},
    {"threshold_is_bright", "global_threshold", "global_threshold.sv", "pixel <= active_threshold",
     "pixel < active_threshold", "binary_out"},
    {"word_one_pixel_early", "global_threshold", "global_threshold.sv",
     "frame_ena && x[4:0] == 5'd31", "frame_ena && x[4:0] == 5'd30", "thresh_out"},
    {"bits_reversed", "global_threshold", "global_threshold.sv", "{dark, word}", "{word, dark}",
     "thresh_data"},
    {"frame_end_late", "global_threshold", "global_threshold.sv", "binary_ena   <= frame_ena",
     "binary_ena   <= frame_ena || frame_before", "binary_ena"},
    {"last_of_equals", "global_threshold", "global_threshold.sv", "count > dark_count",
     "count >= dark_count", "active_threshold"},
    {"middle_rounds_up", "global_threshold", "global_threshold.sv", "{1'b0, bright_peak}) >> 1",
     "{1'b0, bright_peak} + 9'd1) >> 1", "active_threshold"},
    {"reset_forgets", "global_threshold", "global_threshold.sv", "if (por) active_threshold",
     "if (por || rst) active_threshold", "active_threshold"},
    {"label_expires_late", "blob_detection", "blob_detection.sv", "here >= ends[n]",
     "here > ends[n]", "blob_out"},
    {"last_of_the_widest", "blob_detection", "blob_detection.sv", "11] > a[", "11] >= a[", "blob_"},
    {"left_neighbour_lost", "blob_detection", "blob_detection.sv", "x > 10'd1 ? left_2",
     "x > 10'd2 ? left_2", "blob_"},
    {"labels_lost", "blob_detection", "blob_detection.sv", ".give_back(retires)",
     ".give_back(1'b0)", "label_overflow"},
    {"numbers_by_twos", "blob_detection", "blob_detection.sv", "number + 1'b1", "number + 11'd2",
     "blob_"},
    {"idle_too_early", "blob_detection", "blob_detection.sv", "!(ena_before || retired || flush)",
     "!(ena_before || retired)", "idle"},
};

/// All of them, and the RTL as it is, built once.
class Objects {
 public:
  static const Objects& get() {
    static const Objects objects;
    return objects;
  }

  std::string file(const std::string& name) const { return folder_ / ("build/" + name + ".so"); }

 private:
  Objects() {
    std::string project =
        "cmake_minimum_required(VERSION 3.25)\nproject(bugs LANGUAGES CXX)\n"
        "include(\"" MARKERVP_SOURCE "/cmake/MarkervpRtl.cmake\")\n";
    for (const char* ip : {"corner_detection", "global_threshold", "blob_detection"})
      project += object(ip, ip, nullptr);
    for (const Bug& bug : bugs) project += object(bug.name, bug.ip, &bug);
    kit::write_file(folder_ / "CMakeLists.txt", project);
    cmake({"-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug"});
    cmake({"--build", "build"});
  }

  void cmake(const Strings& arguments) const {
    const kit::Outcome outcome = kit::run_process(MARKERVP_CMAKE, arguments, folder_.path());
    if (outcome.exit_code != 0) throw std::runtime_error(outcome.out + outcome.err);
  }

  /// Copies the RTL of an IP, with the bug if there is one; gives the words that build it.
  std::string object(const std::string& name, const std::string& ip, const Bug* bug) const {
    const fs::path models(MARKERVP_SOURCE "/models/pl");
    const fs::path copy(folder_ / name);
    fs::copy(models / ip / "rtl", copy);
    if (bug) plant(*bug, copy / bug->file);
    return "file(GLOB sources " + name + "/*.sv)\nmarkervp_add_rtl(" + name + " IP " + ip +
           " TOP " + ip + " SOURCES ${sources} " + (models / "common/rtl/line_buffer.sv").string() +
           " PARAMETERS " + parameters(ip) + ")\n";
  }

  static std::string parameters(const std::string& ip) {
    if (ip == "corner_detection") return "WIDTH=64 LEAN=1";
    return ip == "global_threshold" ? "WIDTH=64 HEIGHT=32" : "WIDTH=64 LABELS=16 MINIMUM_SIDE=2";
  }

  static void plant(const Bug& bug, const std::string& file) {
    std::string text = kit::read_file(file);
    const std::size_t at = text.find(bug.right);
    if (at == std::string::npos)
      throw std::runtime_error(std::string(bug.name) + ": " + file + " has no '" + bug.right + "'");
    for (std::size_t from = at; from != std::string::npos;
         from = text.find(bug.right, from + std::string(bug.wrong).size()))
      text.replace(from, std::string(bug.right).size(), bug.wrong);
    kit::write_file(file, text);
  }

  kit::TemporaryFolder folder_;
};

/// Few grey levels: many scores, widths and counts are equal.
harness::Image posterised(std::uint64_t seed) {
  harness::Image image = harness::noise(64, 32, seed);
  for (std::uint8_t& level : image) level = static_cast<std::uint8_t>(level / 64 * 70);
  return image;
}

const std::vector<harness::Image>& images() {
  static const std::vector<harness::Image> images{
      harness::noise(64, 32, 7), posterised(3), harness::rectangles(64, 32, 20, 5),
      harness::stripes(64, 32), harness::noise(64, 32, 8)};
  return images;
}

struct Logic : harness::Pipeline {
  /// The threshold in force survives resets of the logic: only that of the system gives it a value.
  /// As on the chip, it is there before the pixel clock runs.
  explicit Logic(const std::string& setting) : Pipeline({100'000'000, 0}, settings(setting)) {
    driver.system_reset(true);
    run_for(100'000);
    fclk_clk1.set_frequency(50'000'000);
    driver.hold_ps = 200'000;  // not as long as a clock that stands makes it
    run_for(100'000);
    driver.system_reset(false);
  }

  static Strings settings(const std::string& setting) {
    Strings all = harness::frame_size(64, 32);
    all.insert(all.end(), {"pl.blob_detection.label_count=16",
                           "pl.blob_detection.minimum_side=2 px", setting});
    return all;
  }

  /// What ends the simulation; empty: nothing does.
  std::string failure() {
    try {
      for (const harness::Image& image : images()) {
        load(image);
        run_frame();
      }
    } catch (const sc_core::sc_report& report) {
      return report.get_msg();
    }
    return "";
  }
};

std::string fidelity(const Bug& bug, const std::string& how) {
  return std::string("pl.fidelity.") + bug.ip + "=" + how + Objects::get().file(bug.name);
}

/// Times and words of all frames, until the first frame in which a word differs from `expected`:
/// the time of that word. The RTL drives the wires here.
std::optional<std::uint64_t> first_wrong_word(const std::string& setting) {
  using Words = std::vector<harness::Word>;
  const auto frames = [](const std::string& with, std::vector<std::uint64_t>& starts) {
    Logic logic(with);
    std::vector<Words> all;
    for (const harness::Image& image : images()) {
      logic.load(image);
      all.push_back(logic.run_frame());
      starts.push_back(logic.monitor.time_of(0));
    }
    return all;
  };
  std::vector<std::uint64_t> starts, ignored;
  const std::vector<Words> expected = frames("pl.fidelity.corner_detection=clocked", starts);
  const std::vector<Words> found = frames(setting, ignored);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Words &a = expected[i], &b = found[i];
    const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (in_a == a.end() && in_b == b.end()) continue;
    const std::uint64_t never = ~std::uint64_t{0};
    const std::uint64_t clock =
        std::min(in_a == a.end() ? never : in_a->clock, in_b == b.end() ? never : in_b->clock);
    return starts[i] + clock * 20'000;
  }
  return std::nullopt;
}

bool carries_words(const std::string& port) {
  return port.compare(0, 7, "corner_") == 0 || port.compare(0, 5, "blob_") == 0 ||
         port.compare(0, 7, "thresh_") == 0;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(planted_bugs)

BOOST_AUTO_TEST_CASE(the_rtl_as_it_is_never_differs) {
  for (const std::string ip : {"corner_detection", "global_threshold", "blob_detection"}) {
    Logic logic("pl.fidelity." + ip + "=lockstep:" + Objects::get().file(ip));
    BOOST_TEST(logic.failure() == "", ip);
  }
}

BOOST_AUTO_TEST_CASE(each_is_found_at_its_port_behind_its_clock) {
  for (const Bug& bug : bugs) {
    BOOST_TEST_CONTEXT(bug.name) {
      std::string failure;
      {
        Logic logic(fidelity(bug, "lockstep:"));
        failure = logic.failure();
      }
      const std::size_t ports = failure.find(": ", failure.find(", at "));
      BOOST_TEST_REQUIRE(ports != std::string::npos, failure);
      BOOST_TEST(failure.compare(ports + 2, std::string(bug.port).size(), bug.port) == 0, failure);
      if (!carries_words(bug.port)) continue;
      const auto wrong = first_wrong_word(fidelity(bug, ""));
      BOOST_TEST_REQUIRE(wrong.has_value());
      BOOST_TEST(failure.find(", at " + vp::format_time(*wrong) + ": ") != std::string::npos,
                 failure << ", expected at " << vp::format_time(*wrong));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

// Bugs planted into the RTL: lock-step finds each at the port where it shows, behind the clock in
// which it shows first.
#include <vp/error.h>
#include <vp/unit.h>

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <systemc>

#include "pipeline.h"
#include "rtl_objects.h"

namespace {

using Strings = std::vector<std::string>;

const Bug bugs[] = {
    {"brighter_or_equal", "corner_detection", "fast_module.sv",
     "<= {1'b0, circle[n*8+:8]} > limit;", "<= {1'b0, circle[n*8+:8]} >= limit;", "corner_"},
    {"eight_suffice", "corner_detection", "fast_module.sv", "|nine", "|eight", "corner_"},
    {"south_at_a_tie", "corner_detection", "fast_module.sv", "south > north", "south >= north",
     "corner_data"},
    {"strength_shifted", "corner_detection", "corner_detection.sv", "centre[11-:STRENGTH_BITS]",
     "centre[10-:STRENGTH_BITS]", "corner_data"},
    {"tie_below", "corner_detection", "corner_detection.sv", "centre >= below", "centre > below",
     "corner_out"},
    {"tie_in_the_row", "corner_detection", "corner_detection.sv",
     "score(scores, 1, 1) >= score(scores, 1, 2)", "score(scores, 1, 1) > score(scores, 1, 2)",
     "corner_out"},
    {"window_wraps", "corner_detection", "corner_detection.sv", "x >= 2 * REACH &&",
     "x >= 2 * REACH - 10'd1 &&", "corner_out"},
    {"first_column_lost", "corner_detection", "corner_detection.sv", "x >= 2 * REACH &&",
     "x > 2 * REACH &&", "corner_out"},
    {"one_to_the_right", "corner_detection", "corner_detection.sv",
     "x_at[3*X_BITS+:X_BITS] - REACH", "x_at[3*X_BITS+:X_BITS] - REACH + 10'd1", "corner_data"},
    {"threshold_is_bright", "global_threshold", "global_threshold.sv",
     "8*lane+:8] <= active_threshold", "8*lane+:8] < active_threshold", "binary_out"},
    {"word_one_pixel_early", "global_threshold", "global_threshold.sv", "x[4:0] == 5'(32 - P)",
     "x[4:0] == 5'(31 - P)", "thresh_out"},
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
    {"last_of_the_widest", "blob_detection", "blob_detection.sv", "WIDER] > a[", "WIDER] >= a[",
     "blob_"},
    {"left_neighbour_lost", "blob_detection", "blob_detection.sv", "x > X_BITS'(1) ? left_2",
     "x > X_BITS'(2) ? left_2", "blob_"},
    {"labels_lost", "blob_detection", "blob_detection.sv", ".give_back(retires)",
     ".give_back(1'b0)", "label_overflow"},
    {"numbers_by_twos", "blob_detection", "blob_detection.sv", "number + 1'b1", "number + 11'd2",
     "blob_"},
    {"idle_too_early", "blob_detection", "blob_detection.sv", "!(ena_before || retired || flush)",
     "!(ena_before || retired)", "idle"},
    {"every_other_pixel", "sensor_input", "sensor_input.sv", "bram_addr + 1'b1",
     "bram_addr + ADDRESS_BITS'(2)", "pixel"},
    {"last_row_lost", "sensor_input", "sensor_input.sv", "row != LAST_ROW",
     "row + 9'd1 != LAST_ROW", "frame_ena"},
    {"bytes_swapped", "axi_image_store", "axi_image_store.sv", "bram_din = m_tdata",
     "bram_din = {m_tdata[15:0], m_tdata[31:16]}", "bram_din"},
    {"written_while_stalled", "axi_image_store", "axi_image_store.sv", "m_tvalid && m_tready",
     "m_tvalid", "bram_we"},
    {"image_behind_image", "axi_image_store", "axi_image_store.sv",
     "rst || (enabled && !ena_before)", "rst", "bram_addr"},
    {"last_beat_early", "axi_threshold_bridge", "axi_threshold_bridge.sv",
     "offer && in_packet == LAST_WORD", "offer && in_packet == LAST_WORD - 1'b1", "m_tlast"},
    {"word_not_taken", "axi_threshold_bridge", "axi_threshold_bridge.sv", "if (ena) thresh_seen",
     "if (store && write != '0) thresh_seen", "thresh_seen"},
    {"toggle_lost", "clock_crossing", "crossing_register.sv", "if (free) toggle",
     "if (free && !toggle) toggle", "binary_toggle"},
    {"blobs_first", "feature_packaging", "feature_packaging.sv",
     "wire show_corner = ena && want && corner_count != '0;",
     "wire show_corner = ena && want && corner_count != '0 && blob_count == '0;", "feature"},
    {"end_too_early", "feature_packaging", "feature_packaging.sv", "&& done && !ended",
     "&& (done || corner_seen) && !ended", "feature"},
    {"drained_too_early", "frame_status", "frame_status.sv", "4'd15", "4'd14", "busy"},
    {"done_beside_a_word", "frame_status", "frame_status.sv", "!corner_out && !blob_out",
     "!corner_out", "done"},
};

const Strings ips{"corner_detection", "global_threshold",  "blob_detection",
                  "sensor_input",     "axi_image_store",   "axi_threshold_bridge",
                  "clock_crossing",   "feature_packaging", "frame_status"};

/// Those whose ports are coordinates, for 1280 × 720 pixels.
const std::map<std::string, std::string> wide{{"sensor_input", "WIDTH=1280 HEIGHT=720"},
                                              {"corner_detection", "WIDTH=1280 Y_BITS=10 LEAN=1"},
                                              {"global_threshold", "WIDTH=1280 HEIGHT=720"},
                                              {"blob_detection", "WIDTH=1280 Y_BITS=10"},
                                              {"axi_image_store", "ADDRESS_BITS=18"}};

std::string parameters(const std::string& ip) {
  if (ip == "corner_detection") return "WIDTH=64 LEAN=1";
  if (ip == "blob_detection") return "WIDTH=64 LABELS=16 MINIMUM_SIDE=1";
  return ip == "global_threshold" || ip == "sensor_input" ? "WIDTH=64 HEIGHT=32" : "";
}

/// All of them, and the RTL as it is, built once.
const RtlObjects& objects() {
  static const RtlObjects built = [] {
    std::vector<RtlObjects::Object> all;
    for (const std::string& ip : ips) all.push_back({ip, ip, parameters(ip)});
    for (const Bug& bug : bugs) all.push_back({bug.name, bug.ip, parameters(bug.ip), &bug});
    for (const auto& [ip, values] : wide) all.push_back({ip + "_wide", ip, values});
    return RtlObjects(all);
  }();
  return built;
}

/// Few grey levels: many scores, widths and counts are equal.
harness::Image posterised(std::uint64_t seed) {
  harness::Image image = harness::noise(64, 32, seed);
  for (std::uint8_t& level : image) level = static_cast<std::uint8_t>(level / 64 * 70);
  return image;
}

/// As many blobs as there are labels, all of which are reported behind the frame.
harness::Image bars() {
  harness::Image image(64 * 32, 200);
  for (int x = 0; x < 64; x += 4) harness::draw(image, 64, x, 20, x + 1, 31, 20);
  return image;
}

const std::vector<harness::Image>& images() {
  static const std::vector<harness::Image> images{
      harness::noise(64, 32, 7), posterised(3), harness::rectangles(64, 32, 20, 5),
      harness::stripes(64, 32),  bars(),        harness::noise(64, 32, 8)};
  return images;
}

struct Logic : harness::Pipeline {
  /// The threshold in force survives resets of the logic: only that of the system gives it a value.
  /// As on the chip, it is there before the pixel clock runs.
  explicit Logic(const Strings& more) : Pipeline({100'000'000, 0}, settings(more)) {
    driver.system_reset(true);
    run_for(100'000);
    fclk_clk1.set_frequency(50'000'000);
    driver.hold_ps = 200'000;  // not as long as a clock that stands makes it
    run_for(100'000);
    driver.system_reset(false);
  }

  static Strings settings(const Strings& more) {
    Strings all = harness::frame_size(64, 32);
    all.insert(all.end(),
               {"pl.blob_detection.label_count=16", "pl.blob_detection.minimum_side=1 px"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// As the DMA brings it, once more from its beginning behind an upload that broke off.
  void upload(const harness::Image& image) {
    std::vector<std::uint32_t> words(image.size() / 4);
    std::memcpy(words.data(), image.data(), image.size());
    store({words.begin(), words.begin() + 16});
    store(words);
  }

  /// The words wait before anybody takes them.
  void store(const std::vector<std::uint32_t>& words) {
    source.send(words, 16);
    run_for(50'000);
    driver.control(pl::control_packet::wr_en);
    run_for(words.size() * 10'000 + 50'000);
    driver.control(0);
    run_for(100'000);
  }

  /// What ends the simulation; empty: nothing does.
  std::string failure() {
    try {
      for (const harness::Image& image : images()) {
        upload(image);
        run_frame();
      }
    } catch (const sc_core::sc_report& report) {
      return report.get_msg();
    }
    return "";
  }
};

std::string fidelity(const Bug& bug, const std::string& how) {
  return std::string("pl.fidelity.") + bug.ip + "=" + how + objects().file(bug.name);
}

/// Times and words of all frames, until the first frame in which a word differs from `expected`:
/// the time of that word. The RTL drives the wires here.
std::optional<std::uint64_t> first_wrong_word(const std::string& setting) {
  using Words = std::vector<harness::Word>;
  const auto frames = [](const std::string& with, std::vector<std::uint64_t>& starts) {
    Logic logic({with});
    std::vector<Words> all;
    for (const harness::Image& image : images()) {
      logic.upload(image);
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

/// Of a detector: the monitor of words sees it.
bool carries_words(const Bug& bug) {
  const std::string port = bug.port;
  if (std::find(ips.begin(), ips.begin() + 3, bug.ip) == ips.begin() + 3) return false;
  return port.compare(0, 7, "corner_") == 0 || port.compare(0, 5, "blob_") == 0 ||
         port.compare(0, 7, "thresh_") == 0;
}

/// Everything that software and reports see of the images.
std::string seen_of(const Strings& settings) {
  Logic logic(settings);
  std::string text;
  const auto note = [&text](auto... values) { ((text += std::to_string(values) + " "), ...); };
  for (const harness::Image& image : images()) {
    logic.upload(image);
    for (const harness::Word& word : logic.run_frame())
      note(word.kind, word.clock, word.first, word.second);
    for (const std::uint32_t feature : logic.driver.features) note(feature);
    const pl::FeatureExtraction& pl = logic.pl;
    note(pl.feature_packaging.feature_overflow.get(), pl.clock_crossing.crossing_overflow.get(),
         pl.blob_detection.label_overflow.get(), pl.axi_threshold_bridge.bridge_overflow.get(),
         pl.axi_threshold_bridge.packet_peak(), pl.bram.writes_a.get(), pl.bram.reads_b.get(),
         logic.image_link.beats.get(), logic.image_link.stalls.get());
    text += "\n";
  }
  for (const harness::StreamSink::Beat& beat : logic.sink.beats)
    note(beat.ps, beat.data, int{beat.last});
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(planted_bugs)

BOOST_AUTO_TEST_CASE(the_rtl_as_it_is_never_differs) {
  for (const std::string& ip : ips) {
    Logic logic({"pl.fidelity." + ip + "=lockstep:" + objects().file(ip)});
    BOOST_TEST(logic.failure() == "", ip);
  }
}

// All of them in the place of the models, and each alone among them.
BOOST_AUTO_TEST_CASE(in_the_place_of_the_models_nobody_sees_a_difference) {
  const std::string models = seen_of({});
  BOOST_TEST(models.size() > 10'000u);
  Strings all;
  for (const std::string& ip : ips) {
    all.push_back("pl.fidelity." + ip + "=" + objects().file(ip));
    BOOST_TEST((seen_of({all.back()}) == models), ip);
  }
  BOOST_TEST((seen_of(all) == models));
}

BOOST_AUTO_TEST_CASE(frames_wider_than_those_of_the_thesis) {
  harness::Image image = harness::rectangles(1280, 720, 300, 5);
  const harness::Image few = harness::noise(1280, 64, 9);
  std::copy(few.begin(), few.end(), image.end() - static_cast<std::ptrdiff_t>(few.size()));
  const auto words = [&image](const Strings& more) {
    Strings all = harness::frame_size(1280, 720);
    all.insert(all.end(), more.begin(), more.end());
    harness::Pipeline pipeline({100'000'000, 50'000'000}, all);
    pipeline.load(image);
    return pipeline.run_frame();
  };
  Strings rtl;
  for (const auto& [ip, values] : wide)
    rtl.push_back("pl.fidelity." + ip + "=" + objects().file(ip + "_wide"));
  const std::vector<harness::Word> expected = words({});
  const marker_logic::WordFormat format(1280, 720);
  BOOST_TEST(std::any_of(expected.begin(), expected.end(), [&](const harness::Word& word) {
    return word.kind != 'T' && format.x(word.first) > 1023 && format.y(word.first) > 511;
  }));
  BOOST_TEST(harness::first_difference(words(rtl), expected) == "");
  // A narrower one is refused, and the message says what to declare.
  BOOST_CHECK_EXCEPTION(
      words({"pl.fidelity.corner_detection=" + objects().file("corner_detection")}), vp::InputError,
      [](const vp::InputError& error) {
        return std::string(error.what()).find("'input logic [10:0] x'") != std::string::npos;
      });
}

BOOST_AUTO_TEST_CASE(each_is_found_at_its_port_behind_its_clock) {
  for (const Bug& bug : bugs) {
    BOOST_TEST_CONTEXT(bug.name) {
      std::string failure;
      {
        Logic logic({fidelity(bug, "lockstep:")});
        failure = logic.failure();
      }
      check_port(bug, failure);
      if (!carries_words(bug)) continue;
      const auto wrong = first_wrong_word(fidelity(bug, ""));
      BOOST_TEST_REQUIRE(wrong.has_value());
      BOOST_TEST(failure.find(", at " + vp::format_time(*wrong) + ": ") != std::string::npos,
                 failure << ", expected at " << vp::format_time(*wrong));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

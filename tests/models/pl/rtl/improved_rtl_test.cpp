// The RTL of the design `improved`, in a chain of its IP, with one, two and four pixels a clock: in
// lock-step with the models, in their place, and with bugs, each of which is found at its port.
#include <pl/blob_labelling/blob_labelling.h>
#include <pl/blob_stream/blob_stream.h>
#include <pl/camera/camera.h>
#include <pl/global_threshold/global_threshold.h>
#include <pl/local_threshold/local_threshold.h>
#include <pl/otsu_threshold/otsu_threshold.h>
#include <pl/pixel_stream/pixel_stream.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>

#include "frames.h"
#include "improved_chain.h"
#include "pipeline.h"
#include "rtl_objects.h"
#include "stream.h"

namespace {

using Strings = std::vector<std::string>;

const Bug bugs[] = {
    {"diagonal_lost", "blob_labelling", "pixel_labeller.sv", "start && (above || above_before)",
     "start && above", "label_overflow"},
    {"joined_is_forgotten", "blob_labelling", "label_extremes.sv", "? joined : answer",
     "? joined : '1", "extreme"},
    {"shown_too_soon", "blob_labelling", "leaving_blobs.sv", "SPACING = 3'd7", "SPACING = 3'd6",
     "blob_out"},
    {"one_label_less", "blob_labelling", "free_labels.sv", "fresh  <= unused != LAST",
     "fresh  <= unused + 1'b1 != LAST", ""},
    {"right_neighbour_missed", "blob_labelling", "pixel_labeller.sv",
     "assign right = above_right || (first_is_set && behind_first)", "assign right = above_right",
     ""},
    {"darker_only", "otsu_threshold", "otsu_threshold.sv", "8*lane+:8] <= active_threshold",
     "8*lane+:8] < active_threshold", "binary_out"},
    {"same_level_twice", "otsu_threshold", "level_counters.sv",
     "wire again = writes && written == raised && writes_bank == raises_bank",
     "wire again = 1'b0 && writes && written == raised && writes_bank == raises_bank",
     "active_threshold"},
    {"last_of_a_gap", "otsu_threshold", "otsu_search.sv", "variance > best", "variance >= best",
     "active_threshold"},
    {"logarithm_cut_short", "otsu_threshold", "coarse_log2.sv", "window[6+i+:10]",
     "{window[7+i+:9], 1'b0}", "active_threshold"},
    {"old_counts", "otsu_threshold", "level_counters.sv", "clear || (ended && bank != 1'(b))",
     "clear", "active_threshold"},
    {"mean_not_reached", "local_threshold", "local_threshold.sv", "limit <= {1'b0, sums",
     "limit < {1'b0, sums", "binary_out"},
    {"last_row_lost", "local_threshold", "local_threshold.sv", "row == R'(HEIGHT + RADIUS - 1)",
     "row == R'(HEIGHT + RADIUS - 2)", "binary_ena"},
    {"row_leaves_too_early", "local_threshold", "local_threshold.sv", "row == R'(WINDOW - 1)",
     "row == R'(WINDOW - 2)", "binary_out"},
    {"sums_of_the_frame_before", "local_threshold", "local_threshold.sv",
     "rows_above ? column_above", "1'b1 ? column_above", "binary_out"},
    {"border_counts_in_full", "local_threshold", "local_threshold.sv", "across <= across - 1'b1",
     "across <= across", "binary_out"},
    {"level_within_a_frame", "local_threshold", "local_threshold.sv", "if (!changes) level",
     "level", "binary_out"},
    {"last_word_early", "pixel_stream", "pixel_stream.sv", "FRAME_WORDS - 2", "FRAME_WORDS - 3",
     "m_tlast"},
    {"leftmost_on_top", "pixel_stream", "pixel_stream.sv", "{comes, gathered} >>",
     "{gathered, comes} >>", "m_tdata"},
    {"torn_frame", "pixel_stream", "pixel_stream.sv", "starts ? takes : passing",
     "starts ? 1'b1 : passing", ""},
    {"end_of_a_cut_packet", "pixel_stream", "pixel_stream.sv", "closing <= cut ? !first",
     "closing <= cut ? 1'b0", "m_t"},
    {"blob_without_room", "blob_stream", "blob_stream.sv", "sends ? fits_behind : fits",
     "sends ? fits_behind : room", ""},
    {"losses_not_told", "blob_stream", "blob_stream.sv", "32'(loses_blob));\n    end\n    // While",
     "32'd0);\n    end\n    // While", "m_tdata"},
    {"busy_too_short", "blob_stream", "blob_stream.sv", "packet_ends = sent_last && is_trailer",
     "packet_ends = push && is_trailer", "busy"},
    {"sum_not_turned", "blob_stream", "blob_stream.sv", "turned = {sum[30:0], sum[31]}",
     "turned = sum", "m_tdata"},
    {"threshold_not_summed", "blob_stream", "blob_stream.sv", "turned[15:0] ^ own, own}",
     "turned[15:0], own}", "m_tdata"},
    {"losses_of_all_frames", "blob_stream", "blob_stream.sv", "{last_word, lost",
     "{last_word, dropped_blobs", "m_tdata"},
    {"trigger_under_way", "camera", "camera.sv", "rises && !busy && !hold", "rises && !hold",
     "sensor_trigger"},
    {"held_trigger_not_counted", "camera", "camera.sv", "32'(rises && !starts)",
     "32'(rises && busy)", "dropped_triggers"},
    {"numbers_of_frames_only", "camera", "camera.sv", "triggers_before + 32'(rises)",
     "triggers_before + 32'(starts)", "frame_number"},
    {"rest_of_a_cut_frame", "camera", "camera.sv", "!rst && (takes || in_frame)",
     "takes || in_frame", "frame_ena"},
    {"coordinates_behind", "camera", "camera.sv", "pixel_x <= column;",
     "pixel_x <= line_ends ? '0 : column;", "pixel_x"},
    // Of several pixels a clock.
    {"leftmost_pixel_twice", "camera", "camera.sv",
     "{sensor_pixel_3, sensor_pixel_2, sensor_pixel_1, sensor_pixel}",
     "{sensor_pixel_3, sensor_pixel_2, sensor_pixel, sensor_pixel}", "pixel_1", 2},
    {"neighbours_swapped", "pixel_stream", "pixel_stream.sv", "{pixel_3, pixel_2, pixel_1, pixel}",
     "{pixel_3, pixel_1, pixel_2, pixel}", "m_tdata", 4},
    {"second_half_first", "pixel_stream", "pixel_stream.sv", "lane == 2'(4 - PIXELS_PER_CLOCK)",
     "lane == 2'(2 - PIXELS_PER_CLOCK)", "m_t", 2},
    {"first_word_lost", "pixel_stream", "pixel_stream.sv", "starts ? takes : passes",
     "starts ? 1'b0 : passes", "m_tdata", 4},
    {"first_word_not_counted", "pixel_stream", "pixel_stream.sv", "words <= WHOLE ? WORD_BITS'(1)",
     "words <= WHOLE ? WORD_BITS'(0)", "m_tlast", 4},
    {"another_neighbours_threshold", "otsu_threshold", "otsu_threshold.sv",
     "pixels_come[8*lane+:8] <= active", "pixels_come[8*(lane/2)+:8] <= active", "binary_out_", 4},
    {"word_ends_with_its_last_pixel", "otsu_threshold", "otsu_threshold.sv",
     "x[4:0] == 5'(32 - PIXELS_PER_CLOCK)", "x[4:0] == 5'd31", "thresh_out", 2},
    {"one_histogram_not_added", "otsu_threshold", "otsu_threshold.sv",
     "i < PIXELS_PER_CLOCK; i++) all", "i < PIXELS_PER_CLOCK - 1; i++) all", "active_threshold", 4},
    {"searched_a_clock_later", "otsu_threshold", "otsu_threshold.sv", "9'h000 : 9'h1FF",
     "9'h1FF : 9'h1FF", "active_threshold", 2},
    {"ends_of_the_second_run_lost", "blob_labelling", "group_runs.sv", "ends     <= valid ? found",
     "ends     <= valid ? found & 3'b101", "", 4},
    {"run_goes_on_in_the_next_row", "blob_labelling", "group_runs.sv", "i == P ? at_right",
     "i == P ? 1'b0", "", 2},
    {"touches_only_below", "blob_labelling", "run_merge.sv", "first <= second_behind",
     "first < second_behind", "", 4},
    {"one_run_too_many", "blob_labelling", "run_fifo.sv", "runs_come <= COUNT'(DEPTH - 1 - i)",
     "runs_come <= COUNT'(DEPTH - i)", "label_overflow", 4},
    {"lost_run_counts_one", "blob_labelling", "run_fifo.sv", "behind[0+:COLUMN] - first[0+:COLUMN]",
     "COLUMN'(1)", "label_overflow", 4},
    {"row_ends_a_clock_early", "blob_labelling", "run_merge.sv",
     "end_row   <= is_end && !more_above", "end_row   <= is_end", "", 2},
    {"first_window_too_wide", "local_threshold", "window_sums.sv", "i < P - BESIDE || !ends",
     "i < P", "binary_out", 4},
    {"window_loses_too_late", "local_threshold", "window_sums.sv", "- lane) / P + 1;",
     "- lane) / P + 2;", "binary_out", 2},
    {"border_of_a_neighbour", "local_threshold", "local_threshold.sv", "1 + RIGHT) - place",
     "2 + RIGHT) - place", "binary_out", 2},
    {"offset_alone", "local_threshold", "local_threshold.sv", "offsets > share ? offsets : share",
     "offsets", "binary_out", 2},
    {"later_of_equal_peaks", "global_threshold", "peak_search.sv", "{total, ~latest}",
     "{total, latest}", "active_threshold", 4},
    {"peak_of_the_first_pixel", "global_threshold", "peak_search.sv", "first || rank >= best",
     "first || rank > best", "active_threshold", 2},
    {"last_of_one_lane", "global_threshold", "peak_search.sv", "time_3 > time_2", "time_3 < time_2",
     "active_threshold", 4},
    {"clocks_of_the_frame_before", "global_threshold", "last_seen.sv", "clocks[{into, level}]",
     "clocks[{!into, level}]", "active_threshold", 2},
    {"searched_a_level_later", "global_threshold", "peak_search.sv", "passes[5] && at == 8'd255",
     "passes[5] && at == 8'd254", "active_threshold", 4},
    {"rows_behind_the_frame_missing", "blob_labelling", "run_merge.sv", "is_frame_end && !below",
     "1'b0 && is_frame_end && !below", "", 2},
};

/// What comes on an edge.
const std::uint32_t groups[] = {1, 2, 4};

/// Pixels on an edge where the local threshold takes a share of the mean.
constexpr std::uint32_t share_at = 2;
/// Pixels on an edge where packets have a checksum.
constexpr std::uint32_t checked_at = 1;

const Strings thresholds{"otsu_threshold", "global_threshold", "local_threshold"};
const Strings ips{"camera",          "blob_labelling", "otsu_threshold", "global_threshold",
                  "local_threshold", "pixel_stream",   "blob_stream"};

/// The threshold in the chain that tests `ip`.
std::string threshold_beside(const std::string& ip) {
  return std::count(thresholds.begin(), thresholds.end(), ip) != 0 ? ip : thresholds.front();
}
const pl::Models<pl::GlobalThreshold>& models_of(const std::string& threshold) {
  if (threshold == "otsu_threshold") return pl::OtsuThreshold::models();
  if (threshold == "local_threshold") return pl::LocalThreshold::models();
  return pl::GlobalThreshold::models();
}

constexpr pl::Geometry size{64, 32, 32};

std::string parameters(const std::string& ip, std::uint32_t pixels) {
  if (ip == "blob_stream")
    return pixels == checked_at ? "FIFO_DEPTH=20 CHECKSUM=1" : "FIFO_DEPTH=20";
  std::string all = "WIDTH=64 HEIGHT=32 PIXELS_PER_CLOCK=" + std::to_string(pixels);
  if (ip == "blob_labelling") all += " LABELS=16 MINIMUM_SIDE=2 RUN_FIFO_DEPTH=12";
  if (ip == "local_threshold") all += " RADIUS=3";
  if (ip == "local_threshold" && pixels != share_at) all += " RELATIVE=0 OFFSET=10";
  if (ip == "pixel_stream") all += " FIFO_DEPTH=6";
  return all;
}

/// The object of an IP without a bug.
std::string object_of(const std::string& ip, std::uint32_t pixels) {
  return ip == "blob_stream" && pixels != checked_at ? ip : ip + "_" + std::to_string(pixels);
}

const RtlObjects& objects() {
  static const RtlObjects built = [] {
    std::vector<RtlObjects::Object> all;
    for (const std::string& ip : ips) {
      for (const std::uint32_t pixels : groups) {
        const std::string name = object_of(ip, pixels);
        if (all.empty() || all.back().name != name)
          all.push_back({name, ip, parameters(ip, pixels)});
      }
    }
    for (const Bug& bug : bugs)
      all.push_back({bug.name, bug.ip, parameters(bug.ip, bug.pixels), &bug});
    return RtlObjects(all);
  }();
  return built;
}

std::string lockstep(const std::string& ip, const std::string& object) {
  return "fidelity." + ip + "=lockstep:" + objects().file(object);
}

struct Fidelity : sc_core::sc_module {
  Fidelity(sc_core::sc_module_name name, const std::string& rule)
      : sc_module(name), threshold(models_of(rule), pl::Fidelity::clocked, {&blob_labelling}) {}

  pl::Choice<pl::Camera> camera{pl::Camera::models(), pl::Fidelity::clocked};
  pl::Choice<pl::PixelStream> pixel_stream{pl::PixelStream::models(), pl::Fidelity::clocked};
  pl::Choice<pl::BlobStream> blob_stream{pl::BlobStream::models(), pl::Fidelity::clocked};
  pl::Choice<pl::BlobLabelling> blob_labelling{pl::BlobLabelling::models(), pl::Fidelity::clocked};
  pl::Choice<pl::GlobalThreshold> threshold;
};

/// Camera, threshold, labelling and both streams; the sinks take beats, or let them wait, at
/// random.
struct Chain : kit::Simulation {
  Chain(const Strings& more, const std::string& rule, std::uint32_t a_clock)
      : settings(settings_with(more, rule, a_clock)),
        fidelity("fidelity", rule),
        geometry{size.width, size.height, size.burst_words, a_clock},
        chain(build()) {
    chain.connect(control, false);
    chain.pixel_stream->m(pixels);
    chain.blob_stream->m(blobs);
    pixel_sink.s(pixels);
    blob_sink.s(blobs);
  }

  harness::ImprovedChain build() {
    harness::ImprovedChain made;
    made.camera = fidelity.camera.make({clk, geometry});
    const pl::Site site{made.camera->pixel_clk(), geometry};
    made.pixel_stream = fidelity.pixel_stream.make(site);
    made.threshold = fidelity.threshold.make(site);
    made.blob_labelling = fidelity.blob_labelling.make(site);
    made.blob_stream = fidelity.blob_stream.make(site);
    return made;
  }

  static Strings settings_with(const Strings& more, const std::string& rule,
                               std::uint32_t a_clock) {
    Strings all{"blob_labelling.label_count=16", "blob_labelling.minimum_side=2 px",
                "blob_labelling.run_fifo_depth=12", "pixel_stream.fifo_depth=6",
                "blob_stream.fifo_depth=20"};
    if (rule == "local_threshold") all.push_back("local_threshold.radius=3 px");
    if (rule == "local_threshold" && a_clock != share_at)
      all.insert(all.end(), {"local_threshold.relative=0", "local_threshold.offset=10"});
    if (a_clock == checked_at) all.push_back("blob_stream.checksum=true");
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::uint32_t group() const { return geometry.pixels_per_clock; }
  void clocks(std::uint64_t n) { sc_core::sc_start(vp::from_ps(n * 10'000)); }

  /// Triggers, and lets clocks pass until everything of the frame is over. How seldom a sink lets
  /// beats wait, in clocks.
  void run_frame(const harness::Image& image, unsigned pixels_wait, unsigned blobs_wait) {
    chain.camera->show(image);
    pixel_sink.accept(true);
    blob_sink.accept(true);
    control.ena = false;
    clocks(2);
    control.ena = true;
    for (std::uint64_t passed = 0; passed < size.pixels() + 1000;) {
      const unsigned n = 1 + random.below(30);
      clocks(n);
      passed += n;
      pixel_sink.accept(random.below(pixels_wait) != 0);
      blob_sink.accept(random.below(blobs_wait) != 0);
    }
    pixel_sink.accept(true);
    blob_sink.accept(true);
    clocks(300);
  }
  void reset(vp::Signal<bool>& which, std::uint64_t n) {
    which = true;
    clocks(n);
    which = false;
    clocks(5);
  }

  void play() {
    sc_core::sc_start(vp::from_ps(5'000));  // between two edges
    if (resets) {
      control.por = true;
      control.rst = true;
      clocks(3);
      control.por = false;
      control.rst = false;
      clocks(5);
    }
    constexpr unsigned never = ~0u;
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      run_frame(harness::rectangles(64, 32, 12, seed), never, never);
      run_frame(harness::noise(64, 32, seed), 9, 3);
      run_frame(spots(), never, 2);
      run_frame(frame_around(), 40, never);
      cut_frame(harness::rectangles(64, 32, 20, seed + 7), 64 + (300 + 400 * seed) / group());
    }
    control.wr_thresh = true;
    control.threshold = 90;
    run_frame(harness::stripes(64, 32), 4, 4);
    control.wr_thresh = false;
    // A threshold that comes while a frame runs.
    chain.camera->show(harness::noise(64, 32, 8));
    control.ena = false;
    clocks(2);
    control.ena = true;
    clocks(64 + 700 / group());
    control.wr_thresh = true;
    control.threshold = 60;
    clocks(2);
    control.wr_thresh = false;
    clocks(size.pixels() + 1000);
    // The slave is not ready when the frame begins; then it is a frame as any other.
    chain.camera->show(harness::noise(64, 32, 3));
    pixel_sink.accept(false);
    blob_sink.accept(false);
    control.ena = false;
    clocks(2);
    control.ena = true;
    clocks(400);
    pixel_sink.accept(true);
    blob_sink.accept(true);
    clocks(size.pixels() + 1000);
    run_frame(harness::Image(64 * 32, 220), never, never);  // nothing is dark
    trigger_at_random();
    run_frame(harness::rectangles(64, 32, 30, 9), never, never);
  }

  /// Most triggers come too early; some with a reset, of the frame or of the system.
  void trigger_at_random() {
    for (int i = 0; i < 60; ++i) {
      chain.camera->show(harness::noise(64, 32, 100 + static_cast<std::uint64_t>(i)));
      control.ena = false;
      clocks(1 + random.below(300));
      control.ena = true;
      control.rst = random.below(12) == 0;
      control.por = control.rst && random.below(2) == 0;
      clocks(1 + random.below(300));
      control.rst = false;
      control.por = false;
    }
    control.ena = false;
    clocks(size.pixels() + 1000);
  }

  void cut_frame(const harness::Image& image, std::uint64_t after) {
    chain.camera->show(image);
    control.ena = false;
    clocks(2);
    control.ena = true;
    clocks(after);
    reset(control.rst, 2);
  }

  /// Many small blobs: more than there are labels, and more than the FIFO holds.
  static harness::Image spots() {
    harness::Image image(64 * 32, 220);
    for (int y = 0; y + 4 < 32; y += 5) {
      for (int x = 0; x + 3 < 64; x += 4) harness::draw(image, 64, x, y, x + 2, y + 3, 30);
    }
    return image;
  }
  /// A frame whose left side is one column wide, around two levels that lie far apart.
  static harness::Image frame_around() {
    harness::Image image(64 * 32, 200);
    harness::draw(image, 64, 0, 0, 63, 0, 10);
    harness::draw(image, 64, 0, 31, 63, 31, 10);
    harness::draw(image, 64, 0, 0, 0, 31, 10);
    harness::draw(image, 64, 63, 0, 63, 31, 10);
    harness::draw(image, 64, 20, 10, 40, 20, 12);
    return image;
  }

  std::string failure() {
    return failure_of([this] { play(); });
  }
  std::string seen() {
    play();
    return chain.seen(pixel_sink, blob_sink);
  }

  bool resets = true;  ///< before the first frame
  harness::Settings settings;
  harness::Random random{5};
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  harness::ChainControl control;
  Fidelity fidelity;
  const pl::Geometry geometry;
  harness::ImprovedChain chain;
  vp::AxiStream pixels{"pixels"}, blobs{"blobs"};
  harness::StreamSink pixel_sink{"pixel_sink", chain.camera->pixel_clk()},
      blob_sink{"blob_sink", chain.camera->pixel_clk()};
};

}  // namespace

BOOST_AUTO_TEST_SUITE(improved_rtl)

BOOST_AUTO_TEST_CASE(the_rtl_as_it_is_never_differs) {
  for (const std::uint32_t pixels : groups) {
    for (const std::string& ip : ips) {
      const std::string object = object_of(ip, pixels);
      BOOST_TEST(Chain({lockstep(ip, object)}, threshold_beside(ip), pixels).failure() == "",
                 object << ", " << pixels);
    }
  }
}

// As in the platform, which begins behind a reset that is not seen.
BOOST_AUTO_TEST_CASE(without_a_reset_the_rtl_begins_as_its_model) {
  for (const std::uint32_t pixels : groups) {
    for (const std::string& ip : ips) {
      const std::string object = object_of(ip, pixels);
      Chain chain({lockstep(ip, object)}, threshold_beside(ip), pixels);
      chain.resets = false;
      BOOST_TEST(chain.failure() == "", object << ", " << pixels);
    }
  }
}

// Each alone, and all of them, in the place of the models.
BOOST_AUTO_TEST_CASE(in_the_place_of_the_models_nobody_sees_a_difference) {
  for (const std::uint32_t pixels : groups) {
    for (const std::string& rule : thresholds) {
      const std::string models = Chain({}, rule, pixels).seen();
      BOOST_TEST(models.size() > 10'000u);
      Strings all;
      for (const std::string& ip : {std::string("camera"), std::string("blob_labelling"), rule,
                                    std::string("pixel_stream"), std::string("blob_stream")}) {
        all.push_back("fidelity." + ip + "=" + objects().file(object_of(ip, pixels)));
        BOOST_TEST((Chain({all.back()}, rule, pixels).seen() == models), ip << ", " << pixels);
      }
      BOOST_TEST((Chain(all, rule, pixels).seen() == models), pixels);
    }
  }
}

// Behind the gate of a camera that blanks its lines the RTL sees what it always sees.
BOOST_AUTO_TEST_CASE(blanked_lines_are_nothing_to_the_rtl) {
  for (const std::uint32_t pixels : groups) {
    const std::string blanking = "camera.line_blanking=" + std::to_string(13 / pixels) + " cycles";
    const std::string rule = pixels == 2 ? "local_threshold" : "otsu_threshold";
    Strings beside{blanking}, in_place{blanking};
    for (const std::string& ip : {std::string("camera"), std::string("blob_labelling"), rule,
                                  std::string("pixel_stream"), std::string("blob_stream")}) {
      beside.push_back(lockstep(ip, object_of(ip, pixels)));
      in_place.push_back("fidelity." + ip + "=" + objects().file(object_of(ip, pixels)));
    }
    BOOST_TEST(Chain(beside, rule, pixels).failure() == "", pixels);
    const std::string models = Chain({blanking}, rule, pixels).seen();
    BOOST_TEST(models != Chain({}, rule, pixels).seen(), "it came later");
    BOOST_TEST((Chain(in_place, rule, pixels).seen() == models), pixels);
  }
}

BOOST_AUTO_TEST_CASE(each_bug_is_found_at_its_port) {
  for (const Bug& bug : bugs) {
    const std::string failure =
        Chain({lockstep(bug.ip, bug.name)}, threshold_beside(bug.ip), bug.pixels).failure();
    check_port(bug, failure);
  }
}

// RTL for another number of pixels a clock is reported by its parameter, or by the pins that it
// lacks.
BOOST_AUTO_TEST_CASE(rtl_of_another_number_of_pixels_is_refused) {
  const auto refused = [](std::uint32_t built, std::uint32_t pixels) {
    try {
      Chain({lockstep("pixel_stream", object_of("pixel_stream", built))}, "otsu_threshold", pixels);
    } catch (const vp::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const auto& [built, pixels] : {std::pair{1u, 2u}, {2u, 1u}, {4u, 2u}}) {
    const std::string text = refused(built, pixels);
    const std::string expected =
        "PIXELS_PER_CLOCK is " + std::to_string(built) + ", and pl.pixels_per_clock " +
        std::to_string(pixels) +
        ": build it with PARAMETERS PIXELS_PER_CLOCK=" + std::to_string(pixels);
    BOOST_TEST(text.find(expected) != std::string::npos, text);
  }
}

BOOST_AUTO_TEST_SUITE_END()

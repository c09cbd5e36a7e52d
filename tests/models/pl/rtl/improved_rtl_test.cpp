// The RTL of the design `improved`, in a chain of its IP: in lock-step with the models, in their
// place, and with bugs, each of which is found at its port.
#include <pl/blob_labelling/blob_labelling.h>
#include <pl/blob_stream/blob_stream.h>
#include <pl/camera/camera.h>
#include <pl/local_threshold/local_threshold.h>
#include <pl/otsu_threshold/otsu_threshold.h>
#include <pl/pixel_stream/pixel_stream.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>

#include <boost/test/unit_test.hpp>

#include "frames.h"
#include "pipeline.h"
#include "rtl_objects.h"
#include "stream.h"

namespace {

using Strings = std::vector<std::string>;

const Bug bugs[] = {
    {"diagonal_lost", "blob_labelling", "blob_labelling.sv", "start && (above || above_before)",
     "start && above", "label_overflow"},
    {"joined_is_forgotten", "blob_labelling", "label_extremes.sv", "join_2 ? answer", "join_2 ? '1",
     "extreme"},
    {"shown_too_soon", "blob_labelling", "leaving_blobs.sv", "SPACING = 3'd7", "SPACING = 3'd6",
     "blob_out"},
    {"one_label_less", "blob_labelling", "free_labels.sv", "fresh  <= unused != LAST",
     "fresh  <= unused + 1'b1 != LAST", ""},
    {"right_neighbour_missed", "blob_labelling", "blob_labelling.sv",
     "assign right = above_right || (first_is_set && behind_first)", "assign right = above_right",
     ""},
    {"darker_only", "otsu_threshold", "otsu_threshold.sv", "pixel <= active_threshold",
     "pixel < active_threshold", "binary_out"},
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
    {"mean_not_reached", "local_threshold", "local_threshold.sv", "limit <= {1'b0, sum}",
     "limit < {1'b0, sum}", "binary_out"},
    {"last_row_lost", "local_threshold", "local_threshold.sv", "row == R'(HEIGHT + RADIUS) && next",
     "row == R'(HEIGHT + RADIUS - 1) && next", "binary_ena"},
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
    {"leftmost_on_top", "pixel_stream", "pixel_stream.sv", "word = {pixel, gathered}",
     "word = {gathered, pixel}", "m_tdata"},
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
    {"losses_of_all_frames", "blob_stream", "blob_stream.sv", "{24'd0, threshold_used, lost",
     "{24'd0, threshold_used, dropped_blobs", "m_tdata"},
};

const Strings ips{"blob_labelling", "otsu_threshold", "local_threshold", "pixel_stream",
                  "blob_stream"};

/// The threshold in the chain that tests `ip`.
std::string threshold_beside(const std::string& ip) {
  return ip == "local_threshold" ? ip : "otsu_threshold";
}

constexpr pl::Geometry size{64, 32, 32};

std::string parameters(const std::string& ip) {
  if (ip == "blob_labelling") return "WIDTH=64 HEIGHT=32 LABELS=16 MINIMUM_SIDE=2";
  if (ip == "local_threshold") return "WIDTH=64 HEIGHT=32 RADIUS=3";
  if (ip == "pixel_stream") return "WIDTH=64 HEIGHT=32 FIFO_DEPTH=6";
  return ip == "blob_stream" ? "FIFO_DEPTH=20" : "WIDTH=64 HEIGHT=32";
}

const RtlObjects& objects() {
  static const RtlObjects built = [] {
    std::vector<RtlObjects::Object> all;
    for (const std::string& ip : ips) all.push_back({ip, ip, parameters(ip)});
    for (const Bug& bug : bugs) all.push_back({bug.name, bug.ip, parameters(bug.ip), &bug});
    return RtlObjects(all);
  }();
  return built;
}

std::string lockstep(const std::string& ip, const std::string& object) {
  return "fidelity." + ip + "=lockstep:" + objects().file(object);
}

struct Fidelity : sc_core::sc_module {
  Fidelity(sc_core::sc_module_name name, const std::string& rule)
      : sc_module(name),
        threshold(
            rule == "otsu_threshold" ? pl::OtsuThreshold::models() : pl::LocalThreshold::models(),
            pl::Fidelity::clocked, {&blob_labelling}) {}

  pl::Choice<pl::PixelStream> pixel_stream{pl::PixelStream::models(), pl::Fidelity::clocked};
  pl::Choice<pl::BlobStream> blob_stream{pl::BlobStream::models(), pl::Fidelity::clocked};
  pl::Choice<pl::BlobLabelling> blob_labelling{pl::BlobLabelling::models(), pl::Fidelity::clocked};
  pl::Choice<pl::GlobalThreshold> threshold;
};

/// Camera, threshold, labelling and both streams; the sinks take beats, or let them wait, at
/// random.
struct Chain : kit::Simulation {
  explicit Chain(const Strings& more, const std::string& rule = "otsu_threshold")
      : settings(settings_with(more, rule)), fidelity("fidelity", rule) {
    camera->ena(ena);
    camera->por(por);
    camera->hold(blob_stream->busy);
    for (vp::In<bool>* port : {&camera->rst, &pixel_stream->rst, &threshold->rst,
                               &blob_labelling->rst, &blob_stream->rst})
      port->bind(rst);
    pixel_stream->ena(camera->frame_ena);
    pixel_stream->pixel(camera->pixel);
    pixel_stream->m(pixels);
    threshold->por(por);
    threshold->frame_ena(camera->frame_ena);
    threshold->wr_thresh(wr_thresh);
    threshold->threshold(level);
    threshold->pixel(camera->pixel);
    threshold->x(camera->pixel_x);
    threshold->y(camera->pixel_y);
    blob_labelling->ena(threshold->binary_ena);
    blob_labelling->pixel(threshold->binary_out);
    blob_labelling->x(threshold->binary_x);
    blob_labelling->y(threshold->binary_y);
    blob_stream->frame_ena(camera->frame_ena);
    blob_stream->frame_number(camera->frame_number);
    blob_stream->threshold(threshold->active_threshold);
    blob_stream->idle(blob_labelling->idle);
    blob_stream->blob_out(blob_labelling->blob_out);
    for (std::size_t i = 0; i < blob_stream->extreme.size(); ++i)
      blob_stream->extreme[i](blob_labelling->extreme[i]);
    blob_stream->label_overflow(blob_labelling->label_overflow);
    blob_stream->m(blobs);
    pixel_sink.s(pixels);
    blob_sink.s(blobs);
  }

  static Strings settings_with(const Strings& more, const std::string& rule) {
    Strings all{"blob_labelling.label_count=16", "blob_labelling.minimum_side=2 px",
                "pixel_stream.fifo_depth=6", "blob_stream.fifo_depth=20"};
    if (rule == "local_threshold") all.push_back("local_threshold.radius=3 px");
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  void clocks(std::uint64_t n) { sc_core::sc_start(vp::from_ps(n * 10'000)); }

  /// Triggers, and lets clocks pass until everything of the frame is over. How seldom a sink lets
  /// beats wait, in clocks.
  void run_frame(const harness::Image& image, unsigned pixels_wait, unsigned blobs_wait) {
    camera->show(image);
    pixel_sink.accept(true);
    blob_sink.accept(true);
    ena = false;
    clocks(2);
    ena = true;
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
      por = true;
      rst = true;
      clocks(3);
      por = false;
      rst = false;
      clocks(5);
    }
    constexpr unsigned never = ~0u;
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      run_frame(harness::rectangles(64, 32, 12, seed), never, never);
      run_frame(harness::noise(64, 32, seed), 9, 3);
      run_frame(spots(), never, 2);
      run_frame(frame_around(), 40, never);
      cut_frame(harness::rectangles(64, 32, 20, seed + 7), 300 + 400 * seed);
    }
    wr_thresh = true;
    level = 90;
    run_frame(harness::stripes(64, 32), 4, 4);
    wr_thresh = false;
    // A threshold that comes while a frame runs.
    camera->show(harness::noise(64, 32, 8));
    ena = false;
    clocks(2);
    ena = true;
    clocks(700);
    wr_thresh = true;
    level = 60;
    clocks(2);
    wr_thresh = false;
    clocks(size.pixels() + 1000);
    // The slave is not ready when the frame begins; then it is a frame as any other.
    camera->show(harness::noise(64, 32, 3));
    pixel_sink.accept(false);
    blob_sink.accept(false);
    ena = false;
    clocks(2);
    ena = true;
    clocks(400);
    pixel_sink.accept(true);
    blob_sink.accept(true);
    clocks(size.pixels() + 1000);
    run_frame(harness::rectangles(64, 32, 30, 9), never, never);
  }

  void cut_frame(const harness::Image& image, std::uint64_t after) {
    camera->show(image);
    ena = false;
    clocks(2);
    ena = true;
    clocks(after);
    reset(rst, 2);
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
    try {
      play();
      sc_core::sc_stop();
    } catch (const sc_core::sc_report& report) {
      return report.get_msg();
    }
    return "";
  }
  /// What leaves the chain, with the times.
  std::string seen() {
    play();
    std::string text;
    for (const harness::StreamSink* sink : {&pixel_sink, &blob_sink}) {
      for (const harness::StreamSink::Beat& beat : sink->beats)
        text += std::to_string(beat.ps) + " " + std::to_string(beat.data) + " " +
                std::to_string(beat.last) + "\n";
    }
    for (const std::uint32_t count :
         {pixel_stream->dropped_frames.get(), pixel_stream->cut_frames.get(),
          blob_stream->dropped_frames.get(), blob_stream->dropped_blobs.get(),
          blob_labelling->label_overflow.get()})
      text += std::to_string(count) + " ";
    return text;
  }

  bool resets = true;  ///< before the first frame
  harness::Settings settings;
  harness::Random random{5};
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  vp::Signal<bool> ena{"ena"}, rst{"rst"}, por{"por"}, wr_thresh{"wr_thresh"};
  vp::Signal<std::uint8_t> level{"level"};
  Fidelity fidelity;
  const pl::Site site{clk, size};
  std::unique_ptr<pl::Camera> camera = pl::Camera::models().list().at(0).make("camera", site);
  std::unique_ptr<pl::PixelStream> pixel_stream = fidelity.pixel_stream.make(site);
  std::unique_ptr<pl::GlobalThreshold> threshold = fidelity.threshold.make(site);
  std::unique_ptr<pl::BlobLabelling> blob_labelling = fidelity.blob_labelling.make(site);
  std::unique_ptr<pl::BlobStream> blob_stream = fidelity.blob_stream.make(site);
  vp::AxiStream pixels{"pixels"}, blobs{"blobs"};
  harness::StreamSink pixel_sink{"pixel_sink", clk}, blob_sink{"blob_sink", clk};
};

}  // namespace

BOOST_AUTO_TEST_SUITE(improved_rtl)

BOOST_AUTO_TEST_CASE(the_rtl_as_it_is_never_differs) {
  for (const std::string& ip : ips)
    BOOST_TEST(Chain({lockstep(ip, ip)}, threshold_beside(ip)).failure() == "", ip);
}

// As in the platform, which begins behind a reset that nobody sees.
BOOST_AUTO_TEST_CASE(without_a_reset_the_rtl_begins_as_its_model) {
  for (const std::string& ip : ips) {
    Chain chain({lockstep(ip, ip)}, threshold_beside(ip));
    chain.resets = false;
    BOOST_TEST(chain.failure() == "", ip);
  }
}

// Each alone, and all of them, in the place of the models.
BOOST_AUTO_TEST_CASE(in_the_place_of_the_models_nobody_sees_a_difference) {
  for (const std::string rule : {"otsu_threshold", "local_threshold"}) {
    const std::string models = Chain({}, rule).seen();
    BOOST_TEST(models.size() > 10'000u);
    Strings all;
    for (const std::string& ip : {std::string("blob_labelling"), rule, std::string("pixel_stream"),
                                  std::string("blob_stream")}) {
      all.push_back("fidelity." + ip + "=" + objects().file(ip));
      BOOST_TEST((Chain({all.back()}, rule).seen() == models), ip);
    }
    BOOST_TEST((Chain(all, rule).seen() == models));
  }
}

BOOST_AUTO_TEST_CASE(each_bug_is_found_at_its_port) {
  for (const Bug& bug : bugs) {
    const std::string failure =
        Chain({lockstep(bug.ip, bug.name)}, threshold_beside(bug.ip)).failure();
    const std::size_t ports = failure.find(": ", failure.find(", at "));
    BOOST_TEST_REQUIRE(ports != std::string::npos, bug.name << ": " << failure);
    BOOST_TEST(failure.compare(ports + 2, std::string(bug.port).size(), bug.port) == 0,
               bug.name << ": " << failure);
  }
}

BOOST_AUTO_TEST_SUITE_END()

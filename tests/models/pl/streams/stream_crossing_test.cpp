// A camera with blanked lines and a pixel clock of its own: the same words at the same times at
// both fidelities, what crosses to the clock of the buses, and when.
#include <boost/test/unit_test.hpp>

#include <pl/camera/camera_clock.h>
#include <pl/control_crossing/control_crossing.h>
#include <pl/local_threshold/local_threshold.h>
#include <pl/otsu_threshold/otsu_threshold.h>
#include <pl/stream_crossing/stream_crossing.h>
#include <vp/error.h>

#include <algorithm>

#include "improved_chain.h"
#include "stream_bench.h"

namespace {

using namespace streams;

struct Setup {
  std::uint64_t camera_hz, bus_hz;
  std::uint32_t line_blanking, pixels_per_clock;
  bool local;
  std::uint64_t seed;
};

/// The IP that take pixels, behind a camera, and what leaves them behind the crossings.
struct CrossedChain : kit::Simulation {
  CrossedChain(const Setup& setup, bool tlm)
      : settings({"camera.line_blanking=" + std::to_string(setup.line_blanking) + " cycles",
                  "local_threshold.radius=2 px", "pixel_stream.fifo_depth=12"}),
        setup(setup),
        random(setup.seed),
        bus("bus", scheduler, setup.bus_hz),
        camera_clk("camera_clk", scheduler, setup.camera_hz),
        chain(build(tlm)) {
    reports.redirect(warnings);
    control.ena_in(software.ena);
    control.rst_in(software.rst);
    control.por_in(software.por);
    control.wr_thresh_in(software.wr_thresh);
    control.threshold_in(software.threshold);
    chain.connect(control, tlm);
    connect(pixel_crossing, chain.pixel_stream->m, pixels_before, pixels, pixel_sink);
    connect(blob_crossing, chain.blob_stream->m, blobs_before, blobs, blob_sink);
  }

  template <class Ip>
  std::unique_ptr<Ip> make(const pl::Models<Ip>& models, bool tlm, vp::Clock& clk) {
    const auto& list = models.list();
    const std::size_t model = tlm ? list.size() - 1 : 0;
    return list.at(model).make(models.ip().c_str(), {clk, in_groups(setup.pixels_per_clock)});
  }
  harness::ImprovedChain build(bool tlm) {
    harness::ImprovedChain made;
    made.camera = make(pl::Camera::models(), tlm, camera_clk);
    vp::Clock& clk = made.camera->pixel_clk();
    made.pixel_stream = make(pl::PixelStream::models(), tlm, clk);
    made.threshold =
        make(setup.local ? pl::LocalThreshold::models() : pl::OtsuThreshold::models(), tlm, clk);
    made.blob_labelling = make(pl::BlobLabelling::models(), tlm, clk);
    made.blob_stream = make(pl::BlobStream::models(), tlm, clk);
    return made;
  }
  void connect(pl::StreamCrossing& crossing, vp::AxiStreamMaster& from, vp::AxiStream& before,
               vp::AxiStream& behind, harness::StreamSink& sink) {
    from(before);
    crossing.entry().s(before);
    crossing.entry().rst(control.rst);
    crossing.m(behind);
    sink.s(behind);
  }

  void pass(std::uint64_t ps) { sc_core::sc_start(vp::from_ps(ps)); }
  void set(vp::Signal<bool>& level, bool value) {
    scheduler.synchronise();
    level = value;
  }
  /// From the rise of `ena` on.
  void trigger() {
    set(software.ena, false);
    pass(500'000);
    set(software.ena, true);
  }
  std::uint64_t frame_ps() const {
    const std::uint64_t lines = small_frame.height;
    const std::uint64_t clocks =
        64 + small_frame.pixels() / setup.pixels_per_clock + lines * setup.line_blanking + 500;
    return camera_clk.duration_ps(static_cast<double>(clocks));
  }
  void accept(bool ready) {
    scheduler.synchronise();
    pixel_sink.accept(ready);
    blob_sink.accept(ready);
  }

  /// Frames, some of them cut by a reset, with sinks that let words wait.
  void play() {
    pass(1'000'000);
    for (int frame = 0; frame < 6; ++frame) {
      chain.camera->show(frame % 2 == 0 ? harness::rectangles(64, 16, 6, setup.seed + frame)
                                        : harness::noise(64, 16, setup.seed + frame));
      accept(frame != 2);  // one that is not taken
      trigger();
      const bool cut = frame == 1 || frame == 4;
      std::uint64_t left = frame_ps();
      if (cut) left = left / 8 + random.below(static_cast<std::uint32_t>(left / 2));
      while (left > 0) {
        const std::uint64_t step = std::min<std::uint64_t>(left, 100'000 + random.below(900'000));
        pass(step);
        left -= step;
        if (frame == 5 && chain.camera->frame_ena) accept(random.below(3) != 0);
      }
      if (cut) {
        set(software.ena, false);  // or it would trigger again
        set(software.rst, true);
        pass(400'000 + random.below(100'000));
        set(software.rst, false);
      }
      accept(true);
      pass(3'000'000);
    }
  }
  std::string seen() {
    play();
    return chain.seen(pixel_sink, blob_sink) + " " +
           std::to_string(chain.camera->dropped_triggers) + " " +
           std::to_string(pixels_before.stalls.get()) + warnings.str();
  }

  harness::Settings settings;
  const Setup setup;
  harness::Random random;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock bus, camera_clk;
  harness::ChainControl software;
  harness::ImprovedChain chain;
  pl::ControlCrossingClocked control{"control_crossing", {camera_clk, small_frame}};
  const pl::Site between{chain.camera->pixel_clk(), small_frame, &bus};
  pl::StreamCrossingClocked pixel_crossing{"pixel_crossing", between};
  pl::StreamCrossingClocked blob_crossing{"blob_crossing", between};
  vp::AxiStream pixels_before{"pixels_before"}, pixels{"pixels"}, blobs_before{"blobs_before"},
      blobs{"blobs"};
  harness::StreamSink pixel_sink{"pixel_sink", bus}, blob_sink{"blob_sink", bus};
  std::ostringstream warnings;
  vp::ReportRouter reports;
};

std::vector<std::uint32_t> words_of(const harness::Image& image) {
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < image.size(); i += 4) {
    words.push_back(image[i] | image[i + 1] << 8 | image[i + 2] << 16 |
                    static_cast<std::uint32_t>(image[i + 3]) << 24);
  }
  return words;
}

/// Notes when a signal rises.
struct Rises : vp::SignalListener {
  explicit Rises(vp::Signal<bool>& signal, vp::ClockScheduler& scheduler) : scheduler(scheduler) {
    signal.attach(*this);
  }
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    (signal.bits() != 0 ? rises : falls).push_back(scheduler.now_ps());
  }
  vp::ClockScheduler& scheduler;
  std::vector<std::uint64_t> rises, falls;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(crossing)

BOOST_AUTO_TEST_CASE(both_fidelities_give_the_same_words_at_the_same_times) {
  harness::Random random(3);
  const std::uint64_t cameras[] = {25'175'000, 100'000'000, 74'250'000, 130'000'000};
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Setup setup{cameras[seed % 4],
                      seed % 3 == 0 ? 66'666'667u : 100'000'000u,
                      seed % 5 == 0 ? 0 : 1 + random.below(40),
                      1u << seed % 3,
                      random.below(2) != 0,
                      seed};
    const std::string clocked = CrossedChain(setup, false).seen();
    BOOST_TEST(clocked.size() > 3'000u, "seed " << seed);
    BOOST_TEST((CrossedChain(setup, true).seen() == clocked), "seed " << seed);
  }
}

// A frame that is not taken is dropped whole, and none after it; of one that a reset cuts nothing
// comes later.
BOOST_AUTO_TEST_CASE(frames_are_whole_or_not_there) {
  for (const bool tlm : {false, true}) {
    CrossedChain whole({25'175'000, 100'000'000, 20, 1, false, 5}, tlm);
    whole.play();
    BOOST_TEST(whole.chain.pixel_stream->cut_frames.get() == 0u);
    std::vector<std::vector<std::uint32_t>> packets(1);
    for (const harness::StreamSink::Beat& beat : whole.pixel_sink.beats) {
      packets.back().push_back(beat.data);
      if (beat.last) packets.emplace_back();
    }
    // Frames 0, 3 and 5: the sink, which no software resets, has what passed of 1 and 4 before.
    BOOST_TEST_REQUIRE(packets.size() == 4u);
    BOOST_TEST(packets.back().empty());
    BOOST_TEST((packets[0] == words_of(harness::rectangles(64, 16, 6, 5))));
    const auto check = [&](const std::vector<std::uint32_t>& packet, const harness::Image& cut,
                           const harness::Image& whole_image) {
      std::vector<std::uint32_t> expected = words_of(cut);
      BOOST_TEST_REQUIRE(packet.size() > 256u);
      BOOST_TEST_REQUIRE(packet.size() < 512u);
      expected.resize(packet.size() - 256);
      for (const std::uint32_t word : words_of(whole_image)) expected.push_back(word);
      BOOST_TEST((packet == expected));
    };
    check(packets[1], harness::noise(64, 16, 6), harness::noise(64, 16, 8));
    check(packets[2], harness::rectangles(64, 16, 6, 9), harness::noise(64, 16, 10));
  }
}

// 25.175 MHz, 160 clocks behind a line, 45 lines behind a frame: 59.94 frames a second at most.
BOOST_AUTO_TEST_CASE(a_sensor_of_640x480_gives_59_94_frames_a_second) {
  constexpr std::uint64_t lines = 480, pixels = 640, blanking = 160, line = pixels + blanking,
                          between_frames = 45 * line + blanking;
  constexpr std::uint64_t frame = lines * line - blanking, period = between_frames + frame + 1;
  static_assert(period == 525 * line + 1);
  /// Raises ena again for each frame, at the first edge at which the camera takes it.
  struct Trigger : vp::Clocked {
    using Clocked::Clocked;
    void edge() override { ena = (clock().cycle() - 9) % every < every / 2; }
    std::uint64_t every = 0;
    vp::Signal<bool> ena{"ena"};
  };
  struct Bench : kit::Simulation {
    Bench(bool tlm, std::uint64_t every)
        : camera(pl::Camera::models().list().at(tlm).make("camera",
                                                          {clk, pl::Geometry{640, 480, 32}})) {
      trigger.every = every;
      camera->ena(trigger.ena);
      camera->rst(low);
      camera->por(low);
      camera->hold(low);
      sc_core::sc_start(vp::from_ps(clk.time_of(3 * period + 5'000)));
    }
    harness::Settings settings{
        {"camera.line_blanking=160 cycles",
         "camera.frame_blanking=" + std::to_string(between_frames) + " cycles"}};
    vp::ClockScheduler scheduler{"scheduler"};
    vp::Clock clk{"clk", scheduler, 25'175'000};
    Trigger trigger{"trigger", clk};
    vp::Signal<bool> low{"low"};
    std::unique_ptr<pl::Camera> camera;
    Rises frames{camera->frame_ena, scheduler};
  };
  for (const bool tlm : {false, true}) {
    Bench bench(tlm, period);
    BOOST_TEST(bench.camera->dropped_triggers.get() == 0u);
    // ena rises on edge 9, and is seen on edge 10.
    BOOST_REQUIRE(bench.frames.rises.size() == 3u);
    for (std::uint64_t i = 0; i < 3; ++i) {
      const std::uint64_t first = 10 + i * period + between_frames + 1;
      BOOST_TEST(bench.frames.rises[i] == bench.clk.time_of(first), tlm);
      BOOST_TEST(bench.frames.falls.at(i) == bench.clk.time_of(first + frame), tlm);
    }
    const auto two = static_cast<double>(bench.frames.rises[2] - bench.frames.rises[0]);
    BOOST_TEST(2e12 / two < 25.175e6 / (525 * 800));
    BOOST_TEST(2e12 / two > 59.94);
    // A clock less, and each second trigger comes too early.
    BOOST_TEST(Bench(tlm, period - 1).camera->dropped_triggers.get() == 2u);
  }
}

// In clocks of one frequency: TVALID on edge e, the word is written on e + 1, seen from the other
// side on e + 3, and offered there.
BOOST_AUTO_TEST_CASE(a_word_crosses_in_three_clocks) {
  struct Bench : kit::Simulation {
    Bench() {
      crossing.entry().rst(rst);
      source.m_axis(before);
      crossing.entry().s(before);
      crossing.m(behind);
      sink.s_axis(behind);
    }
    vp::ClockScheduler scheduler{"scheduler"};
    vp::Clock pixel{"pixel", scheduler, 100'000'000}, bus{"bus", scheduler, 100'000'000};
    vp::Signal<bool> rst{"rst"};
    pl::StreamCrossingClocked crossing{"crossing", {pixel, small_frame, &bus}};
    vp::AxiStream before{"before"}, behind{"behind"};
    vp::StreamSource source{"source", pixel};
    vp::StreamSink sink{"sink", bus};
  };
  Bench bench;
  bench.sink.sleep_until = 20;
  for (std::uint32_t i = 0; i < 40; ++i) bench.source.send(i, i == 19 || i == 39);
  sc_core::sc_start(vp::from_ps(1'500'000));
  BOOST_REQUIRE(bench.sink.beats.size() == 40u);
  for (std::uint32_t i = 0; i < 40; ++i) BOOST_TEST(bench.sink.beats[i].data == i);
  // Ready from edge 20 on, seen on 22, TREADY; the first word passes on 23.
  BOOST_TEST(bench.sink.beats[0].cycle == 23u + 3u);
  for (std::uint32_t i = 1; i < 20; ++i)
    BOOST_TEST(bench.sink.beats[i].cycle == bench.sink.beats[0].cycle + i, "a word a clock");
  // The next packet waits until the one before is seen to have left.
  BOOST_TEST(bench.sink.beats[20].cycle > bench.sink.beats[19].cycle + 4);
  // It waits from edge 43 on, as the first one did from edge 2 on.
  BOOST_TEST(bench.before.stalls.get() == 23u - 2u + bench.sink.beats[20].cycle - 3u - 43u);
  BOOST_TEST(bench.sink.beats[20].last == false);
  BOOST_TEST(bench.sink.beats[39].last == true);
}

BOOST_AUTO_TEST_CASE(a_level_too_short_for_the_pixel_clock_is_told) {
  const Setup slow{1'000'000, 100'000'000, 0, 1, false, 1};
  CrossedChain chain(slow, true);
  chain.pass(5'300'000);
  chain.set(chain.software.rst, true);
  chain.pass(100'000);
  chain.set(chain.software.rst, false);
  chain.pass(3'000'000);
  BOOST_TEST(chain.warnings.str().find("control_crossing") != std::string::npos);
  BOOST_TEST(chain.warnings.str().find("rst changed twice between two edges") != std::string::npos);
  CrossedChain longer(slow, true);
  longer.pass(5'300'000);
  longer.set(longer.software.rst, true);
  longer.pass(1'000'000);
  longer.set(longer.software.rst, false);
  longer.pass(3'000'000);
  BOOST_TEST(longer.warnings.str() == "");
}

BOOST_AUTO_TEST_CASE(what_no_camera_has_is_refused) {
  const auto refused = [](const std::string& setting) {
    try {
      kit::Simulation simulation;
      harness::Settings settings({setting});
      vp::ClockScheduler scheduler{"scheduler"};
      vp::Clock clk{"clk", scheduler, 100'000'000};
      pl::CameraClock camera_clk{"camera_clk", clk};
      const auto camera = pl::Camera::models().list().at(1).make("camera", {clk, small_frame});
      pl::StreamCrossingClocked crossing{"crossing", {camera->pixel_clk(), small_frame, &clk}};
    } catch (const vp::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(refused("camera.line_blanking=100000 cycles") == "");
  BOOST_TEST(refused("camera.line_blanking=100001 cycles").find("camera.line_blanking") !=
             std::string::npos);
  BOOST_TEST(refused("camera.line_blanking=3 px").find("camera.line_blanking") !=
             std::string::npos);
  BOOST_TEST(refused("camera_clk.frequency=25.175 MHz") == "");
  BOOST_TEST(refused("camera_clk.frequency=1.1 GHz").find("camera_clk.frequency") !=
             std::string::npos);
  BOOST_TEST(refused("crossing.depth=32") == "");
  for (const char* depth : {"crossing.depth=4", "crossing.depth=24"})
    BOOST_TEST(refused(depth).find("crossing.depth") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

// The camera and its frames through FIFO and DMA, at both fidelities.
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <vp/error.h>

#include "stream.h"
#include "stream_bench.h"

namespace {

using namespace streams;
namespace data = boost::unit_test::data;

std::string text(const std::vector<std::uint64_t>& numbers) {
  std::string all;
  for (const std::uint64_t n : numbers) all += std::to_string(n) + " ";
  return all;
}

// From the parameters' defaults.
constexpr std::uint64_t blanking = 64;

const bool both[] = {false, true};
pl::Fidelity fidelity(bool tlm) {
  return tlm ? pl::Fidelity::tlm : pl::Fidelity::clocked;
}

harness::Image image_of(std::uint64_t seed) {
  return harness::noise(64, 16, seed);
}

std::vector<std::uint8_t> bytes_at(ArmedDma& dma, std::uint32_t address, std::uint32_t count) {
  return {dma.memory.data() + address, dma.memory.data() + address + count};
}

/// A sink in the place of the DMA, which wants single beats.
struct SinkBench : kit::Simulation {
  explicit SinkBench(bool tlm, const std::vector<std::string>& assignments = {},
                     std::uint32_t pixels_per_clock = 1)
      : settings(assignments) {
    const pl::Geometry geometry = in_groups(pixels_per_clock);
    const auto& models = pl::PixelStream::models().list();
    const auto& cameras = pl::Camera::models().list();
    made_camera = cameras.at(tlm).make("camera", {clk, geometry});
    made_stream = models.at(tlm).make("pixel_stream", {clk, geometry});
    made_camera->ena(ena);
    made_camera->rst(rst);
    made_camera->por(rst);
    made_camera->hold(low);
    made_stream->rst(rst);
    made_stream->ena(made_camera->frame_ena);
    made_stream->pixel(made_camera->pixel);
    made_stream->more_pixels(made_camera->more_pixels);
    made_stream->frames(made_camera->frames);
    made_stream->m(link);
    sink.s(link);
    sink.accept(true);
    sc_core::sc_start(vp::from_ps(5'000));
    rst = true;
    clocks(1);
    rst = false;
  }
  void clocks(std::uint64_t n) { sc_core::sc_start(vp::from_ps(n * period)); }
  void trigger() {
    ena = false;
    clocks(1);
    ena = true;
  }

  harness::Settings settings;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  vp::Signal<bool> ena{"ena"}, rst{"rst"}, low{"low"};
  std::unique_ptr<pl::Camera> made_camera;
  std::unique_ptr<pl::PixelStream> made_stream;
  vp::AxiStream link{"link"};
  harness::StreamSink sink{"sink", clk};
};

}  // namespace

BOOST_AUTO_TEST_SUITE(pixel_stream)

BOOST_DATA_TEST_CASE(a_frame_comes_at_its_times, data::make(both), tlm) {
  PixelBench b(fidelity(tlm));
  const harness::Image image = image_of(1);
  std::uint64_t begin = 0, risen = 0, fallen = 0, done = 0;
  b.run([&] {
    b.camera.show(image);
    b.pixels.arm(0x100, frame_bytes);
    b.at(b.clk.cycle() + 20);
    begin = b.trigger();
    for (std::uint64_t cycle = begin; done == 0 && cycle < begin + 2000; ++cycle) {
      b.at(cycle);
      const bool high = b.camera.frame_ena;
      if (high && risen == 0) risen = cycle;
      if (!high && risen != 0 && fallen == 0) fallen = cycle;
      if (b.pixels.dma.s2mm_introut && done == 0) done = cycle;
    }
    BOOST_TEST(b.pixels.received() == frame_bytes);
    b.stream.settle();
  });
  BOOST_TEST(risen == begin + blanking + 1);
  BOOST_TEST(fallen == risen + frame_bytes);
  // The last pixel leaves one edge before frame_ena falls and is taken on it; the word goes through
  // FIFO and register. Then the DMA: burst, response, status, interrupt.
  BOOST_TEST(done == fallen + 2 + 23 + 16 + 20 + 5 + 1);
  BOOST_TEST(bytes_at(b.pixels, 0x100, frame_bytes) == image, boost::test_tools::per_element());
  BOOST_TEST(b.pixels.link.packets.get() == 1u);
  BOOST_TEST(b.stream.dropped_frames.get() == 0u);
}

// With four pixels a clock a word comes on each edge, the first one with the frame's begin.
BOOST_DATA_TEST_CASE(words_pass_two_clocks_after_their_last_pixel, data::make(both), tlm) {
  for (const std::uint32_t group : {1u, 2u, 4u}) {
    SinkBench b(tlm, {}, group);
    const harness::Image image = image_of(2);
    b.made_camera->show(image);
    b.trigger();
    const std::uint64_t first_pixel = kit::now_ps() + period / 2 + (blanking + 1) * period;
    b.clocks(blanking + frame_bytes / group + 10);
    BOOST_REQUIRE(b.sink.beats.size() == frame_bytes / 4);
    for (std::size_t i = 0; i < b.sink.beats.size(); ++i) {
      const auto& beat = b.sink.beats[i];
      const std::uint32_t word = image[4 * i] | image[4 * i + 1] << 8 | image[4 * i + 2] << 16 |
                                 std::uint32_t{image[4 * i + 3]} << 24;
      BOOST_REQUIRE_EQUAL(beat.data, word);
      BOOST_REQUIRE_EQUAL(beat.last, i + 1 == frame_bytes / 4);
      BOOST_REQUIRE_EQUAL(beat.ps, first_pixel + ((4 * i + 3) / group + 3) * period);
    }
  }
}

// Four pixels a clock fill the stream: bursts of 16 words with a gap of 10 clocks behind each are
// too slow at a word a clock, and fast enough at two.
BOOST_DATA_TEST_CASE(a_frame_of_groups_comes_at_its_times, data::make(both), tlm) {
  PixelBench b(fidelity(tlm), {}, 4);
  const harness::Image image = image_of(1);
  std::uint64_t begin = 0, fallen = 0, done = 0;
  b.run([&] {
    b.camera.show(image);
    b.pixels.arm(0x100, frame_bytes);
    b.at(b.clk.cycle() + 20);
    begin = b.trigger();
    bool was_high = false;
    for (std::uint64_t cycle = begin; done == 0 && cycle < begin + 2000; ++cycle) {
      b.at(cycle);
      const bool high = b.camera.frame_ena;
      if (was_high && !high) fallen = cycle;
      was_high = high;
      if (b.pixels.dma.s2mm_introut && done == 0) done = cycle;
    }
    b.stream.settle();
    BOOST_TEST(b.stream.cut_frames.get() == 0u);
  });
  BOOST_TEST(fallen == begin + blanking + 1 + frame_bytes / 4);
  // The last word of the first burst passes 3 clocks behind its pixels; a burst takes 8 clocks, and
  // the gap.
  const std::uint64_t first_burst = begin + blanking + 1 + 15 + 3 + 23;
  BOOST_TEST(done == first_burst + 16 * (8 + 10) - 10 + 20 + 5 + 1);
  BOOST_TEST(bytes_at(b.pixels, 0x100, frame_bytes) == image, boost::test_tools::per_element());
}

BOOST_DATA_TEST_CASE(a_frame_without_a_ready_slave_is_dropped_whole, data::make(both), tlm) {
  PixelBench b(fidelity(tlm));
  b.run([&] {
    b.camera.show(image_of(3));
    b.trigger();
    b.at(b.clk.cycle() + blanking + 20);
    b.pixels.arm(0, frame_bytes);  // too late for this one
    b.at(b.clk.cycle() + frame_bytes + 100);
    b.stream.settle();
    BOOST_TEST(b.stream.dropped_frames.get() == 1u);
    BOOST_TEST(b.pixels.link.beats.get() == 0u);
    b.camera.show(image_of(4));
    b.trigger();
    b.at(b.clk.cycle() + blanking + frame_bytes + 100);
    BOOST_TEST(b.pixels.received() == frame_bytes);
    b.stream.settle();
    BOOST_TEST(b.stream.dropped_frames.get() == 1u);
    BOOST_TEST(b.stream.cut_frames.get() == 0u);
    BOOST_TEST(b.camera.frame_number.get() == 1u);
  });
  BOOST_TEST(bytes_at(b.pixels, 0, frame_bytes) == image_of(4), boost::test_tools::per_element());
}

BOOST_DATA_TEST_CASE(an_overflow_ends_the_packet_early, data::make(both), tlm) {
  SinkBench b(tlm, {"pixel_stream.fifo_depth=8"});
  b.made_camera->show(image_of(5));
  b.trigger();
  b.clocks(blanking + 1 + 40 + 3);  // ten words have passed
  b.sink.accept(false);
  b.clocks(100);
  BOOST_TEST(b.made_stream->cut_frames.get() == 1u);
  b.sink.accept(true);
  b.clocks(frame_bytes);
  BOOST_TEST(b.made_stream->cut_frames.get() == 1u);
  BOOST_REQUIRE(b.sink.beats.size() == 10u + 1u + 8u + 1u);  // register, FIFO, and the end
  for (std::size_t i = 0; i < b.sink.beats.size(); ++i)
    BOOST_TEST(b.sink.beats[i].last == (i + 1 == b.sink.beats.size()));
  BOOST_TEST(b.sink.beats.back().data == 0u);
  b.trigger();
  b.clocks(blanking + frame_bytes + 10);
  BOOST_TEST(b.sink.beats.size() == 20u + frame_bytes / 4);
  BOOST_TEST(b.sink.beats.back().last);
}

BOOST_DATA_TEST_CASE(triggers_within_a_frame_are_dropped_and_counted, data::make(both), tlm) {
  PixelBench b(fidelity(tlm));
  b.run([&] {
    b.camera.show(image_of(6));
    b.pixels.arm(0, frame_bytes);
    b.trigger();
    b.at(b.clk.cycle() + 10);
    b.trigger();  // in the blanking
    b.at(b.clk.cycle() + blanking + 100);
    b.trigger();
    b.at(b.clk.cycle() + frame_bytes);
    BOOST_TEST(b.camera.dropped_triggers.get() == 2u);
    BOOST_TEST(b.camera.frame_number.get() == 0u);
    b.hold = true;
    b.trigger();
    b.at(b.clk.cycle() + blanking + 10);
    BOOST_TEST(b.camera.dropped_triggers.get() == 3u);
    BOOST_TEST(!b.camera.frame_ena.get());
    b.hold = false;
    b.trigger();
    b.at(b.clk.cycle() + blanking + 10);
    BOOST_TEST(b.camera.frame_ena.get());
    BOOST_TEST(b.camera.frame_number.get() == 4u);
    b.por = true;
    b.pulse_rst();
    b.por = false;
    BOOST_TEST(b.camera.dropped_triggers.get() == 0u);
    b.trigger();
    b.at(b.clk.cycle() + 2);
    BOOST_TEST(b.camera.frame_number.get() == 0u);
  });
}

// An exposure that ends between two edges: the blanking begins with the next.
BOOST_DATA_TEST_CASE(the_frame_comes_after_its_exposure, data::make(both), tlm) {
  PixelBench b(fidelity(tlm), {"camera.exposure=1234567 ps"});
  b.run([&] {
    b.camera.show(image_of(2));
    b.pixels.arm(0, frame_bytes);
    b.at(b.clk.cycle() + 20);
    const std::uint64_t begin = b.trigger();
    const std::uint64_t middle = b.clk.time_of(begin) + 1'234'567 / 2;
    b.at(begin + 124 + blanking);
    BOOST_TEST(b.camera.mid_exposure_ps() == middle);
    BOOST_TEST(!b.camera.frame_ena.get());
    b.trigger();  // neither exposure nor frame is disturbed
    b.at(begin + 124 + blanking + 1);
    BOOST_TEST(b.camera.frame_ena.get());
    b.at(begin + 124 + blanking + 1 + frame_bytes);
    BOOST_TEST(!b.camera.frame_ena.get());
    BOOST_TEST(b.camera.dropped_triggers.get() == 1u);
  });
}

BOOST_DATA_TEST_CASE(the_trigger_exposes_what_is_seen_then, data::make(both), tlm) {
  PixelBench b(fidelity(tlm));
  b.run([&] {
    b.camera.show(image_of(7));
    b.pixels.arm(0, frame_bytes);
    b.trigger();
    b.at(b.clk.cycle() + 2);
    b.camera.show(image_of(8));
    b.at(b.clk.cycle() + blanking + frame_bytes + 100);
  });
  BOOST_TEST(bytes_at(b.pixels, 0, frame_bytes) == image_of(7), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(an_image_of_another_size_is_refused) {
  PixelBench b(pl::Fidelity::tlm);
  BOOST_CHECK_EXCEPTION(b.camera.show(harness::Image(100)), vp::InputError,
                        [](const vp::InputError& error) {
                          return std::string(error.what()) ==
                                 "camera sees an image of 100 pixels: its frames have 1024";
                        });
}

namespace {

/// All that can be seen of a random run.
struct Seen {
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint8_t> memory;
};

// Triggers, resets of either side, transfers armed early, late, too short, not at all, or so that
// they leave the memory.
Seen random_run(bool tlm, std::uint64_t seed, std::uint32_t pixels_per_clock) {
  PixelBench b(
      fidelity(tlm),
      {"pixel_stream.fifo_depth=4", "camera.exposure=" + std::to_string(seed % 3 * 777) + " ns"},
      pixels_per_clock);
  Seen seen;
  const auto note = [&] {
    b.stream.settle();
    for (const std::uint64_t number :
         {b.clk.cycle(), std::uint64_t{b.stream.dropped_frames}, std::uint64_t{b.stream.cut_frames},
          std::uint64_t{b.camera.frame_number}, std::uint64_t{b.camera.dropped_triggers},
          std::uint64_t{b.camera.frame_ena}, std::uint64_t{b.pixels.dma.s2mm_introut},
          std::uint64_t{b.pixels.link.tready}, std::uint64_t{b.pixels.received()},
          b.pixels.link.beats.get(), b.pixels.link.packets.get()})
      seen.numbers.push_back(number);
  };
  harness::Random random(seed);
  b.run([&] {
    for (unsigned action = 0; action < 60; ++action) {
      b.at(b.clk.cycle() + 1 + random.below(random.below(2) ? 900 : 40));
      switch (random.below(8)) {
        case 0:
          b.pulse_rst();
          break;
        case 1:
          b.pixels.reset();
          break;
        case 2:
          b.pixels.acknowledge();
          break;
        case 3:
        case 4:
          b.pixels.arm(
              random.below(8) ? 4 * random.below(1024) : memory_bytes - 4 * (1 + random.below(250)),
              random.below(4) ? frame_bytes : 4 * (1 + random.below(200)));
          break;
        default:
          b.camera.show(image_of(random.below(100)));
          b.trigger();
      }
      note();
    }
  });
  seen.memory.assign(b.pixels.memory.data(), b.pixels.memory.data() + memory_bytes);
  return seen;
}

}  // namespace

BOOST_AUTO_TEST_CASE(both_fidelities_are_equal_in_random_runs) {
  std::uint64_t dropped = 0, whole = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const std::uint32_t group = 1u << seed % 3;
    const Seen clocked = random_run(false, seed, group), tlm = random_run(true, seed, group);
    BOOST_REQUIRE_MESSAGE(
        clocked.numbers == tlm.numbers,
        "seed " << seed << ": " << text(clocked.numbers) << " and at tlm " << text(tlm.numbers));
    BOOST_REQUIRE_MESSAGE(clocked.memory == tlm.memory, "memory of seed " << seed);
    dropped += clocked.numbers[clocked.numbers.size() - 10] != 0;
    whole += clocked.numbers.back() != 0;
  }
  BOOST_TEST(dropped > 20u, "the runs exercise what they should");
  BOOST_TEST(whole > 20u, "the runs exercise what they should");
}

BOOST_AUTO_TEST_SUITE_END()

// The models of Blob Labelling against each other: the same outputs on every clock, whatever
// resets, pauses and changes of pixels come. And what they refuse.
#include <pl/blob_labelling/blob_labelling.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <map>
#include <memory>
#include <ostream>

#include "pipeline.h"
#include "random_pictures.h"

using harness::Random;
using namespace labelling;

namespace {

/// What happens at the inputs, by the edge on which it leaves the source.
struct Script {
  struct Frame {
    Binary picture;
  };
  struct Change {
    std::uint32_t first = 0;
    std::vector<std::uint8_t> pixels;
  };
  std::map<std::uint64_t, Frame> frames;
  std::map<std::uint64_t, Change> changes;   ///< of the frame that runs
  std::map<std::uint64_t, unsigned> resets;  ///< and for how many clocks
  std::uint64_t end = 0;
};

/// Gives frames pixel by pixel and as a whole.
class Source final : public vp::Clocked {
 public:
  Source(sc_core::sc_module_name name, vp::Clock& clk, const Script& script,
         std::uint32_t pixels_per_clock)
      : Clocked(name, clk), more("pixel", pixels_per_clock), script_(script) {}

  vp::Signal<bool> ena{"ena"};
  vp::Signal<bool> rst{"rst"};
  vp::Signal<bool> pixel{"pixel"};
  pl::Lanes<vp::Signal<bool>> more;
  vp::Signal<std::uint16_t> x{"x"};
  vp::Signal<std::uint16_t> y{"y"};
  pl::BinaryFrames frames{"frames", clock()};

 private:
  void edge() override {
    const std::uint64_t cycle = clock().cycle();
    if (reset_left_ > 0) --reset_left_;
    if (const auto at = script_.frames.find(cycle); at != script_.frames.end()) {
      picture_ = at->second.picture;
      words_ = picture_.words();
      next_ = 0;
      running_ = true;
      frames.announce();
      frames.begin(words_.data(), static_cast<std::uint32_t>(words_.size()), cycle,
                   pixels_per_clock());
    }
    if (const auto at = script_.resets.find(cycle); at != script_.resets.end()) {
      reset_left_ = at->second;
      running_ = false;
      frames.cut();
    }
    rst = reset_left_ > 0;
    if (const auto at = script_.changes.find(cycle); at != script_.changes.end() && running_)
      change(at->second);
    ena = running_;
    if (!running_) return;
    pixel = picture_.pixels[next_];
    for (std::size_t lane = 0; lane < more.size(); ++lane)
      more[lane] = picture_.pixels[next_ + 1 + lane];
    x = static_cast<std::uint16_t>(next_ % picture_.width);
    y = static_cast<std::uint16_t>(next_ / picture_.width);
    next_ += pixels_per_clock();
    running_ = next_ < picture_.count();
  }

  std::uint32_t pixels_per_clock() const { return static_cast<std::uint32_t>(more.size()) + 1; }
  void change(const Script::Change& change) {
    // Only of pixels that leave on later edges.
    const std::uint32_t first = std::max(change.first, next_ + pixels_per_clock());
    const std::uint32_t end = std::min<std::uint32_t>(
        picture_.count(), change.first + static_cast<std::uint32_t>(change.pixels.size()));
    if (first >= end) return;
    for (std::uint32_t i = first; i < end; ++i)
      picture_.pixels[i] = change.pixels[i - change.first];
    const std::vector<std::uint32_t> words = picture_.words();
    std::copy(words.begin(), words.end(), words_.begin());
    frames.change(first, end - first);
  }

  const Script& script_;
  Binary picture_;
  std::vector<std::uint32_t> words_;
  std::uint32_t next_ = 0;
  bool running_ = false;
  unsigned reset_left_ = 0;
};

/// What stood at the outputs in a clock in which something changed.
struct Seen {
  std::uint64_t cycle = 0;
  bool idle = false, blob_out = false;
  std::vector<std::uint32_t> points;  ///< while blob_out is high

  bool same_as(const Seen& other) const {
    return idle == other.idle && blob_out == other.blob_out && points == other.points;
  }
  bool operator==(const Seen& other) const { return cycle == other.cycle && same_as(other); }
};
std::ostream& operator<<(std::ostream& out, const Seen& seen) {
  out << "clock " << seen.cycle << ": idle " << seen.idle << ", blob_out " << seen.blob_out;
  for (std::uint32_t point : seen.points)
    out << " (" << blob_stream::x(point) << ' ' << blob_stream::y(point) << ')';
  return out;
}

class Monitor final : public vp::Clocked {
 public:
  Monitor(sc_core::sc_module_name name, vp::Clock& clk, pl::BlobLabelling& ip)
      : Clocked(name, clk), ip_(ip) {
    blob_out_(ip.blob_out);
    idle_(ip.idle);
    lost_(ip.label_overflow);
    for (std::size_t i = 0; i < 8; ++i) {
      points_.push_back(std::make_unique<vp::In<std::uint32_t>>("point", this));
      (*points_[i])(ip.extreme[i]);
    }
  }

  std::vector<Seen> seen;
  std::vector<std::uint32_t> losses;  ///< when idle rose

 private:
  void edge() override {
    Seen now{clock().cycle(), idle_, blob_out_, {}};
    if (blob_out_) {
      for (const auto& point : points_) now.points.push_back(point->read());
    }
    if (idle_ && !seen.empty() && !seen.back().idle) losses.push_back(lost_);
    if (seen.empty() || !seen.back().same_as(now) || blob_out_) seen.push_back(now);
  }

  pl::BlobLabelling& ip_;
  vp::In<bool> blob_out_{"blob_out", this};
  vp::In<bool> idle_{"idle", this};
  vp::In<std::uint32_t> lost_{"lost", this};
  std::vector<std::unique_ptr<vp::In<std::uint32_t>>> points_;
};

/// Of runs: many of the pictures exceed it.
constexpr std::uint32_t fifo_depth = 12;

/// Clocks behind a frame's last pixel until the next may begin at any rate: those in the FIFO, and
/// those of the row above, have had their turn twice.
std::uint32_t gap(const pl::Geometry& g) {
  return g.pixels_per_clock == 1 ? g.width + 1 : g.width + 3 * fifo_depth + 8;
}

struct Bench : kit::Simulation {
  Bench(const std::string& model, const pl::Geometry& geometry, std::uint32_t labels,
        std::uint32_t side, const Script& what)
      : settings({"blob_labelling.label_count=" + std::to_string(labels),
                  "blob_labelling.minimum_side=" + std::to_string(side) + " px",
                  "blob_labelling.run_fifo_depth=" + std::to_string(fifo_depth)}),
        script(what),
        source("source", clk, script, geometry.pixels_per_clock) {
    for (const auto& candidate : pl::BlobLabelling::models().list()) {
      if (candidate.name == model) ip = candidate.make("blob_labelling", {clk, geometry});
    }
#ifdef MARKERVP_LABELLING_RTL
    if (model.rfind("rtl_", 0) == 0) {
      ip = pl::BlobLabelling::models().make_rtl("blob_labelling", {clk, geometry},
                                                {MARKERVP_LABELLING_RTL + model.substr(4) + ".so"});
    }
#endif
    ip->ena(source.ena);
    ip->rst(source.rst);
    ip->pixel(source.pixel);
    ip->more_pixels(source.more);
    ip->x(source.x);
    ip->y(source.y);
    if (model == "tlm") ip->frames(source.frames);
    monitor = std::make_unique<Monitor>("monitor", clk, *ip);
  }
  void run_to(std::uint64_t cycle) {
    sc_core::sc_start(vp::from_ps(clk.time_of(cycle) + 1) - sc_core::sc_time_stamp());
  }

  harness::Settings settings;
  Script script;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 125'000'000};
  Source source;
  std::unique_ptr<pl::BlobLabelling> ip;
  std::unique_ptr<Monitor> monitor;
};

struct Outcome {
  std::vector<Seen> seen;
  std::vector<std::uint32_t> losses;
  std::vector<std::uint32_t> settled;  ///< label_overflow at some clocks, after settle()
};

Outcome run(const std::string& model, const pl::Geometry& geometry, std::uint32_t labels,
            std::uint32_t side, const Script& script) {
  Bench bench(model, geometry, labels, side, script);
  Outcome outcome;
  for (std::uint64_t cycle = 97; cycle < script.end; cycle += 331) {
    bench.run_to(cycle);
    bench.ip->settle();
    outcome.settled.push_back(bench.ip->label_overflow);
  }
  bench.run_to(script.end);
  outcome.seen = bench.monitor->seen;
  outcome.losses = bench.monitor->losses;
  return outcome;
}

void check(const pl::Geometry& geometry, std::uint32_t labels, std::uint32_t side,
           const Script& script) {
  const Outcome clocked = run("clocked", geometry, labels, side, script);
  const Outcome tlm = run("tlm", geometry, labels, side, script);
  BOOST_TEST(tlm.seen == clocked.seen, boost::test_tools::per_element());
  BOOST_TEST(tlm.losses == clocked.losses, boost::test_tools::per_element());
  BOOST_TEST(tlm.settled == clocked.settled, boost::test_tools::per_element());
}

Script::Change random_change(Random& random, const Binary& picture) {
  Script::Change change;
  change.first = random.below(picture.count());
  for (std::uint32_t i = 1 + random.below(200); i > 0; --i)
    change.pixels.push_back(random.below(2) != 0);
  return change;
}

}  // namespace

/// Pixels a clock.
const std::uint32_t groups[] = {1, 2, 4};

BOOST_AUTO_TEST_SUITE(labelling_ip)

BOOST_AUTO_TEST_CASE(frames_in_a_row_are_equal_in_both_models) {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    const pl::Geometry size{32 * (1 + random.below(3)), 8 + random.below(24), 64,
                            groups[round % 3]};
    Script script;
    std::uint64_t cycle = 3 + random.below(50);
    for (int frame = 0; frame < 4; ++frame) {
      script.frames[cycle] = {random_picture(random, size.width, size.height)};
      cycle += size.clocks() + gap(size) + random.below(2) * random.below(400);
    }
    script.end = cycle + 3000;
    check(size, round % 3 == 0 ? 4 + random.below(30) : 512, 1 + random.below(6), script);
  }
}

BOOST_AUTO_TEST_CASE(resets_at_any_clock_are_equal_in_both_models) {
  Random random(2);
  for (int round = 0; round < 90; ++round) {
    const pl::Geometry size{64, 16, 64, groups[round % 3]};
    Script script;
    std::uint64_t cycle = 3;
    for (int frame = 0; frame < 5; ++frame) {
      script.frames[cycle] = {random_picture(random, size.width, size.height)};
      const std::uint32_t whole = size.clocks() + gap(size) + random.below(300);
      if (random.below(2) == 0) {
        const std::uint64_t at = cycle + random.below(whole);
        const unsigned clocks = 1 + random.below(4);
        script.resets[at] = clocks;
        cycle = at + clocks + random.below(20);
      } else {
        cycle += whole;
      }
    }
    script.end = cycle + 2500;
    check(size, 4 + random.below(80), 1 + random.below(4), script);
  }
}

BOOST_AUTO_TEST_CASE(pixels_that_change_before_they_come_are_equal_in_both_models) {
  Random random(3);
  for (int round = 0; round < 90; ++round) {
    const pl::Geometry size{64, 24, 64, groups[round % 3]};
    Script script;
    std::uint64_t cycle = 3;
    for (int frame = 0; frame < 3; ++frame) {
      const Binary picture = random_picture(random, size.width, size.height);
      script.frames[cycle] = {picture};
      for (std::uint32_t changes = random.below(8); changes > 0; --changes)
        script.changes[cycle + random.below(size.clocks())] = random_change(random, picture);
      cycle += size.clocks() + gap(size) + random.below(200);
    }
    script.end = cycle + 2500;
    check(size, 4 + random.below(200), 1 + random.below(4), script);
  }
}

#ifdef MARKERVP_LABELLING_RTL
// Frames in a row, resets, and labels that run out. Rows are short: what is hard lies at their
// ends.
BOOST_AUTO_TEST_CASE(the_rtl_is_equal_to_the_clocked_model) {
  Random random(4);
  std::size_t shown = 0, lost = 0;
  for (int round = 0; round < 150; ++round) {
    const pl::Geometry size{32, 4, 64, groups[round % 3]};
    Script script;
    script.resets[2] = 2;  // registers have a value from the first reset on
    std::uint64_t cycle = 10;
    for (int frame = 0; frame < 400; ++frame) {
      script.frames[cycle] = {random_picture(random, size.width, size.height)};
      const std::uint32_t whole = size.clocks() + gap(size);
      if (random.below(20) == 0) {
        const std::uint64_t at = cycle + 1 + random.below(whole);
        script.resets[at] = 1 + random.below(3);
        cycle = at + 5 + random.below(20);
      } else {
        cycle += whole + random.below(2) * random.below(100);
      }
    }
    script.end = cycle + 2500;
    const Outcome clocked = run("clocked", size, 9, 2, script);
    const Outcome rtl = run("rtl_" + std::to_string(size.pixels_per_clock), size, 9, 2, script);
    BOOST_TEST(rtl.seen == clocked.seen, boost::test_tools::per_element());
    BOOST_TEST(rtl.losses == clocked.losses, boost::test_tools::per_element());
    BOOST_TEST(rtl.settled == clocked.settled, boost::test_tools::per_element());
    for (const Seen& seen : clocked.seen) shown += seen.blob_out;
    for (const std::uint32_t loss : clocked.losses) lost += loss != 0;
  }
  BOOST_TEST(shown > 1000u);
  BOOST_TEST(lost > 10u);
}

// What it was built for is compared with the configuration.
BOOST_AUTO_TEST_CASE(rtl_of_another_size_is_refused) {
  Script script;
  BOOST_CHECK_THROW(run("rtl_1", {32, 8}, 9, 2, script), vp::InputError);
  BOOST_CHECK_THROW(run("rtl_1", {32, 4}, 10, 2, script), vp::InputError);
}

BOOST_AUTO_TEST_CASE(rtl_of_one_pixel_a_clock_is_refused_where_more_come) {
  BOOST_CHECK_EXCEPTION(
      run("rtl_1", {32, 4, 64, 2}, 9, 2, {}), vp::InputError, [](const vp::InputError& error) {
        return std::string(error.what()).find("PIXELS_PER_CLOCK is 1, and pl.pixels_per_clock 2") !=
               std::string::npos;
      });
}
#endif

/// A square of 20 px whose last run ends in (39, 24) is at the outputs behind edge `out`, and
/// the frame is over behind edge `over`.
void check_square(const pl::Geometry& size, std::uint64_t out, std::uint64_t over) {
  Binary picture{size.width, size.height, std::vector<std::uint8_t>(size.pixels())};
  for (std::uint32_t y = 5; y < 25; ++y) {
    for (std::uint32_t x = 20; x < 40; ++x) picture.pixels[y * size.width + x] = 1;
  }
  Script script;
  script.frames[10] = {picture};
  script.end = 10 + size.clocks() + 500;
  using blob_stream::point;
  const std::vector<Seen> expected{{1, true, false, {}},
                                   {12, false, false, {}},
                                   {out + 1,
                                    false,
                                    true,  // seen on the edge behind it
                                    {point(20, 5), point(39, 5), point(39, 5), point(39, 24),
                                     point(20, 24), point(20, 24), point(20, 5), point(20, 5)}},
                                   {out + 2, false, false, {}},
                                   {over + 1, true, false, {}}};
  for (const char* model : {"clocked", "tlm"})
    BOOST_TEST(run(model, size, 512, 10, script).seen == expected,
               boost::test_tools::per_element());
}

// Pixel (39, 25) leaves the source on edge 10 + 25 x 64 + 39 and is taken one edge later, the blob
// follows the ninth edge after that.
BOOST_AUTO_TEST_CASE(a_square_is_shown_at_this_time) {
  check_square({64, 32}, 10 + 25 * 64 + 39 + 1 + 9, 11 + 32 * 64 + 64 + 2);
}

// With four pixels a clock. Row 25 has no run: its end, pixels (60..63, 25), is taken on edge
// 10 + 26 x 16. In the FIFO three edges later, it lets the run above pass another one later, and
// six stages later the blob is shown. The frame is over when its last row is and the bright row
// behind it, a clock each.
BOOST_AUTO_TEST_CASE(a_square_in_groups_is_shown_at_this_time) {
  check_square({64, 32, 64, 4}, 10 + 26 * 16 + 4 + 6, 10 + 32 * 16 + 4 + 1);
}

BOOST_AUTO_TEST_CASE(a_frame_that_begins_while_runs_wait_is_refused) {
  const pl::Geometry size{64, 16, 64, 4};
  Binary cut = hard_shapes()[4];  // a run in every other column
  cut.height = size.height;
  cut.pixels.resize(cut.count());
  for (const char* model : {"clocked", "tlm"}) {
    Script script;
    script.frames[5] = {cut};
    script.frames[5 + size.clocks() + 3] = {cut};
    script.end = 5000;
    BOOST_CHECK_EXCEPTION(run(model, size, 512, 10, script), sc_core::sc_report,
                          [](const sc_core::sc_report& error) {
                            return std::string(error.get_msg()) ==
                                   "blob_labelling: a frame begins too early: the runs of the one "
                                   "before still wait for their turn";
                          });
  }
}

BOOST_AUTO_TEST_CASE(a_frame_that_begins_too_early_is_refused) {
  const pl::Geometry size{64, 16};
  const Binary picture = hard_shapes()[2];
  Binary cut{
      size.width, size.height, {picture.pixels.begin(), picture.pixels.begin() + size.pixels()}};
  for (const char* model : {"clocked", "tlm"}) {
    for (const std::uint32_t pause : {64u, 65u}) {
      Script script;
      script.frames[5] = {cut};
      script.frames[5 + size.pixels() + pause] = {cut};
      script.end = 5000;
      std::string refusal;
      try {
        run(model, size, 512, 10, script);
      } catch (const sc_core::sc_report& error) {
        refusal = error.get_msg();
      }
      BOOST_TEST(
          refusal == (pause == 65 ? ""
                                  : "blob_labelling: a frame begins too early: 65 clocks must "
                                    "lie behind the last pixel of the one before"),
          model);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_frame_that_is_not_whole_is_refused) {
  const pl::Geometry size{64, 16};
  Binary half = hard_shapes()[2];
  half.height = 8;
  half.pixels.resize(half.count());
  Script script;
  script.frames[5] = {half};
  script.frames[2000] = {half};
  script.end = 5000;
  BOOST_CHECK_EXCEPTION(run("clocked", size, 512, 10, script), sc_core::sc_report,
                        [](const sc_core::sc_report& error) {
                          return std::string(error.get_msg()) ==
                                 "blob_labelling: pixel (0, 0) came, but (0, 8) is the next one: "
                                 "frames are whole, unless rst cuts them";
                        });
}

BOOST_AUTO_TEST_SUITE_END()

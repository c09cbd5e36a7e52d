#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <string>

#include <scene/portable_math.h>
#include <scene/renderer.h>
#include <scene/scene.h>
#include <validation/evidence.h>
#include <validation/measured.h>

namespace platform::validation {

namespace {

bool near(double value, double reference, double band) {
  return std::abs(value / reference - 1) * 100 <= band;
}

/// Times of one system in the increased-feature test, ms.
struct Series {
  explicit Series(const std::vector<const Frame*>& frames) {
    for (const Frame* frame : frames) rest.push_back(frame_ms(*frame) - identification_ms(*frame));
    marker = identification_ms(*frames.front());
    all_squares = identification_ms(*frames.back()) - marker;
  }
  std::vector<double> rest;  ///< frame without identification
  double marker;
  double all_squares;  ///< of those before the marker, in the last image
};

}  // namespace

std::optional<OrderStudy> study_orders(const Measured& measured, double published_ms,
                                       double published_speedup, double band) {
  const auto hybrid_frames = measured.hybrid.of(feature_test);
  if (hybrid_frames.size() < 2) return std::nullopt;
  const Series hybrid(hybrid_frames), ps_only(measured.ps_only.of(feature_test));
  const std::size_t images = hybrid.rest.size(), added = images - 1;
  // A candidate that is no marker costs about what the marker does.
  const auto before = static_cast<std::size_t>(std::lround(hybrid.all_squares / hybrid.marker));
  if (before == 0) return std::nullopt;
  OrderStudy study;
  study.least_ms = study.least_speedup = 1e9;
  // Bit i: the square that image i + 2 adds stands before the marker.
  for (std::uint32_t order = 0; order < 1u << added; ++order) {
    if (std::bitset<32>(order).count() != before) continue;
    double ms = 0, speedup = 0;
    std::size_t found_before = 0;
    for (std::size_t i = 0; i < images; ++i) {
      if (i > 0) found_before += order >> (i - 1) & 1;
      const double part = double{1} * found_before / before;
      const double fast = hybrid.marker + part * hybrid.all_squares;
      const double slow = ps_only.marker + part * ps_only.all_squares;
      ms += fast / images;
      speedup += (ps_only.rest[i] + slow) / (hybrid.rest[i] + fast) / images;
    }
    const bool one = near(ms, published_ms, band), other = near(speedup, published_speedup, band);
    ++study.orders;
    study.identification += one;
    study.speedup += other;
    study.both += one && other;
    study.least_ms = std::min(study.least_ms, ms);
    study.most_ms = std::max(study.most_ms, ms);
    study.least_speedup = std::min(study.least_speedup, speedup);
    study.most_speedup = std::max(study.most_speedup, speedup);
  }
  return study;
}

std::optional<TurnStudy> study_turns(const Measured& measured, double published_speedup) {
  const auto hybrid = measured.hybrid.of(rotation_tests), ps = measured.ps_only.of(rotation_tests);
  const auto corner_growth = growth(measured.ps_only, ps_corner_ms);
  const auto corner = mean(measured.ps_only, feature_test, ps_corner_ms);
  if (hybrid.empty() || !corner_growth) return std::nullopt;
  TurnStudy study;
  const double count = static_cast<double>(hybrid.size());
  double upright = ps_corner_ms(*ps.front());
  for (std::size_t i = 0; i < hybrid.size(); ++i) {
    const double asked = published_speedup * frame_ms(*hybrid[i]);
    study.asked_ms += asked / count;
    study.lacking_ms += (asked - frame_ms(*ps[i])) / count;
    study.excess_ms += (ps_corner_ms(*ps[i]) - upright) / count;
  }
  study.factor = 1 + study.lacking_ms / study.excess_ms;
  study.growth = 1 + (corner_growth->value - 1) * study.factor;
  study.deviation_ms = corner->spread.value_or(0) * study.factor;
  return study;
}

namespace {

constexpr std::array<const char*, 7> ps_stages{
    "corner_detection", "threshold", "blob_detection", "receive", "evaluation",
    "identification",   "pose"};
constexpr std::array<const char*, 3> on_the_pl_or_ps{"corner_detection", "threshold",
                                                     "blob_detection"};

/// FNV-1a.
std::uint64_t seed_of(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const unsigned char character : text) hash = (hash ^ character) * 0x100000001B3u;
  return hash;
}

void repeat(Frame& frame, const std::string& system, std::uint32_t repetitions) {
  GaussianNoise noise(seed_of(system + " " + frame.input));
  double ps = 0, pl = 0;
  for (std::uint32_t i = 0; i < repetitions; ++i) {
    ps += noise.next() * ps_jitter_us / repetitions;
    pl += noise.next() * pl_jitter_us / repetitions;
  }
  auto& times = frame.times_us;
  double ps_time = 0, extraction = 0;
  for (const char* stage : ps_stages) {
    if (times.count(stage) != 0) ps_time += times[stage];
  }
  for (const char* stage : ps_stages) {
    if (times.count(stage) == 0 || ps_time == 0) continue;
    const double change = ps * times[stage] / ps_time;
    times[stage] += change;
    const auto feature = std::find_if(on_the_pl_or_ps.begin(), on_the_pl_or_ps.end(),
                                      [&](const char* name) { return std::string(name) == stage; });
    if (feature != on_the_pl_or_ps.end()) extraction += change;
  }
  const bool all_on_ps = times.count("capture") != 0;
  times["feature_extraction"] += all_on_ps ? extraction : pl;
  times["frame"] += all_on_ps ? ps : ps + pl;
}

}  // namespace

Run repeated(const Run& run, std::uint32_t repetitions) {
  Run result = run;
  if (repetitions < 2) return result;
  for (Frame& frame : result.frames) repeat(frame, run.system, repetitions);
  return result;
}

std::uint64_t count_dark(const GreyImage& image, std::uint32_t threshold) {
  const auto dark = std::count_if(image.pixels.begin(), image.pixels.end(),
                                  [&](std::uint8_t pixel) { return pixel <= threshold; });
  return static_cast<std::uint64_t>(dark);
}

std::uint64_t count_evaluated(const GreyImage& image, int threshold) {
  constexpr int radius = 3;
  std::uint64_t count = 0;
  for (int y = radius; y < image.height - radius; ++y) {
    for (int x = radius; x < image.width - radius; ++x) {
      const int limit = image.at(x, y) + threshold;
      const bool vertical = image.at(x, y - radius) > limit || image.at(x, y + radius) > limit;
      if (vertical && (image.at(x - radius, y) > limit || image.at(x + radius, y) > limit)) ++count;
    }
  }
  return count;
}

std::vector<ImageWork> image_work(const std::vector<const Frame*>& frames, int corner_threshold) {
  std::vector<ImageWork> work;
  for (const Frame* frame : frames) {
    const GreyImage image = render(make_scene(frame->input));
    work.push_back({count_dark(image, frame->threshold), count_evaluated(image, corner_threshold)});
  }
  return work;
}

}  // namespace platform::validation

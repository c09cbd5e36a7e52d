#include <algorithm>

#include <host/document.h>
#include <marker/scene/portable_math.h>
#include <marker/scene/scene.h>
#include <marker/validation/measured.h>
#include <vp/error.h>

#include <array>
#include <bitset>
#include <cctype>
#include <cmath>
#include <string>

namespace platform::validation {

namespace {

/// The test that a scene belongs to; empty for other images.
std::string group_of(const std::string& scene) {
  for (const SceneGroup& group : scene_groups()) {
    const auto& names = group.scenes;
    if (std::find(names.begin(), names.end(), scene) != names.end()) return group.name;
  }
  return "";
}

double distance(const nlohmann::json& a, const nlohmann::json& b) {
  return std::hypot(a.at(0).get<double>() - b.at(0).get<double>(),
                    a.at(1).get<double>() - b.at(1).get<double>());
}

FoundTrue found_true(const nlohmann::json& marker) {
  FoundTrue found;
  const nlohmann::json& corners = marker.at("truth").at("corners_px");
  found.width_px =
      (distance(corners.at(0), corners.at(1)) + distance(corners.at(3), corners.at(2))) / 2;
  const nlohmann::json& error = marker.at("error");
  found.corner_px = error.at("corner_px");
  if (error.contains("translation_mm")) {
    found.translation_mm = error.at("translation_mm").get<double>();
    found.rotation_deg = error.at("rotation_deg").get<double>();
    found.iterations = marker.at("iterations");
  }
  return found;
}

Frame read_frame(const nlohmann::json& json) {
  Frame frame;
  frame.input = json.at("input");
  frame.group = group_of(frame.input);
  frame.threshold = json.at("threshold");
  const nlohmann::json& counts = json.at("counts");
  frame.corners = counts.at("corners");
  frame.blobs = counts.at("blobs");
  frame.candidates = counts.at("candidates");
  for (const nlohmann::json& marker : json.at("markers")) {
    if (marker.contains("truth")) frame.found = found_true(marker);
  }
  frame.markers = json.at("markers").dump();
  for (const auto& [name, us] : json.at("time_us").items()) frame.times_us[name] = us;
  return frame;
}

}  // namespace

Measurement mean_of(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  if (values.size() < 2) return {mean};
  return {mean, std::sqrt(squares / (count - 1))};
}

double Frame::ms(const std::string& stage) const {
  const auto time = times_us.find(stage);
  if (time == times_us.end()) {
    throw vp::InputError("frame '" + input + "' has no time of stage '" + stage + "'");
  }
  return time->second / 1000;
}

std::vector<const Frame*> Run::of(const std::vector<std::string>& groups) const {
  std::vector<const Frame*> selected;
  for (const Frame& frame : frames) {
    if (std::find(groups.begin(), groups.end(), frame.group) != groups.end()) {
      selected.push_back(&frame);
    }
  }
  return selected;
}

Run read_run(const std::filesystem::path& file) {
  try {
    Run run;
    run.root = host::read_json(file, "result", host::largest_result);
    run.system = run.root.at("system");
    run.profile = run.root.at("profile");
    run.fidelity = run.root.at("fidelity");
    run.design = run.root.at("design");
    run.configuration = run.root.at("configuration");
    for (const nlohmann::json& frame : run.root.at("frames"))
      run.frames.push_back(read_frame(frame));
    run.root.erase("frames");
    return run;
  } catch (const nlohmann::json::exception&) {
    throw vp::InputError("result '" + file.string() +
                         "' was changed or is damaged: run the validation again");
  }
}

void check_same_inputs(const Measured& measured) {
  const auto &one = measured.hybrid.frames, &other = measured.ps_only.frames;
  const bool same = std::equal(one.begin(), one.end(), other.begin(), other.end(),
                               [](const Frame& a, const Frame& b) { return a.input == b.input; });
  if (!same || one.empty()) {
    throw vp::InputError("the two systems did not run on the same images");
  }
}

namespace {

constexpr double mm_per_m = 1000;
constexpr double percent = 100;
constexpr double ms_per_s = 1000;

std::optional<Measurement> of_values(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return mean_of(values);
}

template <typename Combine>
std::optional<Measurement> mean_of_pairs(const Measured& measured, const Groups& groups,
                                         Combine combine) {
  const auto hybrid = measured.hybrid.of(groups), ps_only = measured.ps_only.of(groups);
  std::vector<double> values;
  for (std::size_t i = 0; i < hybrid.size(); ++i)
    values.push_back(combine(*ps_only[i], *hybrid[i]));
  return of_values(values);
}

template <typename Read>
std::optional<Measurement> mean_of_found(const Run& run, const Groups& groups, Read read) {
  std::vector<double> values;
  for (const Frame* frame : run.of(groups)) {
    if (frame->found && frame->found->translation_mm) values.push_back(read(*frame->found));
  }
  return of_values(values);
}

}  // namespace

double frame_ms(const Frame& frame) {
  return frame.ms("frame");
}
double hybrid_corner_ms(const Frame& frame) {
  return frame.ms("feature_extraction") + frame.ms("receive");
}
double hybrid_blob_ms(const Frame& frame) {
  return frame.ms("feature_extraction");
}
double hybrid_threshold_ms(const Frame& frame) {
  return frame.ms("feature_extraction");
}
double ps_capture_ms(const Frame& frame) {
  return frame.ms("capture");
}
double ps_corner_ms(const Frame& frame) {
  return frame.ms("corner_detection");
}
double ps_blob_ms(const Frame& frame) {
  return frame.ms("blob_detection");
}
double ps_threshold_ms(const Frame& frame) {
  return frame.ms("threshold");
}
double evaluation_ms(const Frame& frame) {
  return frame.ms("evaluation");
}
double identification_ms(const Frame& frame) {
  return frame.ms("identification");
}
double pose_ms(const Frame& frame) {
  return frame.ms("pose");
}
double identification_share(const Frame& frame) {
  return percent * frame.ms("identification") / frame.ms("frame");
}
double frames_per_second(const Frame& frame) {
  return ms_per_s / frame.ms("frame");
}

std::optional<Measurement> mean(const Run& run, const Groups& groups, Value value) {
  std::vector<double> values;
  for (const Frame* frame : run.of(groups)) values.push_back(value(*frame));
  return of_values(values);
}

std::optional<Measurement> mean_difference(const Measured& measured, const Groups& groups,
                                           Value ps_only, Value hybrid) {
  return mean_of_pairs(measured, groups, [&](const Frame& slow, const Frame& fast) {
    return ps_only(slow) - hybrid(fast);
  });
}

std::optional<Measurement> mean_ratio(const Measured& measured, const Groups& groups, Value ps_only,
                                      Value hybrid) {
  return mean_of_pairs(measured, groups, [&](const Frame& slow, const Frame& fast) {
    return ps_only(slow) / hybrid(fast);
  });
}

std::optional<Measurement> at_first(const Run& run, Value value) {
  const auto frames = run.of(feature_test);
  if (frames.empty()) return std::nullopt;
  return Measurement{value(*frames.front())};
}

std::optional<Measurement> at_last(const Run& run, Value value) {
  const auto frames = run.of(feature_test);
  if (frames.empty()) return std::nullopt;
  return Measurement{value(*frames.back())};
}

std::optional<Measurement> growth(const Run& run, Value value) {
  const auto first = at_first(run, value), last = at_last(run, value);
  if (!first || !last) return std::nullopt;
  return Measurement{last->value / first->value};
}

double pixel_mm(const FoundTrue& found) {
  return marker_side_m * mm_per_m / found.width_px;
}

std::optional<Measurement> mean_corner_mm(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups,
                       [](const FoundTrue& found) { return found.corner_px * pixel_mm(found); });
}

std::optional<Measurement> mean_translation_mm(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups, [](const FoundTrue& found) { return *found.translation_mm; });
}

std::optional<Measurement> mean_rotation_deg(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups, [](const FoundTrue& found) { return *found.rotation_deg; });
}

std::optional<Measurement> mean_iterations(const Run& run, const Groups& groups) {
  return mean_of_found(run, groups,
                       [](const FoundTrue& found) { return double{1} * found.iterations; });
}

std::optional<Measurement> marker_width_px(const Run& run, const std::string& input) {
  for (const Frame& frame : run.frames) {
    if (frame.input == input && frame.found) return Measurement{frame.found->width_px};
  }
  return std::nullopt;
}

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
  // Bit i: the square that image i + 2 adds precedes the marker.
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

}  // namespace platform::validation

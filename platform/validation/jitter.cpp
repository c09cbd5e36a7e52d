#include <validation/jitter.h>

#include <algorithm>
#include <array>
#include <string>

#include <scene/noise.h>

namespace platform::validation {

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

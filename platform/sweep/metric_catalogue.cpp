#include <algorithm>
#include <string_view>

#include <sweep/metric_catalogue.h>
#include <sweep/tables.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

constexpr std::string_view frames = "frames.";
constexpr const char* frame_ends[] = {".mean", ".max"};

/// Whether `name` is of the pattern, whose `*` stands for at least one character.
bool fits(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == name;
  if (name.size() <= star || name.substr(0, star) != pattern.substr(0, star)) return false;
  const std::string_view rest = pattern.substr(star + 1);
  for (std::size_t end = star + 1; end <= name.size(); ++end) {
    if (fits(rest, name.substr(end))) return true;
  }
  return false;
}

/// Of a metric of frames: without its end. Empty if it has none.
std::string_view without_end(std::string_view name) {
  for (const std::string_view end : frame_ends) {
    if (name.size() > end.size() && name.substr(name.size() - end.size()) == end)
      return name.substr(0, name.size() - end.size());
  }
  return {};
}

std::vector<std::string> names_without_star() {
  std::vector<std::string> names;
  for (const MetricKind& kind : metric_kinds()) {
    const std::string pattern = kind.pattern;
    if (pattern.find('*') != std::string::npos) continue;
    if (pattern.rfind(frames, 0) != 0) {
      names.push_back(pattern);
      continue;
    }
    for (const char* end : frame_ends) names.push_back(pattern + end);
  }
  return names;
}

}  // namespace

const std::vector<MetricKind>& metric_kinds() {
  static const std::vector<MetricKind> kinds{
      {"summary.frames", "", "frames that the software worked on"},
      {"summary.delivered", "", "of them with a result"},
      {"summary.detected", "", "of them with a marker"},
      {"summary.fps.mean", "1/s", "frame rate: results over the time that they took"},
      {"summary.fps.min", "1/s", "frame rate of the slowest result"},
      {"summary.fps.max", "1/s", "frame rate of the fastest result"},
      {"summary.latency_us.mean", "µs", "from the start of a frame to its result"},
      {"summary.latency_us.max", "µs", "the same of the slowest"},
      {"summary.power_w.total", "W", "mean power of the chip"},
      {"summary.power_w.ps", "W", "of it the processing system"},
      {"summary.power_w.pl", "W", "of it the programmable logic"},
      {"summary.power_w.static", "W", "of it the device at rest"},
      {"summary.energy_per_frame_mj", "mJ", "energy of the chip for one frame"},
      {"summary.unpublished", "", "frames of which the software said nothing, if there are any"},
      {"camera.rate_fps", "1/s", "rate of the camera"},
      {"camera.offered", "", "frames that came from it"},
      {"camera.dropped", "", "of them those that found the software busy"},
      {"camera.delivered_fps", "1/s", "results over the time of the camera's frames"},
      {"camera.utilisation_percent", "%",
       "share of the camera's period in which the software is busy"},
      {"camera.slack_us.mean", "µs", "what a frame leaves of the camera's period"},
      {"camera.slack_us.min", "µs", "the same of the longest frame"},
      {"frames.counts.*", "", "what the design counts of a frame; some of it is lost work"},
      {"frames.markers", "", "markers found"},
      {"frames.threshold", "", "grey level at which the image was made binary"},
      {"frames.time_us.frame", "µs", "from the start of a frame to its result"},
      {"frames.time_us.*", "µs", "time of a stage"},
      {"frames.energy_mj.total", "mJ", "energy of the chip for the frame"},
      {"frames.energy_mj.*", "mJ", "of it one group of modules"},
      {"frames.error.corner_px", "px", "distance of the marker's corners from the truth"},
      {"frames.error.translation_mm", "mm", "distance of the marker's place from the truth"},
      {"frames.error.rotation_deg", "°", "angle of the marker's rotation from the truth"},
      {"frames.reprojection_px", "px", "distance of the corners from those of the pose"},
      {"frames.iterations", "", "iterations of the pose"},
      {"power.total_w.nominal", "W", "mean power of the chip"},
      {"power.total_w.low", "W", "lower end of its error band"},
      {"power.total_w.high", "W", "upper end of its error band"},
      {"power.ambient_c", "°C", "temperature around the board"},
      {"power.junction_c", "°C", "temperature of the die"},
      {"power.rails.*", "W", "power of a supply rail"},
      {"power.modules.*.w", "W", "power of a module"},
      {"power.modules.*.mj", "mJ", "energy of a module for one frame"},
      {"resources.fits", "", "1 if the device has room for the design"},
      {"resources.total.*", "", "LUT, FF, BRAM36 or DSP that the design takes"},
      {"resources.available.*", "", "those that the device has"},
      {"resources.modules.*.uncertainty_percent", "%", "how far its figures may be off"},
      {"resources.modules.*", "", "those that a module takes"},
      {"timing.met", "", "1 if every module is fast enough for its clock"},
      {"timing.failed", "", "modules above the limit of their clock"},
      {"timing.unknown", "", "modules above a clock that is known to work, with no known limit"},
      {"timing.modules.*.frequency_mhz", "MHz", "highest clock that a module had"},
      {"timing.modules.*.reachable_mhz", "MHz", "clock below that limit that the PLLs make"},
      {"timing.modules.*.fmax_mhz", "MHz", "clock up to which it works"},
      {"timing.modules.*.margin_percent", "%", "by how much its clock could rise"},
      {"timing.modules.*.fmax_high_mhz", "MHz", "clock above which it does not work"},
      {"timing.modules.*.met", "", "1 if the module is fast enough"},
      {"clocks.legal", "", "1 if the device allows and can make every clock"},
      {"clocks.list.*.made.*", "", "how PLL and dividers make a clock"},
      {"clocks.list.*_mhz", "MHz", "a clock: wish, what was made, its limit, its neighbours"},
      {"clocks.list.*.margin_percent", "%", "by how much a clock could rise"},
      {"clocks.list.*", "", "1 if a clock is within its limit, or can be made"},
      {"verdict.feasible", "",
       "1 if every part of the verdict holds, 0.5 if one is unknown, else 0"},
      {"verdict.*.holds", "", "the same of one part: ran, job, fits, clocks or timing"},
      {"verdict.*.margin_percent", "%", "how far the part is from its limit; negative: beyond"},
      {"program_end.exit_code", "", "what the PS program returned"},
      {"program_end.time_us", "µs", "when it ended"},
  };
  return kinds;
}

const MetricKind* kind_of_metric(const std::string& name) {
  const bool of_frames = name.rfind(frames, 0) == 0;
  const std::string_view wanted = of_frames ? without_end(name) : std::string_view(name);
  const auto& kinds = metric_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const MetricKind& kind) {
    return !wanted.empty() && fits(kind.pattern, wanted);
  });
  return found == kinds.end() ? nullptr : &*found;
}

std::string unit_of_metric(const std::string& text) {
  const MetricKind* const kind = kind_of_metric(text);
  return kind == nullptr || text.find_first_of(" +-*/()") != std::string::npos ? "" : kind->unit;
}

void check_metric(const std::string& name, const std::vector<std::string>& others) {
  if (kind_of_metric(name) || std::find(others.begin(), others.end(), name) != others.end()) return;
  std::vector<std::string> known = names_without_star();
  known.insert(known.end(), others.begin(), others.end());
  const std::string nearest = vp::nearest_match(name, known);
  throw vp::InputError(
      "unknown metric '" + name + "'" +
      (nearest.empty() ? ": 'markervp metrics' lists them" : "; did you mean '" + nearest + "'?"));
}

std::string metric_table(const std::string& part) {
  TextTable table({"metric", "unit", "meaning"});
  bool any = false;
  for (const MetricKind& kind : metric_kinds()) {
    const bool of_frames = std::string(kind.pattern).rfind(frames, 0) == 0;
    const std::string name = kind.pattern + std::string(of_frames ? ".mean|max" : "");
    if (name.find(part) == std::string::npos && kind_of_metric(part) != &kind) continue;
    table.add({name, kind.unit, kind.meaning});
    any = true;
  }
  if (!any) check_metric(part, {});
  return table.text();
}

}  // namespace platform::sweep

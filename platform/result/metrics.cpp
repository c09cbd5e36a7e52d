#include <algorithm>

#include <result/metrics.h>
#include <result/table.h>
#include <vp/error.h>
#include <vp/text.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace platform::result {

namespace {

/// Mean and largest of the values added.
struct Gathered {
  double sum = 0;
  double max = 0;
  double count = 0;

  void add(double value) {
    max = count == 0 ? value : std::max(max, value);
    sum += value;
    ++count;
  }
};

using Gathering = std::map<std::string, Gathered>;
using Figures = std::vector<std::pair<std::string, double>>;

/// Appends a name to a path for as long as it lives.
class Step {
 public:
  Step(std::string& path, std::string_view name) : path_(path), length_(path.size()) {
    if (!path.empty()) path += '.';
    path += name;
  }
  ~Step() { path_.resize(length_); }
  Step(const Step&) = delete;
  Step& operator=(const Step&) = delete;

 private:
  std::string& path_;
  std::size_t length_;
};

/// What an item of a list calls itself; null if it does not.
const std::string* name_of(const Json& item) {
  if (!item.is_object()) return nullptr;
  const auto name = item.find("name");
  return name == item.end() ? nullptr : name->get_ptr<const std::string*>();
}

/// Calls found(path, value) for each number below `json`. One that is not finite has no place in a
/// file either.
template <class Found>
void walk(const Json& json, std::string& path, const Found& found) {
  if (json.is_number()) {
    const double value = json.get<double>();
    if (std::isfinite(value)) found(path, value);
  } else if (json.is_boolean()) {
    found(path, json.get<bool>() ? 1.0 : 0.0);
  } else if (json.is_object()) {
    for (const auto& [name, value] : json.get_ref<const Json::object_t&>()) {
      const Step step(path, name);
      walk(value, path, found);
    }
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      const std::string* name = name_of(json[i]);
      const Step step(path, name ? std::string_view(*name) : std::string_view(std::to_string(i)));
      walk(json[i], path, found);
    }
  }
}

void gather(const Json& json, std::string path, Gathering& into) {
  walk(json, path, [&](const std::string& name, double value) { into[name].add(value); });
}

std::vector<UnitMetrics>& unit_metrics() {
  static std::vector<UnitMetrics> registered;
  return registered;
}

/// Whether an application has read the member.
bool is_taken(const std::string& name, const Json& value, const UnitMetrics::Found& found) {
  const auto& readers = unit_metrics();
  return std::any_of(readers.begin(), readers.end(),
                     [&](const UnitMetrics& reader) { return reader.take(name, value, found); });
}

template <class Found>
void find_in_frames(const Json& frames, const Found& found) {
  Gathering all, rates;
  const UnitMetrics::Found add = [&](const std::string& name, double value) {
    all["frames." + name].add(value);
  };
  const UnitMetrics::Found add_rate = [&](const std::string& name, double value) {
    rates["summary." + name].add(value);
  };
  for (const Json& frame : frames) {
    for (const UnitMetrics& reader : unit_metrics()) reader.rates(frame, add_rate);
    for (const auto& [name, value] : frame.items()) {
      if (name == "index" || is_taken(name, value, add)) continue;
      if (name == "time_us" && frame.contains("gave_up")) continue;  // stages that were not reached
      gather(value, "frames." + name, all);
    }
  }
  for (const auto& [name, gathered] : all) {
    found(name + ".mean", gathered.sum / gathered.count);
    found(name + ".max", gathered.max);
  }
  for (const auto& [name, gathered] : rates) found(name, gathered.sum / gathered.count);
}

/// A limit that is only known to be no lower says nothing about a clock above it.
template <class Found>
void find_in_timing(const Json& modules, const Found& found) {
  double failed = 0;
  double unknown = 0;
  for (const Json& module : modules) {
    if (module.value("met", true)) continue;
    const bool has_limit = module.contains("fmax_high_mhz");
    const bool missed =
        has_limit && module.value("frequency_mhz", 0.0) > module.value("fmax_high_mhz", 0.0);
    (missed ? failed : unknown) += 1;
  }
  found("timing.failed", failed);
  found("timing.unknown", unknown);
}

/// What is no, unknown and yes becomes 0, 0.5 and 1.
template <class Found>
void find_in_verdict(const Json& verdict, const Found& found) {
  const auto add = [&](const std::string& path, const Json& holds) {
    const auto* text = holds.get_ptr<const std::string*>();
    if (text) found(path, *text == "yes" ? 1.0 : *text == "unknown" ? 0.5 : 0.0);
  };
  for (const auto& [name, part] : verdict.items()) {
    if (name == "feasible")
      add("verdict.feasible", part);
    else if (part.is_object() && part.contains("holds"))
      add("verdict." + name + ".holds", part["holds"]);
  }
}

/// Calls found(path, value) for each figure, in the order of the result.
template <class Found>
void find_figures(const Json& result, const Found& found) {
  for (const auto& [name, value] : result.items()) {
    if (name == "provenance" || name == "configuration" || name == "schema") continue;
    if (name == "frames") {
      find_in_frames(value, found);
    } else {
      std::string path = name;
      walk(value, path, found);
    }
    if (name == "timing" && value.contains("modules")) find_in_timing(value["modules"], found);
    if (name == "verdict") find_in_verdict(value, found);
  }
}

}  // namespace

Metrics::Metrics(Figures figures) {
  const auto by_name = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(figures.begin(), figures.end(), by_name);
  Names names;
  names.reserve(figures.size());
  values_.reserve(figures.size());
  for (auto& [name, value] : figures) {
    if (!names.empty() && names.back() == name) {
      values_.back() += value;
      continue;
    }
    names.push_back(std::move(name));
    values_.push_back(value);
  }
  names_ = std::make_shared<const Names>(std::move(names));
}

Metrics::Metrics(std::shared_ptr<const Names> names, std::vector<double> values)
    : names_(std::move(names)), values_(std::move(values)) {}

const double* Metrics::find(const std::string& name) const {
  const std::size_t place = place_of(name);
  return place == values_.size() ? nullptr : &values_[place];
}

std::size_t Metrics::place_of(const std::string& name) const {
  const auto found = std::lower_bound(names_->begin(), names_->end(), name);
  if (found == names_->end() || *found != name) return values_.size();
  return static_cast<std::size_t>(found - names_->begin());
}

void Metrics::share_names(const Metrics& other) {
  if (names_ != other.names_ && *names_ == *other.names_) names_ = other.names_;
}

const std::shared_ptr<const Metrics::Names>& Metrics::none() {
  static const auto names = std::make_shared<const Names>();
  return names;
}

Metrics metrics_of(const Json& result) {
  Figures figures;
  find_figures(result,
               [&](const std::string& path, double value) { figures.emplace_back(path, value); });
  return Metrics(std::move(figures));
}

const Selection::Picked& Selection::picked_from(const Metrics& all) {
  const auto [known, is_new] = picked_.try_emplace(all.shared_names().get());
  Picked& picked = known->second;
  if (!is_new) return picked;
  Metrics::Names names;
  for (const std::string& name : wanted_) {
    picked.places.push_back(all.place_of(name));
    if (picked.places.back() != all.values().size()) names.push_back(name);
  }
  picked.all = all.shared_names();
  picked.names = std::make_shared<const Metrics::Names>(std::move(names));
  return picked;
}

Metrics Selection::Picked::of(const Metrics& figures) const {
  std::vector<double> values;
  values.reserve(names->size());
  for (const std::size_t place : places) {
    if (place < figures.values().size()) values.push_back(figures.values()[place]);
  }
  return {names, std::move(values)};
}

Metrics::Names Selection::seen() const {
  std::set<std::string> names;
  for (const auto& [unused, picked] : picked_) names.insert(picked.all->begin(), picked.all->end());
  return {names.begin(), names.end()};
}

// A value is the same if its bits are: the texts of 0 and -0 differ.
void CommonFigures::add(const Metrics& metrics) {
  if (metrics.empty()) return;
  if (first_.empty()) {
    first_ = metrics;
    selection_ = Selection(first_.names());
    differs_.assign(first_.values().size(), 0);
  }
  const std::vector<std::size_t>& places = selection_.places_in(metrics);
  for (std::size_t i = 0; i < differs_.size(); ++i) {
    const bool has_it = places[i] < metrics.values().size();
    differs_[i] |= !has_it || std::memcmp(&first_.values()[i], &metrics.values()[places[i]],
                                          sizeof(double)) != 0;
  }
}

std::optional<double> CommonFigures::value(const std::string& name) const {
  const std::size_t place = first_.place_of(name);
  if (place == differs_.size() || differs_[place] != 0) return std::nullopt;
  return first_.values()[place];
}

Metrics MetricsReader::read(const Json& result) {
  std::vector<double> values(before_.values().size());  // fewer than paths if some share a name
  std::size_t count = 0;
  bool same = true;
  find_figures(result, [&](const std::string& path, double value) {
    same = same && count < paths_.size() && paths_[count] == path;
    if (same) values[order_[count++]] += value;
  });
  if (same && count == paths_.size() && count != 0)
    return Metrics(before_.shared_names(), std::move(values));
  paths_.clear();
  order_.clear();
  before_ = metrics_of(result);
  find_figures(result, [&](const std::string& path, double) { paths_.push_back(path); });
  for (const std::string& path : paths_) order_.push_back(before_.place_of(path));
  return before_;
}

namespace {

constexpr std::string_view frames = "frames.";
constexpr const char* frame_ends[] = {".mean", ".max"};

/// Whether `name` is of the pattern, whose `*` represents at least one character.
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

namespace {

std::vector<MetricKind>& known_kinds() {
  static std::vector<MetricKind> kinds{
      {"summary.frames", "", "frames that the software worked on"},
      {"summary.delivered", "", "of them with a result"},
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
      {"limit.percent.*", "%",
       "share of the run in which a stage, or the camera, sets the frame rate"},
      {"limit.stages_us", "µs", "time of the stages that set the frame rate"},
      {"limit.period_us", "µs", "time from result to result that they set"},
      {"camera.rate_fps", "1/s", "rate of the camera"},
      {"camera.offered", "", "frames that came from it"},
      {"camera.dropped", "", "of them those that found the software busy"},
      {"camera.delivered_fps", "1/s", "results over the time of the camera's frames"},
      {"camera.utilisation_percent", "%",
       "share of the camera's period in which the software is busy"},
      {"camera.slack_us.mean", "µs", "what a frame leaves of the camera's period"},
      {"camera.slack_us.min", "µs", "the same of the longest frame"},
      {"frames.counts.*", "", "what the design counts of a frame; some of it is lost work"},
      {"frames.figures.*", "", "what the design finds of a frame, in the unit that it says"},
      {"frames.time_us.frame", "µs", "from the start of a frame to its result"},
      {"frames.time_us.*", "µs", "time of a stage"},
      {"frames.energy_mj.total", "mJ", "energy of the chip for the frame"},
      {"frames.energy_mj.*", "mJ", "of it one group of modules"},
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

std::vector<std::string>& known_shown() {
  static std::vector<std::string> shown;
  return shown;
}

}  // namespace

const std::vector<MetricKind>& metric_kinds() {
  return known_kinds();
}

UnitMetrics::UnitMetrics(bool (*take_member)(const std::string&, const Json&, const Found&),
                         void (*find_rates)(const Json&, const Found&),
                         std::initializer_list<MetricKind> kinds,
                         std::initializer_list<const char*> shown)
    : take(take_member), rates(find_rates) {
  unit_metrics().push_back(*this);
  known_kinds().insert(known_kinds().end(), kinds);
  known_shown().insert(known_shown().end(), shown.begin(), shown.end());
}

const std::vector<std::string>& shown_metrics() {
  return known_shown();
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

}  // namespace platform::result

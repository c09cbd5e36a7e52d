#include <result/metrics.h>

#include <algorithm>

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

std::vector<facts::Figure>& declared_by_application() {
  static std::vector<facts::Figure> declared;
  return declared;
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

using Found = UnitMetrics::Found;

/// A limit that is only known to be no lower says nothing about a clock above it.
void find_in_timing(const Json& timing, const Found& found) {
  if (!timing.contains("modules")) return;
  double failed = 0;
  double unknown = 0;
  for (const Json& module : timing["modules"]) {
    if (module.value("met", true)) continue;
    const bool has_limit = module.contains("fmax_high_mhz");
    const bool missed =
        has_limit && module.value("frequency_mhz", 0.0) > module.value("fmax_high_mhz", 0.0);
    (missed ? failed : unknown) += 1;
  }
  found("failed", failed);
  found("unknown", unknown);
}

/// What is no, unknown and yes becomes 0, 0.5 and 1.
void find_in_verdict(const Json& verdict, const Found& found) {
  const auto add = [&](const std::string& path, const Json& holds) {
    const auto* text = holds.get_ptr<const std::string*>();
    if (text) found(path, *text == "yes" ? 1.0 : *text == "unknown" ? 0.5 : 0.0);
  };
  for (const auto& [name, part] : verdict.items()) {
    if (name == "feasible")
      add(name, part);
    else if (part.is_object() && part.contains("holds"))
      add(name + ".holds", part["holds"]);
  }
}

/// What a part of result.json says beside its numbers.
struct Derived {
  const char* part;
  void (*find)(const Json& part, const Found& found);
  std::vector<facts::Figure> figures;  ///< below the part
};

const std::vector<Derived>& derived() {
  using facts::Better;
  static const std::vector<Derived> all{
      {"timing",
       find_in_timing,
       {{"failed", "1", "modules above the limit of their clock", Better::less},
        {"unknown", "1", "modules above a clock that is known to work, with no known limit",
         Better::less}}},
      {"verdict",
       find_in_verdict,
       {{"feasible", "1", "1 if every part of the verdict holds, 0.5 if one is unknown, else 0",
         Better::more},
        {"*.holds", "1", "the same of one part: ran, job, fits, clocks or timing", Better::more}}}};
  return all;
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
    for (const Derived& more : derived()) {
      if (name != more.part) continue;
      more.find(value, [&](const std::string& end, double figure) {
        found(std::string(more.part) + "." + end, figure);
      });
    }
  }
}

}  // namespace

UnitMetrics::UnitMetrics(bool (*take_member)(const std::string&, const Json&, const Found&),
                         void (*find_rates)(const Json&, const Found&),
                         const std::vector<facts::Figure>& declared)
    : take(take_member), rates(find_rates) {
  unit_metrics().push_back(*this);
  auto& all = declared_by_application();
  all.insert(all.end(), declared.begin(), declared.end());
}

const std::vector<facts::Figure>& application_figures() {
  return declared_by_application();
}

std::vector<facts::Figure> derived_figures() {
  std::vector<facts::Figure> all;
  for (const Derived& more : derived()) {
    for (const facts::Figure& figure : more.figures) all.push_back(figure.below(more.part));
  }
  return all;
}

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

}  // namespace platform::result

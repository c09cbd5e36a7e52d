#include <fpga/synthesis/known_figures.h>

#include <algorithm>
#include <cmath>

#include <fpga/synthesis/synthesis.h>
#include <host/digest.h>
#include <host/document.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace {

using Point = KnownFigures::Point;

constexpr double hz_per_mhz = 1e6;
/// No logic is faster than the clock buffer: 2.155 ns in public timing reports of -1.
constexpr std::uint64_t clock_buffer_hz = 464'000'000;
/// Of LUT and flip-flops, against what Vivado makes of the same RTL (docs/rtl-library.md).
constexpr unsigned uncertainty_percent = 40, uncertainty_beyond_percent = 60;

/// "; not covered by it: two clocks"
std::string not_covered_by(const nlohmann::json& entry) {
  std::string text;
  for (const nlohmann::json& what : entry.value("not_covered", nlohmann::json::array()))
    text += (text.empty() ? "; not covered by it: " : "; ") + what.get<std::string>();
  return text;
}

std::uint32_t count(double number) {
  return static_cast<std::uint32_t>(std::llround(number));
}

/// All primitives.
void take(const KnownFigures::Point& point, vp::IpEstimate& e) {
  e.lut = count(point.lut);
  e.ff = count(point.ff);
  e.dsp = count(point.dsp);
  if (e.bram36 == 0) e.bram36 = point.bram36;
  e.uncertainty_percent = point.beyond ? uncertainty_beyond_percent : uncertainty_percent;
}

std::string mhz(std::uint64_t hz) {
  return vp::format_fixed(static_cast<double>(hz) / hz_per_mhz, 0);
}

Point point_of(const nlohmann::json& entry) {
  Point point;
  for (const char* kind : {"lut", "lut_memory", "lut_through"})
    point.lut += entry.at(kind).get<double>();
  point.ff = entry.at("ff");
  point.bram36 = entry.at("ramb36").get<double>() + entry.at("ramb18").get<double>() / 2;
  point.dsp = entry.at("dsp");
  if (const auto fmax = entry.find("fmax_mhz"); fmax != entry.end()) {
    const auto hz = [&](const char* end) {
      return static_cast<std::uint64_t>(std::llround(fmax->at(end).get<double>() * hz_per_mhz));
    };
    point.fmax_hz = hz("low");
    point.fmax_high_hz = hz("high");
    point.limited_by = entry.value("limited_by", "");
  }
  for (const auto& [name, value] : entry.at("parameters").items()) {
    point.at += (point.at.empty() ? "" : " ") + name + "=" + std::to_string(value.get<int>());
  }
  return point;
}

/// On the line through `a` and `b`; `share` of the way from one to the other.
Point on_line(const Point& a, const Point& b, double share) {
  const auto at = [share](double x, double y) { return std::max(0.0, x + share * (y - x)); };
  Point point;
  point.lut = at(a.lut, b.lut);
  point.ff = at(a.ff, b.ff);
  point.bram36 = std::ceil(2 * at(a.bram36, b.bram36)) / 2;
  point.dsp = std::ceil(at(a.dsp, b.dsp));
  point.fmax_hz = std::min(a.fmax_hz, b.fmax_hz);
  point.fmax_high_hz = std::max(a.fmax_high_hz, b.fmax_high_hz);
  point.at = "between " + a.at + " and " + b.at;
  return point;
}

/// Beyond `end`, which `before` leads to. A tree over twice as many is a level deeper.
Point beyond(const Point& before, const Point& end, double share, double value, double end_value) {
  Point point = on_line(before, end, share);
  const double slower = value > end_value ? std::log(end_value) / std::log(value) : 1;
  point.fmax_hz = static_cast<std::uint64_t>(static_cast<double>(end.fmax_hz) * slower);
  point.fmax_high_hz = end.fmax_high_hz;
  point.at = "continued from " + before.at + " and " + end.at;
  point.beyond = true;
  return point;
}

}  // namespace

const KnownFigures& KnownFigures::installed() {
  static const KnownFigures figures = [] {
    for (const std::string& folder : host::library_folders()) {
      const std::filesystem::path file = std::filesystem::path(folder) / "rtl" / "synthesis.json";
      if (std::filesystem::exists(file)) return load(file);
    }
    throw vp::InputError("no rtl/synthesis.json is installed in " +
                         host::library_folders().front() + "; install markervp completely");
  }();
  return figures;
}

KnownFigures KnownFigures::load(const std::filesystem::path& file) {
  const nlohmann::json json = host::read_json(file, "figures of synthesis");
  KnownFigures figures;
  try {
    figures.tool_ = json.at("tool");
    for (const nlohmann::json& entry : json.at("entries")) {
      figures.entries_.push_back(
          {entry.at("ip"), entry.at("parameters"), entry.value("built_with", Entry().built_with),
           entry.value("sources", Entry().sources), not_covered_by(entry), point_of(entry)});
    }
  } catch (const nlohmann::json::exception& error) {
    throw vp::InputError("'" + file.string() +
                         "' is no file of 'markervp rtl synth --output': " + error.what());
  }
  return figures;
}

std::optional<Point> KnownFigures::find(const vp::IpEstimate::Rtl& rtl) const {
  std::vector<const Entry*> found;
  for (const Entry& entry : entries_) {
    if (entry.module == rtl.module) found.push_back(&entry);
  }
  const auto take_those_at = [&found](const std::string& name, std::int64_t value) {
    std::vector<const Entry*> here;
    for (const Entry* entry : found) {
      const auto parameter = entry->parameters.find(name);
      if (parameter != entry->parameters.end() && parameter->second == value) here.push_back(entry);
    }
    if (!here.empty()) found = here;
  };
  // Several pixels a clock are another circuit, not more of the same.
  const auto pixels = rtl.parameters.find("PIXELS_PER_CLOCK");
  if (pixels != rtl.parameters.end()) take_those_at(pixels->first, pixels->second);
  for (const auto& [name, value] : rtl.parameters) take_those_at(name, value);
  for (const auto& [name, value] : rtl.parameters) {
    std::map<std::int64_t, const Entry*> by_value;
    for (const Entry* entry : found) {
      const auto parameter = entry->parameters.find(name);
      if (parameter != entry->parameters.end()) by_value.emplace(parameter->second, entry);
    }
    if (by_value.size() >= 2) {
      auto b = by_value.lower_bound(value);
      const bool inside = b != by_value.begin() && b != by_value.end();
      if (b == by_value.begin()) ++b;
      if (b == by_value.end()) --b;
      const auto a = std::prev(b);
      const auto share =
          static_cast<double>(value - a->first) / static_cast<double>(b->first - a->first);
      if (inside) return on_line(a->second->point, b->second->point, share);
      return beyond(a->second->point, b->second->point, share, static_cast<double>(value),
                    static_cast<double>(b->first));
    }
  }
  if (found.empty()) return std::nullopt;
  return found.front()->point;
}

namespace {

/// What is known of the model is not so of other RTL.
void forget(vp::IpEstimate& e) {
  e.lut = e.ff = e.dsp = e.uncertainty_percent = 0;
  e.bram36 = 0;
  e.size = 1;
  e.fmax_hz = e.fmax_high_hz = 0;
  e.kind.clear();
  e.includes_memory = false;
  e.memory_reads = nullptr;
}

bool is_among(const std::vector<std::string>& hashes, const std::string& hash) {
  return std::find(hashes.begin(), hashes.end(), hash) != hashes.end();
}

/// It is built from the RTL that comes with markervp, as it is installed.
bool is_own(const vp::IpEstimate& e) {
  try {
    const std::vector<std::filesystem::path> sources = own_designs({e.rtl.module}).at(0).sources;
    return std::all_of(sources.begin(), sources.end(), [&e](const std::filesystem::path& source) {
      return is_among(e.foreign.sources, host::file_hash(source.string()));
    });
  } catch (const vp::InputError&) {
    return false;  // no such IP, or no RTL installed
  }
}

std::string beside(const std::string& object) {
  return std::filesystem::path(object).replace_extension(".figures.json").string();
}

}  // namespace

std::string KnownFigures::Entry::mismatch(const vp::IpEstimate::Foreign& foreign) const {
  if (sources.empty()) return "it does not say which sources it is of";
  for (const auto& [name, hash] : sources) {
    if (!is_among(foreign.sources, hash))
      return "its " + name + " is not one of the sources that the object is built from";
  }
  for (const auto& [name, value] : built_with) {
    const auto built = foreign.parameters.find(name);
    if (built == foreign.parameters.end() || built->second == value) continue;
    return name + " is " + std::to_string(value) + " there, and " + std::to_string(built->second) +
           " in the object";
  }
  return "";
}

std::string KnownFigures::apply_to_foreign(vp::IpEstimate& e, const std::string& file) const {
  std::string why = "it has no entry";
  for (const Entry& entry : entries_) {
    why = entry.mismatch(e.foreign);
    if (!why.empty()) continue;
    take(entry.point, e);
    e.known = true;
    e.source = "synthesised from '" + e.foreign.file + "' (" + tool_ + "), '" + file + "'";
    e.fmax_origin = vp::FmaxOrigin::synthesised;
    e.fmax_hz = entry.point.fmax_hz;
    e.fmax_high_hz = entry.point.fmax_high_hz;
    if (e.fmax_hz == 0) e.fmax_hz = e.fmax_high_hz = clock_buffer_hz;  // no path
    e.fmax_documentation = "synthesis of '" + e.foreign.file + "': " + mhz(e.fmax_hz) + " to " +
                           mhz(e.fmax_high_hz) + " MHz" + entry.not_covered;
    return "";
  }
  return why;
}

void KnownFigures::apply(vp::IpEstimate& e, const std::string& module) const {
  if (e.foreign.file.empty()) return apply_to_model(e);
  const std::string key = module + ".figures";
  const bool named = !e.foreign.figures.empty();
  const std::string file = named ? e.foreign.figures : beside(e.foreign.file);
  std::string why = "it was not synthesised";
  if (named || std::filesystem::exists(file)) {
    vp::IpEstimate own = e;
    forget(own);
    why = load(file).apply_to_foreign(own, file);
    if (why.empty()) {
      e = own;
      return;
    }
    why = "'" + file + "' is of other RTL than '" + e.foreign.file + "': " + why;
    if (named)
      throw vp::InputError(key + ": " + why + "; synthesise it again: markervp rtl synth --output");
  } else if (is_own(e)) {
    for (const auto& [name, value] : e.foreign.parameters)
      e.rtl.parameters[name] = static_cast<std::int64_t>(value);
    return apply_to_model(e);
  }
  forget(e);
  e.known = false;
  e.source = "not known of RTL '" + e.foreign.file + "': " + why +
             "; run 'markervp rtl synth --rtl DIR --top MODULE --output FILE' and give --set " +
             key + "=FILE";
}

void KnownFigures::apply_to_model(vp::IpEstimate& e) const {
  const std::optional<Point> point = find(e.rtl);
  if (!point) return;
  take(*point, e);
  if (!e.rtl.measured.empty()) {
    if (const auto measured = find({e.rtl.module, e.rtl.measured, {}})) {
      e.size = point->lut / measured->lut;
    }
  }
  const std::string where = point->at.empty() ? "" : ", " + point->at;
  e.source = "synthesised from its RTL (" + tool_ + ")" + where;
  if (point->fmax_hz == 0) return;
  const bool limits_known = e.fmax_hz != 0 && e.fmax_hz == e.fmax_high_hz;
  const std::string range =
      "synthesis of its RTL" + where + ": " + mhz(point->fmax_hz) + " to " +
      mhz(point->fmax_high_hz) + " MHz" +
      (point->limited_by.empty() ? "" : ", the limit of the " + point->limited_by);
  const std::string known = e.fmax_documentation;
  e.fmax_documentation = limits_known    ? known + "; " + range
                         : known.empty() ? range
                                         : range + "; " + known;
  if (limits_known) return;
  e.fmax_origin = vp::FmaxOrigin::synthesised;
  const std::uint64_t high =
      e.fmax_high_hz != 0 ? e.fmax_high_hz : std::max(point->fmax_high_hz, e.fmax_hz);
  e.fmax_hz = std::min(high, std::max(e.fmax_hz, point->fmax_hz));
  e.fmax_high_hz = high;
}

}  // namespace platform::synthesis

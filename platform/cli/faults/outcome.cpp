#include <cli/faults/outcome.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <result/result_json.h>

namespace platform::cli {

namespace {

using Json = nlohmann::ordered_json;

/// "pl.axi_dma_0: text (id at 12 us)" without the time.
std::string without_time(const std::string& warning) {
  const std::size_t at = warning.rfind(" at ");
  return at == std::string::npos ? warning : warning.substr(0, at);
}

/// When things happened, and what follows from that.
bool is_of_time(const std::string& name) {
  const std::string ending = "_us";
  const bool is_time = name.size() > ending.size() &&
                       name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  return is_time || name == "fps" || name == "energy_mj";
}

void remove_times(Json& json) {
  if (json.is_object()) {
    std::vector<std::string> times;
    for (const auto& [name, member] : json.items()) {
      if (is_of_time(name)) times.push_back(name);
    }
    for (const std::string& name : times) json.erase(name);
  }
  for (Json& part : json) {
    if (part.is_structured()) remove_times(part);
  }
}

/// Whether unit `i` is as it was without a fault.
bool is_right(const Witness& right, const Witness& seen, std::size_t i) {
  return i < seen.units.size() && seen.units[i] == right.units[i];
}

/// The first warning that the right run does not have; null without.
const std::string* new_warning(const Witness& right, const Witness& seen) {
  const auto& known = right.warnings;
  const auto found =
      std::find_if(seen.warnings.begin(), seen.warnings.end(), [&](const std::string& warning) {
        return std::find(known.begin(), known.end(), warning) == known.end();
      });
  return found == seen.warnings.end() ? nullptr : &*found;
}

}  // namespace

void Witness::add(const facts::UnitReport& unit) {
  Json json = result::to_json(unit);
  remove_times(json);
  for (const char* key : {"warnings", "camera"}) json.erase(key);
  // What a unit delivers, where it delivers something else than counts.
  if (unit.extra || !unit.figures.empty()) {
    json.erase("counts");
    has_data_ = true;
  }
  units.push_back(std::move(json));
  told.push_back(!unit.delivered() || unit.counts.lost() > 0);
  for (const std::string& warning : unit.warnings) add_warning(warning);
}

void Witness::add_warning(const std::string& warning) {
  warnings.push_back(without_time(warning));
}

void Witness::add_console(const std::string& text, const std::vector<std::string>& noticed) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool is_notice = std::any_of(noticed.begin(), noticed.end(), [&](const auto& part) {
      return line.find(part) != std::string::npos;
    });
    if (is_notice) {
      notices.push_back(line);
    } else if (!has_data_) {
      lines.push_back(line);
    }
  }
}

Json Witness::json() const {
  return {{"units", units},         {"told", told},       {"warnings", warnings},
          {"lines", lines},         {"notices", notices}, {"ended", ended},
          {"exit_code", exit_code}, {"error", error},     {"end_ps", end_ps}};
}

Witness Witness::of(const Json& json) {
  Witness witness;
  witness.units = json.at("units");
  json.at("told").get_to(witness.told);
  json.at("warnings").get_to(witness.warnings);
  json.at("lines").get_to(witness.lines);
  json.at("notices").get_to(witness.notices);
  json.at("ended").get_to(witness.ended);
  json.at("exit_code").get_to(witness.exit_code);
  json.at("error").get_to(witness.error);
  json.at("end_ps").get_to(witness.end_ps);
  return witness;
}

const std::vector<Outcome>& outcomes() {
  static const std::vector<Outcome> list = {Outcome::masked,   Outcome::recovered,
                                            Outcome::reported, Outcome::unnoticed,
                                            Outcome::hang,     Outcome::broken};
  return list;
}

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::masked:
      return "masked";
    case Outcome::recovered:
      return "recovered";
    case Outcome::reported:
      return "reported";
    case Outcome::unnoticed:
      return "unnoticed";
    case Outcome::hang:
      return "hang";
    case Outcome::broken:
      return "broken";
  }
  return "";
}

Outcome classify(const Witness& right, const Witness& seen) {
  std::size_t wrong = 0;
  std::size_t silent = 0;
  const std::size_t count = right.units.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (is_right(right, seen, i)) continue;
    ++wrong;
    if (i >= seen.told.size() || !seen.told[i]) ++silent;
  }
  const bool told_all = new_warning(right, seen) != nullptr || seen.notices != right.notices ||
                        (seen.ended && seen.exit_code != right.exit_code);
  const bool noticed = told_all || seen.told != right.told;
  const bool same_text = seen.lines == right.lines;
  if (seen.units.size() < count && (!seen.ended || seen.exit_code == right.exit_code))
    return Outcome::hang;
  if (right.ended && !seen.ended) return Outcome::hang;
  if (wrong == 0 && seen.units.size() == count && same_text)
    return noticed ? Outcome::recovered : Outcome::masked;
  if (!noticed || ((silent > 0 || !same_text) && !told_all)) return Outcome::unnoticed;
  const auto last = [](const Witness& run) {
    return run.lines.empty() ? std::string() : run.lines.back();
  };
  if (last(seen) != last(right)) return Outcome::reported;
  return count == 0 || is_right(right, seen, count - 1) ? Outcome::recovered : Outcome::reported;
}

std::string sign(const Witness& right, const Witness& seen) {
  if (const std::string* warning = new_warning(right, seen)) return *warning;
  if (!seen.error.empty()) return seen.error;
  const auto [expected, found] =
      std::mismatch(right.lines.begin(), right.lines.end(), seen.lines.begin(), seen.lines.end());
  if (found != seen.lines.end()) return "console: " + *found;
  return expected == right.lines.end() ? "" : "console: without '" + *expected + "'";
}

Interval wilson(std::uint64_t hits, std::uint64_t count) {
  if (count == 0) return {0, 1};
  constexpr double z = 1.959963984540054;  // 95 %
  const auto n = static_cast<double>(count);
  const double p = static_cast<double>(hits) / n;
  const double middle = p + z * z / (2 * n);
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  const double scale = 1 + z * z / n;
  return {std::max(0.0, (middle - half) / scale), std::min(1.0, (middle + half) / scale)};
}

}  // namespace platform::cli

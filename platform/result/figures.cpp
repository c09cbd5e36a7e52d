#include <result/figures.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include <result/metrics.h>
#include <result/result_members.h>
#include <result/table.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::result {

namespace {

constexpr std::string_view of_units = "frames.";
constexpr std::string_view unit_ends[] = {".mean", ".max"};

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

bool is_of_units(std::string_view path) {
  return path.substr(0, of_units.size()) == of_units;
}

/// Of a metric of units: without its end. Empty if it has none.
std::string_view without_end(std::string_view name) {
  for (const std::string_view end : unit_ends) {
    if (name.size() > end.size() && name.substr(name.size() - end.size()) == end)
      return name.substr(0, name.size() - end.size());
  }
  return {};
}

[[noreturn]] void refuse(const facts::Figure& figure, const std::string& problem) {
  throw vp::InputError("figure '" + figure.path + "' (" + figure.place + ") " + problem);
}

std::string part_of_result(const std::string& path) {
  return path.substr(0, path.find('.'));
}

/// What every result has, and the application's.
FigureTable first_figures() {
  FigureTable table;
  const auto add = [&](const std::vector<facts::Figure>& list, const std::string& below) {
    for (const facts::Figure& figure : list) table.add(figure.below(below));
  };
  add(figure_members().figures(), "");
  add(unit_members().figures(), "frames");
  add(end_members().figures(), "");
  add(derived_figures(), "");
  add(application_figures(), "");
  return table;
}

const FigureTable& platform_figures() {
  static const FigureTable all = first_figures();
  return all;
}

/// With those of designs.
FigureTable& table() {
  static FigureTable all = platform_figures();
  return all;
}

bool is_same(const facts::Figure& a, const facts::Figure& b) {
  return a.unit == b.unit && a.meaning == b.meaning && a.better == b.better;
}

void declare(const std::vector<facts::Figure>& list) {
  FigureTable own;
  for (const facts::Figure& figure : list) own.add(figure);
  for (const facts::Figure& figure : list) {
    if (figure.path.find('*') != std::string::npos) refuse(figure, "has a * in its name");
    const facts::Figure* const known = platform_figures().with_path(figure.path);
    if (known && !is_same(*known, figure))
      refuse(figure, "is another than the platform's, declared in " + known->place);
    if (known) continue;
    const facts::Figure* const other = table().with_path(figure.path);
    if (!other) {
      table().add(figure);
    } else if (other->unit != figure.unit) {
      refuse(figure, "is in " + figure.unit + ", and another design's in " + other->unit + ": " +
                         other->place + " declares it");
    } else if (other->better != figure.better) {
      refuse(figure, std::string("is better ") + facts::to_string(figure.better) +
                         ", and another design's " + facts::to_string(other->better) + ": " +
                         other->place + " declares it");
    }
  }
}

Json to_json(const facts::Figure& figure) {
  Json json{{"path", figure.path},
            {"unit", figure.unit},
            {"meaning", figure.meaning},
            {"better", facts::to_string(figure.better)}};
  if (!figure.title.empty()) json["title"] = figure.title;
  if (!figure.people_unit.empty()) {
    json["people_unit"] = figure.people_unit;
    json["factor"] = figure.factor;
  }
  json["place"] = figure.place;
  return json;
}

facts::Figure figure_from(const Json& json) {
  const std::string better = json.at("better");
  facts::Figure figure(json.at("path"), json.at("unit"), json.at("meaning"),
                       better == "more"   ? facts::Better::more
                       : better == "less" ? facts::Better::less
                                          : facts::Better::neither,
                       json.value("title", ""));
  figure.people_unit = json.value("people_unit", "");
  figure.factor = json.value("factor", 1.0);
  figure.place = json.at("place");
  return figure;
}

}  // namespace

void FigureTable::add(const facts::Figure& figure) {
  if (figure.path.empty() || figure.path.back() == '.') refuse(figure, "has no name");
  if (figure.unit.empty()) refuse(figure, "has no unit: write \"1\" for a count or a ratio");
  if (figure.meaning.empty()) refuse(figure, "does not say what it means");
  if (const facts::Figure* other = with_path(figure.path))
    refuse(figure, "is declared twice: first in " + other->place);
  const std::string part = part_of_result(figure.path);
  const auto last = std::find_if(list_.rbegin(), list_.rend(), [&](const facts::Figure& other) {
    return part_of_result(other.path) == part;
  });
  list_.insert(last == list_.rend() ? list_.end() : last.base(), figure);
}

const facts::Figure* FigureTable::with_path(const std::string& path) const {
  const auto found = std::find_if(list_.begin(), list_.end(),
                                  [&](const facts::Figure& figure) { return figure.path == path; });
  return found == list_.end() ? nullptr : &*found;
}

const facts::Figure* FigureTable::of(const std::string& metric) const {
  const std::string path(is_of_units(metric) ? without_end(metric) : metric);
  if (path.empty() || path.find('*') != std::string::npos) return nullptr;
  if (const facts::Figure* same = with_path(path)) return same;
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const facts::Figure& figure) {
    return fits(figure.path, path);
  });
  return found == list_.end() ? nullptr : &*found;
}

const FigureTable& figures() {
  return table();
}

void declare(const facts::Work& work) {
  declare(work.declared());
}

void declare(const Json& own_figures) {
  std::vector<facts::Figure> list;
  for (const Json& figure : own_figures) list.push_back(figure_from(figure));
  declare(list);
}

Json own_figures_json(const facts::Work& work) {
  Json json = Json::array();
  for (const facts::Figure& figure : work.declared()) {
    if (!platform_figures().with_path(figure.path)) json.push_back(to_json(figure));
  }
  return json;
}

Json declared_json() {
  Json json = Json::array();
  for (const facts::Figure& figure : figures().list()) {
    if (!platform_figures().with_path(figure.path)) json.push_back(to_json(figure));
  }
  return json;
}

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at))
    text.replace(at, what.size(), by), at += by.size();
  return text;
}

/// What `*` of a pattern is in a path, in words: "axi dma 0".
std::string name_in(const std::string& pattern, const std::string& path) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return "";
  const std::size_t behind = pattern.size() - star - 1;
  return replaced(path.substr(star, path.size() - star - behind), "_", " ");
}

std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// "1" is the unit of what has none.
std::string shown_unit(const std::string& unit) {
  return unit == "1" ? "" : unit;
}

int sign(facts::Better better) {
  return better == facts::Better::more ? 1 : better == facts::Better::less ? -1 : 0;
}

std::string words_for(const std::string& text, const std::string& unit_of_work) {
  return replaced(replaced(text, "Frame", capital(unit_of_work)), "frame", unit_of_work);
}

}  // namespace

std::optional<ShownMetric> shown_metric(const std::string& metric,
                                        const std::string& unit_of_work) {
  const facts::Figure* const figure = figures().of(metric);
  if (!figure || figure->title.empty()) return std::nullopt;
  const std::string path(is_of_units(metric) ? without_end(metric) : metric);
  const bool is_largest = is_of_units(metric) && metric == path + ".max";
  const std::string& unit = figure->people_unit.empty() ? figure->unit : figure->people_unit;
  ShownMetric shown;
  shown.title = words_for(figure->title, unit_of_work) + (is_largest ? ", largest" : "");
  shown.title = capital(replaced(shown.title, "*", name_in(figure->path, path)));
  shown.unit = words_for(shown_unit(unit), unit_of_work);
  shown.factor = figure->factor;
  shown.better = sign(figure->better);
  return shown;
}

Json shown_json(const std::string& text) {
  const ShownMetric shown = shown_metric(text).value_or(ShownMetric{text, unit_of_metric(text)});
  return {{"path", text},
          {"title", shown.title},
          {"unit", shown.unit},
          {"factor", shown.factor},
          {"better", shown.better}};
}

std::vector<std::string> usual_metrics() {
  std::vector<std::string> metrics;
  for (const facts::Figure& figure : figures().list()) {
    if (figure.title.empty() || figure.path.find('*') != std::string::npos) continue;
    metrics.push_back(figure.path);
    if (is_of_units(figure.path)) metrics.back() += unit_ends[0];
  }
  return metrics;
}

Json figures_json() {
  Json json = Json::array();
  for (const facts::Figure& figure : figures().list()) {
    json.push_back({{"path", figure.path},
                    {"unit", shown_unit(figure.unit)},
                    {"better", sign(figure.better)},
                    {"title", figure.title},
                    {"meaning", figure.meaning}});
    if (figure.people_unit.empty()) continue;
    json.back()["people_unit"] = figure.people_unit;
    json.back()["factor"] = figure.factor;
  }
  return json;
}

std::string unit_of_metric(const std::string& text) {
  const facts::Figure* const figure = figures().of(text);
  const bool is_one_name = text.find_first_of(" +-*/()") == std::string::npos;
  return figure && is_one_name ? shown_unit(figure->unit) : "";
}

namespace {

std::vector<std::string> names_without_star() {
  std::vector<std::string> names;
  for (const facts::Figure& figure : figures().list()) {
    if (figure.path.find('*') != std::string::npos) continue;
    if (!is_of_units(figure.path)) names.push_back(figure.path);
    for (const std::string_view end : unit_ends) {
      if (is_of_units(figure.path)) names.push_back(figure.path + std::string(end));
    }
  }
  return names;
}

/// Its metrics.
std::string pattern_of(const facts::Figure& figure) {
  return figure.path + (is_of_units(figure.path) ? ".mean|max" : "");
}

std::string better_text(facts::Better better) {
  return better == facts::Better::neither ? "" : facts::to_string(better);
}

}  // namespace

void check_metric(const std::string& name, const std::vector<std::string>& others) {
  if (figures().of(name) || std::find(others.begin(), others.end(), name) != others.end()) return;
  std::vector<std::string> known = names_without_star();
  known.insert(known.end(), others.begin(), others.end());
  const std::string nearest = vp::nearest_match(name, known);
  throw vp::InputError(
      "unknown metric '" + name + "'" +
      (nearest.empty() ? ": 'markervp metrics' lists them" : "; did you mean '" + nearest + "'?"));
}

std::string metric_table(const std::string& part) {
  TextTable table({"metric", "unit", "better", "meaning"});
  bool any = false;
  for (const facts::Figure& figure : figures().list()) {
    const std::string name = pattern_of(figure);
    if (name.find(part) == std::string::npos && figures().of(part) != &figure) continue;
    table.add({name, shown_unit(figure.unit), better_text(figure.better), figure.meaning});
    any = true;
  }
  if (!any) check_metric(part, {});
  return table.text();
}

std::string metric_markdown() {
  std::string text =
      "# Figures\n\n<!-- Made by `markervp metrics --markdown`. -->\n\n"
      "Every number of a run has a path in `result.json`, by which metrics of sweeps, `compare`, "
      "CSV, SQLite and Python name it.\n"
      "`*` is any name. Figures of frames are named with `.mean` or `.max` at their end, over all "
      "frames. What a design finds of\nits units has the unit that the design declares "
      "([designs.md](designs.md#what-it-delivers)).\n";
  std::string part;
  for (const facts::Figure& figure : figures().list()) {
    if (part_of_result(figure.path) != part) {
      part = part_of_result(figure.path);
      text += "\n## `" + part + "`\n\n| Figure | Unit | Better | Meaning |\n|---|---|---|---|\n";
    }
    text += "| `" + figure.path + "` | " + shown_unit(figure.unit) + " | " +
            better_text(figure.better) + " | " + figure.meaning + " |\n";
  }
  return text;
}

}  // namespace platform::result

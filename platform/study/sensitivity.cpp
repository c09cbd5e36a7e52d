#include <study/sensitivity.h>

#include <result/figures.h>
#include <result/metrics.h>
#include <result/table.h>
#include <study/comparison.h>
#include <study/results.h>
#include <vp/error.h>
#include <vp/text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace platform::study {

namespace {

constexpr int bar_length = 24;

class Analysis {
 public:
  Analysis(const Results& results, const vp::Expression& figure, bool all)
      : results_(results), figure_(figure), all_(all) {
    if (results.manifest.effects.empty()) return;
    for (const ResultRow& row : results.rows) rows_[row.key] = &row;
  }

  SensitivityReport report() {
    check_names(results_, figure_);
    if (results_.manifest.sampling == "morris") {
      morris();
    } else if (results_.manifest.sampling == "one-at-a-time") {
      one_at_a_time();
    } else {
      all_else_equal();
    }
    if (report_.rows.empty())
      throw vp::InputError("sensitivity: too few points count for '" + figure_.text() + "': " +
                           verdicts_text(results_) + (all_ ? "" : "; --all takes all that ran"));
    std::stable_sort(report_.rows.begin(), report_.rows.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return std::move(report_);
  }

 private:
  std::optional<double> figure(const std::string& key) const {
    const auto found = rows_.find(key);
    return found == rows_.end() ? std::nullopt : figure(*found->second);
  }

  /// None: the point does not count, or lacks what the figure is made of.
  std::optional<double> figure(const ResultRow& row) const {
    if (row.failed) return std::nullopt;
    if (!all_ && results_.feasible(row) != result::Holds::yes) return std::nullopt;
    return figure_in(row, figure_);
  }

  /// Those that have the figure, with it.
  using Points = std::vector<std::pair<const ResultRow*, double>>;
  Points points() const {
    Points known;
    for (const ResultRow& row : results_.rows) {
      if (const std::optional<double> value = figure(row)) known.emplace_back(&row, *value);
    }
    return known;
  }

  static double mean(const Points& points) {
    double sum = 0;
    for (const auto& [row, value] : points) sum += value;
    return points.empty() ? 0 : sum / static_cast<double>(points.size());
  }

  void morris() {
    report_.method = "morris";
    std::map<std::string, std::vector<double>> effects;
    for (const KeyedEffect& effect : results_.manifest.effects) {
      const std::optional<double> from = figure(effect.from);
      const std::optional<double> to = figure(effect.to);
      if (!from || !to) {
        ++report_.skipped;
        continue;
      }
      effects[effect.path].push_back((*to - *from) / effect.delta);
    }
    for (const auto& [path, values] : effects) {
      Sensitivity row;
      row.path = path;
      row.count = values.size();
      const auto count = static_cast<double>(values.size());
      for (const double value : values) {
        row.mean += value / count;
        row.mean_size += std::fabs(value) / count;
      }
      double squares = 0;
      for (const double value : values) squares += (value - row.mean) * (value - row.mean);
      row.deviation = values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0;
      report_.rows.push_back(row);
    }
    report_.basis = "Morris' elementary effects, over the whole range of each parameter; mean " +
                    result::readable(mean(points()));
  }

  void one_at_a_time() {
    report_.method = "one-at-a-time";
    const auto& effects = results_.manifest.effects;
    const std::optional<double> base =
        effects.empty() ? std::nullopt : figure(effects.front().from);
    if (!base)
      throw vp::InputError(
          "sensitivity: the base point is not feasible, is not computed yet or has no '" +
          figure_.text() + "'" + (all_ ? "" : "; --all takes all that ran"));
    report_.basis = "each value alone, from the base point; base " + result::readable(*base);
    std::map<std::string, Sensitivity> rows;
    for (const KeyedEffect& effect : effects) {
      const std::optional<double> value = figure(effect.to);
      if (!value) {
        ++report_.skipped;
        continue;
      }
      add(rows, effect.path, *value, swept_text(*rows_.at(effect.to)));
    }
    for (auto& [path, row] : rows) {
      extend(row, *base, "base");
      report_.rows.push_back(row);
    }
  }

  void all_else_equal() {
    report_.method = "all else equal";
    const Points known = points();
    report_.skipped = results_.rows.size() - known.size();
    std::vector<const ResultRow*> rows;
    std::unordered_map<const ResultRow*, double> values;
    for (const auto& [row, value] : known) {
      rows.push_back(row);
      values.emplace(row, value);
    }
    for (const std::vector<std::string>& paths : results_.manifest.dimensions()) {
      Sensitivity row = compared(comparisons(rows, paths), values, paths);
      if (row.count == 0) {
        report_.not_compared.push_back(row.path);
      } else {
        report_.rows.push_back(std::move(row));
      }
    }
    if (report_.rows.empty() && known.size() > 1)
      throw vp::InputError("sensitivity: " + not_compared_text(report_));
    report_.basis = "all else equal: " +
                    std::string(results_.manifest.sampling == "search"
                                    ? "points of a search, compared where they differ "
                                    : "points, compared where they differ ") +
                    "in one parameter alone";
  }

  static Sensitivity compared(const std::vector<Comparison>& comparisons,
                              const std::unordered_map<const ResultRow*, double>& values,
                              const std::vector<std::string>& paths) {
    Sensitivity row;
    row.path = vp::join(paths, "+");
    for (const Comparison& comparison : comparisons) {
      const auto [low, high] = std::minmax_element(
          comparison.begin(), comparison.end(),
          [&](const auto* a, const auto* b) { return values.at(a) < values.at(b); });
      const double from = values.at(*low), to = values.at(*high);
      row.mean_size += (to - from) / static_cast<double>(comparisons.size());
      if (row.count++ != 0 && to - from <= row.swing()) continue;
      row.low = from;
      row.high = to;
      row.low_at = values_text(**low, paths);
      row.high_at = values_text(**high, paths);
    }
    return row;
  }

  static std::string values_text(const ResultRow& row, const std::vector<std::string>& paths) {
    std::vector<std::string> values;
    values.reserve(paths.size());
    for (const std::string& path : paths) values.push_back(row.value(path));
    return vp::join(values, " / ");
  }

  static std::string swept_text(const ResultRow& row) {
    std::vector<std::string> values;
    for (const auto& [path, value] : row.swept) values.push_back(value.text());
    return vp::join(values, " / ");
  }

  static void add(std::map<std::string, Sensitivity>& rows, const std::string& path, double value,
                  const std::string& at) {
    const auto [found, is_new] = rows.try_emplace(path);
    Sensitivity& row = found->second;
    row.path = path;
    ++row.count;
    if (is_new) {
      row.low = row.high = value;
      row.low_at = row.high_at = at;
    } else {
      extend(row, value, at);
    }
  }

  static void extend(Sensitivity& row, double value, const std::string& at) {
    if (value < row.low) {
      row.low = value;
      row.low_at = at;
    }
    if (value > row.high) {
      row.high = value;
      row.high_at = at;
    }
  }

  const Results& results_;
  const vp::Expression& figure_;
  const bool all_;
  std::map<std::string, const ResultRow*> rows_;
  SensitivityReport report_;
};

std::string bar(double size, double largest) {
  if (!(largest > 0)) return "";
  return std::string(static_cast<std::size_t>(std::lround(bar_length * size / largest)), '#');
}

}  // namespace

SensitivityReport sensitivity(const Results& results, const vp::Expression& figure, bool all) {
  return Analysis(results, figure, all).report();
}

std::string not_compared_text(const SensitivityReport& report) {
  if (report.not_compared.empty()) return "";
  return "no two of the points that count differ in one of these alone, so nothing can be said of "
         "it: " +
         vp::join(report.not_compared, ", ") +
         "; 'markervp sensitivity --at FOLDER:KEY' computes the steps around a point, "
         "and 'sample: {method: morris}' or 'one-at-a-time' makes a sweep for it";
}

std::string sensitivity_table(const SensitivityReport& report) {
  if (report.method == "morris") {
    result::TextTable table({"parameter", "mean size", "mean", "deviation", "effects", ""});
    for (const Sensitivity& row : report.rows)
      table.add({row.path, result::readable(row.mean_size), result::readable(row.mean),
                 result::readable(row.deviation), std::to_string(row.count),
                 bar(row.mean_size, report.rows.front().mean_size)});
    return table.text();
  }
  if (report.method == "all else equal") {
    result::TextTable table(
        {"parameter", "mean change", "comparisons", "the largest: from", "at", "to", "at", ""});
    for (const Sensitivity& row : report.rows)
      table.add({row.path, result::readable(row.mean_size), std::to_string(row.count),
                 result::readable(row.low), row.low_at, result::readable(row.high), row.high_at,
                 bar(row.mean_size, report.rows.front().mean_size)});
    return table.text();
  }
  result::TextTable table({"parameter", "swing", "lowest", "at", "highest", "at", ""});
  for (const Sensitivity& row : report.rows)
    table.add({row.path, result::readable(row.swing()), result::readable(row.low), row.low_at,
               result::readable(row.high), row.high_at,
               bar(row.swing(), report.rows.front().swing())});
  return table.text();
}

std::string sensitivity_csv(const std::string& figure, const SensitivityReport& report) {
  std::string text = result::csv_line({"figure", "method", "parameter", "count", "mean_size",
                                       "mean", "deviation", "low", "low_at", "high", "high_at"});
  for (const Sensitivity& row : report.rows) {
    text += result::csv_line({figure, report.method, row.path, std::to_string(row.count),
                              result::csv_number(row.mean_size), result::csv_number(row.mean),
                              result::csv_number(row.deviation), result::csv_number(row.low),
                              row.low_at, result::csv_number(row.high), row.high_at});
  }
  return text;
}

Json sensitivity_json(const Results& results, const vp::Expression& figure) {
  Json json{{"metric", figure.text()}, {"basis", ""}, {"rows", Json::array()}, {"note", ""}};
  try {
    const SensitivityReport report = sensitivity(results, figure);
    json["basis"] = report.basis;
    json["note"] = not_compared_text(report);
    for (const Sensitivity& row : report.rows) {
      Json& entry = json["rows"].emplace_back(
          Json{{"path", row.path}, {"count", row.count}, {"size", row.size()}});
      if (report.method == "morris") continue;
      entry["low"] = row.low;
      entry["low_at"] = row.low_at;
      entry["high"] = row.high;
      entry["high_at"] = row.high_at;
    }
  } catch (const vp::InputError& error) {
    json["note"] = error.what();
  }
  return json;
}

namespace {

/// The values of a group one step away from the point's.
std::vector<Assignment> neighbours(const AxisGroup& group, const Assignment& at) {
  std::vector<Assignment> found;
  const AxisValues& first = group.front();
  const std::string* here = find(at, first.path());
  if (here == nullptr) return found;
  if (group.size() == 1) {
    for (const std::string& value : first.neighbours(*here))
      found.push_back({{first.path(), value}});
    return found;
  }
  const auto is_here = [&](std::size_t i) {
    return std::all_of(group.begin(), group.end(), [&](const AxisValues& axis) {
      const std::string* value = find(at, axis.path());
      return value != nullptr && *value == axis.values()[i];
    });
  };
  const std::size_t count = first.values().size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool beside = (i > 0 && is_here(i - 1)) || (i + 1 < count && is_here(i + 1));
    if (is_here(i) || (first.ordered() && !beside)) continue;
    Assignment values;
    for (const AxisValues& axis : group) values.emplace_back(axis.path(), axis.values()[i]);
    found.push_back(std::move(values));
  }
  return found;
}

bool allowed(const Space& space, const Assignment& point) {
  const auto lookup = [&](const std::string& name) { return space.value(point, name); };
  return std::all_of(space.conditions().begin(), space.conditions().end(),
                     [&](const vp::Expression& condition) { return condition.holds(lookup); });
}

Step step_to(const Assignment& at, const Assignment& values) {
  Step step;
  step.point = at;
  std::vector<std::string> paths, from, to;
  for (const auto& [path, value] : values) {
    paths.push_back(path.text());
    to.push_back(value.text());
    for (auto& [name, now] : step.point) {
      if (name == path) from.push_back(std::exchange(now, value).text());
    }
  }
  step.path = vp::join(paths, "+");
  step.from = vp::join(from, " / ");
  step.to = vp::join(to, " / ");
  return step;
}

}  // namespace

std::vector<Step> steps_from(const Space& space, const Assignment& at) {
  std::vector<Step> steps;
  for (const AxisGroup& group : space.groups()) {
    for (const Assignment& values : neighbours(group, at)) {
      Step step = step_to(at, values);
      if (allowed(space, step.point)) steps.push_back(std::move(step));
    }
  }
  return steps;
}

StepEffects effects_of(const std::vector<Step>& steps, const Results& results,
                       const std::vector<vp::Expression>& figures) {
  StepEffects effects;
  effects.figures = figures;
  for (const vp::Expression& figure : figures)
    effects.base.push_back(figure_in(results.rows.front(), figure));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const ResultRow& result = results.rows[i + 1];
    StepEffects::Row row{steps[i], {}, vp::join(results.reasons(result), "; "), 0};
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const auto base = effects.base[f], here = figure_in(result, figures[f]);
      const bool known = base && here && !result.failed;
      row.changes.push_back(known ? std::optional<double>(*here - *base) : std::nullopt);
      if (known && *base != 0) row.strength = std::max(row.strength, std::fabs(*here / *base - 1));
    }
    effects.rows.push_back(std::move(row));
  }
  std::stable_sort(effects.rows.begin(), effects.rows.end(),
                   [](const auto& a, const auto& b) { return a.strength > b.strength; });
  return effects;
}

namespace {

std::vector<std::string> texts(const std::vector<vp::Expression>& figures) {
  std::vector<std::string> texts;
  texts.reserve(figures.size());
  for (const vp::Expression& figure : figures) texts.push_back(figure.text());
  return texts;
}

}  // namespace

std::string effects_table(const StepEffects& effects) {
  std::vector<std::string> head{"parameter", "from", "to"};
  for (const std::string& name : result::short_names(texts(effects.figures))) head.push_back(name);
  head.emplace_back("");
  result::TextTable table(head);
  std::vector<std::string> base{"this point", "", ""};
  for (const auto& figure : effects.base) base.push_back(figure ? result::readable(*figure) : "-");
  base.emplace_back("");
  table.add(base);
  for (const StepEffects::Row& row : effects.rows) {
    std::vector<std::string> fields{row.step.path, row.step.from, row.step.to};
    for (const auto& change : row.changes)
      fields.push_back(!change ? "-" : (*change > 0 ? "+" : "") + result::readable(*change));
    fields.push_back(row.trouble);
    table.add(fields);
  }
  return table.text();
}

std::string effects_csv(const StepEffects& effects) {
  std::string text =
      result::csv_line({"figure", "base", "parameter", "from", "to", "change", "trouble"});
  for (std::size_t f = 0; f < effects.figures.size(); ++f) {
    const auto number = [](const std::optional<double>& value) {
      return value ? result::csv_number(*value) : "";
    };
    for (const StepEffects::Row& row : effects.rows)
      text += result::csv_line({effects.figures[f].text(), number(effects.base[f]), row.step.path,
                                row.step.from, row.step.to, number(row.changes[f]), row.trouble});
  }
  return text;
}

Json effects_json(const StepEffects& effects, const std::string& key) {
  const auto number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json json{{"key", key}, {"figures", Json::array()}, {"rows", Json::array()}};
  for (std::size_t f = 0; f < effects.figures.size(); ++f) {
    const std::string& path = effects.figures[f].text();
    Json figure = result::shown_json(path);
    figure["base"] = number(effects.base[f]);
    json["figures"].push_back(figure);
  }
  for (const StepEffects::Row& row : effects.rows) {
    Json changes = Json::array();
    for (const auto& change : row.changes) changes.push_back(number(change));
    json["rows"].push_back({{"path", row.step.path},
                            {"from", row.step.from},
                            {"to", row.step.to},
                            {"changes", changes},
                            {"trouble", row.trouble}});
  }
  return json;
}

}  // namespace platform::study

#include <explore/steps.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <sweep/metrics.h>
#include <sweep/report.h>
#include <vp/text.h>

namespace platform::explore {

namespace {

/// The values of a group one step away from the point's.
std::vector<sweep::Assignment> neighbours(const sweep::AxisGroup& group,
                                          const sweep::Assignment& at) {
  std::vector<sweep::Assignment> found;
  const sweep::AxisValues& first = group.front();
  const std::string* here = find(at, first.path());
  if (here == nullptr) return found;
  if (group.size() == 1) {
    for (const std::string& value : first.neighbours(*here))
      found.push_back({{first.path(), value}});
    return found;
  }
  const auto is_here = [&](std::size_t i) {
    return std::all_of(group.begin(), group.end(), [&](const sweep::AxisValues& axis) {
      const std::string* value = find(at, axis.path());
      return value != nullptr && *value == axis.values()[i];
    });
  };
  const std::size_t count = first.values().size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool beside = (i > 0 && is_here(i - 1)) || (i + 1 < count && is_here(i + 1));
    if (is_here(i) || (first.ordered() && !beside)) continue;
    sweep::Assignment values;
    for (const sweep::AxisValues& axis : group) values.emplace_back(axis.path(), axis.values()[i]);
    found.push_back(std::move(values));
  }
  return found;
}

bool allowed(const sweep::Space& space, const sweep::Assignment& point) {
  const auto lookup = [&](const std::string& name) { return space.value(point, name); };
  return std::all_of(space.conditions().begin(), space.conditions().end(),
                     [&](const vp::Expression& condition) { return condition.holds(lookup); });
}

Step step_to(const sweep::Assignment& at, const sweep::Assignment& values) {
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

std::vector<Step> steps_from(const sweep::Space& space, const sweep::Assignment& at) {
  std::vector<Step> steps;
  for (const sweep::AxisGroup& group : space.groups()) {
    for (const sweep::Assignment& values : neighbours(group, at)) {
      Step step = step_to(at, values);
      if (allowed(space, step.point)) steps.push_back(std::move(step));
    }
  }
  return steps;
}

StepEffects effects_of(const std::vector<Step>& steps, const sweep::Results& results,
                       const std::vector<vp::Expression>& figures) {
  StepEffects effects;
  effects.figures = figures;
  for (const vp::Expression& figure : figures)
    effects.base.push_back(figure_in(results.rows.front(), figure));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const sweep::ResultRow& result = results.rows[i + 1];
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
  for (const vp::Expression& figure : figures) texts.push_back(figure.text());
  return texts;
}

}  // namespace

std::string effects_table(const StepEffects& effects) {
  std::vector<std::string> head{"parameter", "from", "to"};
  for (const std::string& name : sweep::short_names(texts(effects.figures))) head.push_back(name);
  head.emplace_back("");
  sweep::TextTable table(head);
  std::vector<std::string> base{"this point", "", ""};
  for (const auto& figure : effects.base) base.push_back(figure ? sweep::readable(*figure) : "-");
  base.emplace_back("");
  table.add(base);
  for (const StepEffects::Row& row : effects.rows) {
    std::vector<std::string> fields{row.step.path, row.step.from, row.step.to};
    for (const auto& change : row.changes)
      fields.push_back(!change ? "-" : (*change > 0 ? "+" : "") + sweep::readable(*change));
    fields.push_back(row.trouble);
    table.add(fields);
  }
  return table.text();
}

std::string effects_csv(const StepEffects& effects) {
  std::string text =
      sweep::csv_line({"figure", "base", "parameter", "from", "to", "change", "trouble"});
  for (std::size_t f = 0; f < effects.figures.size(); ++f) {
    const auto number = [](const std::optional<double>& value) {
      return value ? sweep::csv_number(*value) : "";
    };
    for (const StepEffects::Row& row : effects.rows)
      text += sweep::csv_line({effects.figures[f].text(), number(effects.base[f]), row.step.path,
                               row.step.from, row.step.to, number(row.changes[f]), row.trouble});
  }
  return text;
}

sweep::Json effects_json(const StepEffects& effects, const std::string& key) {
  const auto number = [](const std::optional<double>& value) {
    return value ? sweep::Json(*value) : sweep::Json();
  };
  sweep::Json json{{"key", key}, {"figures", sweep::Json::array()}, {"rows", sweep::Json::array()}};
  for (std::size_t f = 0; f < effects.figures.size(); ++f) {
    const std::string& path = effects.figures[f].text();
    json["figures"].push_back(
        {{"path", path}, {"unit", sweep::unit_of_metric(path)}, {"base", number(effects.base[f])}});
  }
  for (const StepEffects::Row& row : effects.rows) {
    sweep::Json changes = sweep::Json::array();
    for (const auto& change : row.changes) changes.push_back(number(change));
    json["rows"].push_back({{"path", row.step.path},
                            {"from", row.step.from},
                            {"to", row.step.to},
                            {"changes", changes},
                            {"trouble", row.trouble}});
  }
  return json;
}

}  // namespace platform::explore

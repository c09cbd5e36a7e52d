#include <study/report.h>

#include <result/console.h>
#include <result/figures.h>
#include <result/metrics.h>
#include <result/page/report_page.h>
#include <result/table.h>
#include <study/comparison.h>
#include <study/pareto.h>
#include <study/sensitivity.h>
#include <vp/text.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace platform::study {

namespace {

/// Columns of figures that fit a terminal.
constexpr std::size_t most_figures = 6;
/// Reasons of failure that are printed.
constexpr std::size_t most_reasons = 8;

/// Points that the page has: among so many a slider's move takes less than a tenth of a second.
constexpr std::size_t most_page_points = 20'000;
/// Points that are judged by bands if there are more than two objectives: each against all others.
constexpr std::size_t most_judged = 5'000;

/// The swept parameters that differ.
std::vector<std::string> decisive(const Results& results) {
  std::vector<std::string> paths;
  for (const std::string& path : results.manifest.swept) {
    const auto differs = [&](const ResultRow& row) {
      return row.value(path) != results.rows.front().value(path);
    };
    if (std::any_of(results.rows.begin(), results.rows.end(), differs)) paths.push_back(path);
  }
  return paths.empty() ? results.manifest.swept : paths;
}

/// A figure of a point: a metric, or what an objective makes of some.
struct Column {
  std::string text;
  vp::Expression expression;
};

/// Columns without those that no result has, each once.
class Columns {
 public:
  explicit Columns(const Results& results) : results_(results) {}

  void add(const std::string& text, vp::Expression expression) {
    const auto is_it = [&](const Column& other) { return other.text == text; };
    const auto has_it = [&](const ResultRow& row) {
      return figure_in(row, expression).has_value();
    };
    const auto& swept = results_.manifest.swept;
    if (std::none_of(list_.begin(), list_.end(), is_it) &&
        std::find(swept.begin(), swept.end(), text) == swept.end() &&
        std::any_of(results_.rows.begin(), results_.rows.end(), has_it))
      list_.push_back({text, std::move(expression)});
  }
  void add(const std::string& name) {
    add(name, vp::Expression("`" + name + "`", results_.manifest.name));
  }
  bool empty() const { return list_.empty(); }
  std::vector<Column> take() { return std::move(list_); }

 private:
  const Results& results_;
  std::vector<Column> list_;
};

/// What the sweep is about: its objectives, what it has constraints on, its metrics; else the
/// speed.
Columns asked_of(const Results& results) {
  Columns columns(results);
  for (const Objective& objective : objectives_of(results))
    columns.add(objective.figure().text(), objective.figure());
  for (const vp::Expression& constraint : results.constraints) {
    for (const std::string& name : constraint.names()) columns.add(name);
  }
  for (const std::string& metric : results.manifest.metrics) columns.add(metric);
  if (columns.empty()) columns.add("summary.fps.mean");
  return columns;
}

/// Points as lines of a terminal, at most so many in all.
class PointLines {
 public:
  PointLines(const Results& results, std::size_t most)
      : paths_(decisive(results)), columns_(asked_of(results).take()), left_(most) {
    if (columns_.size() > most_figures) columns_.resize(most_figures);
  }

  /// Each point with what `words` say of it, under this heading.
  using Points = std::vector<const ResultRow*>;
  using Words = std::function<std::string(const ResultRow&)>;
  std::string text(const Points& points, const std::string& heading, const Words& words) {
    std::vector<std::string> names = paths_;
    for (const Column& column : columns_) names.push_back(column.text);
    std::vector<std::string> head = result::short_names(names);
    head.push_back(heading);
    result::TextTable table(head);
    const std::size_t shown = std::min(left_, points.size());
    for (std::size_t i = 0; i < shown; ++i) table.add(line(*points[i], words(*points[i])));
    left_ -= shown;
    std::string text = shown == 0 ? "" : table.text();
    if (points.size() > shown)
      text += "… and " + result::counted(points.size() - shown, "point") + " more: see sweep.csv\n";
    return text;
  }

 private:
  std::vector<std::string> line(const ResultRow& row, const std::string& last) const {
    std::vector<std::string> fields;
    for (const std::string& path : paths_) fields.push_back(row.value(path));
    for (const Column& column : columns_) {
      const std::optional<double> found = figure_in(row, column.expression);
      fields.push_back(found ? result::readable(*found) : "-");
    }
    fields.push_back(last);
    return fields;
  }

  std::vector<std::string> paths_;
  std::vector<Column> columns_;
  std::size_t left_;
};

/// The points that ran: the best first, then those that are not feasible.
std::string ranked_text(const Results& results, const std::vector<Objective>& objectives,
                        PointLines& lines) {
  const Pareto pareto = rank(results, objectives);
  PointLines::Points good, bad;
  std::map<const ResultRow*, std::string> words;
  for (const std::size_t i : best_first(pareto, objectives)) {
    const RankedPoint& point = pareto.points[i];
    (point.feasible == result::Holds::yes ? good : bad).push_back(point.row);
    if (point.front == 1) words[point.row] = pareto.knee == i ? "knee" : "front";
  }
  std::string text = lines.text(good, "", [&](const ResultRow& row) {
    const auto found = words.find(&row);
    return found == words.end() ? repetition_text(results, row) : found->second;
  });
  if (good.empty()) text = why_no_point(results) + "\n";
  if (!bad.empty())
    text += "\nNot feasible:\n\n" + lines.text(bad, "why", [&](const ResultRow& row) {
      std::vector<std::string> why = results.reasons(row);
      if (row.same_as) why.push_back(repetition_text(results, row));
      return vp::join(why, "; ");
    });
  return text;
}

/// The points that failed, by reason.
std::string failures_text(const Results& results, PointLines& lines) {
  std::map<std::string, PointLines::Points> reasons;
  for (const ResultRow& row : results.rows) {
    if (row.failed) reasons[row.failure.message].push_back(&row);
  }
  std::string text;
  std::size_t printed = 0;
  for (const auto& [reason, points] : reasons) {
    if (printed++ == most_reasons) return text + "\nand other reasons: see sweep.csv\n";
    text += "\n" + result::counted(points.size(), "point") + " failed: " + reason + "\n\n" +
            lines.text(points, "", [](const ResultRow&) { return ""; });
  }
  return text;
}

}  // namespace

std::string sweep_text(const Results& results, std::size_t most_rows) {
  const Manifest& manifest = results.manifest;
  std::string text = vp::visible(manifest.title.empty() ? manifest.name : manifest.title) + "\n";
  PointLines lines(results, most_rows);
  if (results.failed() != results.rows.size())
    text += "\n" + ranked_text(results, objectives_of(results), lines);
  text += failures_text(results, lines);
  if (!results.rows.empty()) text += "\n" + verdicts_text(results) + "\n";
  const std::string idle = idle_text(idle_parameters(results));
  if (!idle.empty()) text += "\n" + idle;
  if (!manifest.text.empty() && results.missing == 0) {
    text += "\n" + manifest.text;
    if (text.back() != '\n') text += "\n";
  }
  return vp::visible_lines(text);
}

namespace {

Json objectives_json(const std::vector<Objective>& objectives) {
  Json json = Json::array();
  for (const Objective& objective : objectives) {
    const std::string& metric = objective.figure().text();
    json.push_back({{"metric", metric},
                    {"unit", result::unit_of_metric(metric)},
                    {"better", objective.maximise() ? 1 : -1}});
  }
  return json;
}

Json point_json(const Results& results, const ResultRow& row, const std::vector<Column>& columns,
                const std::vector<Objective>& objectives) {
  Json json{{"key", row.key}, {"swept", Json::array()}, {"metrics", Json::array()}};
  for (const std::string& path : results.manifest.swept) json["swept"].push_back(row.value(path));
  for (const Column& column : columns) {
    const std::optional<double> value = figure_in(row, column.expression);
    json["metrics"].push_back(value ? Json(*value) : Json());
  }
  json["failed"] = row.failed;
  json["reasons"] = results.reasons(row);
  if (is_repetition(results, row, objectives)) json["same_as"] = repetition_text(results, row);
  return json;
}

/// Where a row is among the others.
struct Standing {
  std::size_t front = 0;              ///< 0 for none
  std::optional<std::size_t> better;  ///< the row that beats it
  /// By the bands of the figures; none if these have none.
  std::optional<result::Holds> dominated;
};

/// Of each row; and what the bands say of the front.
struct Standings {
  std::vector<Standing> rows;
  std::string doubt;
};

Standings standings_of(const Results& results, const std::vector<Objective>& objectives) {
  std::vector<Standing> found(results.rows.size());
  Pareto pareto = rank(results, objectives);
  if (objectives.size() <= 2 || pareto.points.size() <= most_judged)
    judge_by_bands(pareto, objectives);
  find_better(pareto, objectives);
  const auto place_of = [&](const RankedPoint& point) {
    return static_cast<std::size_t>(point.row - results.rows.data());
  };
  for (const RankedPoint& point : pareto.points) {
    Standing& standing = found[place_of(point)];
    standing.front = point.front;
    if (point.better) standing.better = place_of(pareto.points[*point.better]);
    if (pareto.has_bands && point.front > 0) standing.dominated = point.dominated;
  }
  return {std::move(found), doubt_text(pareto)};
}

/// The rows that the page has room for: all of the first front, and of the others every so many.
std::vector<std::size_t> page_rows(const std::vector<Standing>& standings) {
  std::vector<std::size_t> best, others;
  for (std::size_t i = 0; i < standings.size(); ++i)
    (standings[i].front == 1 ? best : others).push_back(i);
  const auto thin_out = [](std::vector<std::size_t>& rows, std::size_t most) {
    const std::size_t all = rows.size();
    if (all <= most) return;
    for (std::size_t i = 0; i < most; ++i) rows[i] = rows[i * all / most];
    rows.resize(most);
  };
  thin_out(best, most_page_points);
  thin_out(others, most_page_points - best.size());
  std::vector<std::size_t> rows(best);
  rows.insert(rows.end(), others.begin(), others.end());
  std::sort(rows.begin(), rows.end());  // as the sweep has them
  return rows;
}

Json counts_json(const Results& results) {
  const auto feasible = [&](const ResultRow& row) {
    return results.feasible(row) == result::Holds::yes;
  };
  return {{"points", results.rows.size()},
          {"feasible", std::count_if(results.rows.begin(), results.rows.end(), feasible)},
          {"failed", results.failed()}};
}

/// The page breaks lines itself, and shows line feeds in texts as what they are.
std::string in_one_line(const std::string& text) {
  std::string line(vp::trim(text));
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

}  // namespace

std::string page_block(const Results& results, const std::string& folder, const Json& more) {
  const Manifest& manifest = results.manifest;
  const std::vector<Objective> objectives = objectives_of(results);
  Columns asked = asked_of(results);
  for (const std::string& name : result::usual_metrics()) asked.add(name);
  const std::vector<Column> columns = asked.take();
  Json json{{"name", manifest.name},
            {"title", manifest.title},
            {"text", results.missing == 0 ? in_one_line(manifest.text) : ""},
            {"folder", folder},
            {"swept", manifest.swept},
            {"idle", idle_text(idle_parameters(results))},
            {"missing", results.missing},
            {"counts", counts_json(results)},
            {"objectives", objectives_json(objectives)},
            {"constraints", Json::array()},
            {"metrics", Json::array()}};
  for (const vp::Expression& constraint : results.constraints)
    json["constraints"].push_back(constraint.text());
  for (const Column& column : columns) json["metrics"].push_back(result::shown_json(column.text));
  if (!objectives.empty())
    json["influence"] = sensitivity_json(results, objectives.front().figure());
  json.update(more);
  const auto [standings, doubt] = standings_of(results, objectives);
  if (!doubt.empty()) json["doubt"] = doubt;
  const std::vector<std::size_t> rows = page_rows(standings);
  std::string points;
  for (const std::size_t i : rows) {
    Json point = point_json(results, results.rows[i], columns, objectives);
    point["front"] = standings[i].front;
    if (standings[i].dominated) point["dominated"] = result::to_string(*standings[i].dominated);
    if (standings[i].better) {
      const auto better = std::lower_bound(rows.begin(), rows.end(), *standings[i].better);
      if (better != rows.end() && *better == *standings[i].better)
        point["better"] = better - rows.begin();
    }
    points += (points.empty() ? "" : ",") + json_text(point);
  }
  std::string text = json_text(json);
  text.back() = ',';
  return text + "\"points\":[" + points + "]}";
}

std::vector<vp::Expression> page_figures() {
  std::vector<vp::Expression> figures;
  for (const std::string& name : result::usual_metrics()) figures.emplace_back(name, name);
  return figures;
}

bool write_page(const Results& results, const std::string& folder, const Json& more) {
  return page::write_page((std::filesystem::path(folder) / page::report_name).string(),
                          {{"sweep", page_block(results, folder, more)}});
}

std::vector<std::string> missing_figures(const Manifest& manifest,
                                         const result::Metrics::Names& known) {
  std::set<std::string> asked(manifest.metrics.begin(), manifest.metrics.end());
  const auto ask = [&](const vp::Expression& expression) {
    asked.insert(expression.names().begin(), expression.names().end());
  };
  for (const std::string& text : manifest.objectives) ask(Objective(text, manifest.name).figure());
  for (const std::string& text : manifest.constraints) ask(vp::Expression(text, manifest.name));
  if (!manifest.job.empty()) ask(vp::Expression(manifest.job, manifest.name));
  // They may use parameters, too.
  for (const Family& family : manifest.families) {
    for (const auto& [path, value] : family.configuration) asked.erase(path);
  }
  for (const char* special : {"system", "program", "inputs"}) asked.erase(special);
  std::vector<std::string> complaints;
  for (const std::string& name : asked) {
    if (std::binary_search(known.begin(), known.end(), name)) continue;
    const facts::Figure* figure = result::figures().of(name);
    const bool well_spelt = figure && figure->path.find('*') == std::string::npos;
    const std::string nearest = well_spelt ? "" : vp::nearest_match(name, known);
    complaints.push_back("no result has the metric '" + name + "'" +
                         (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }
  return complaints;
}

}  // namespace platform::study

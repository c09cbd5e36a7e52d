#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <result/console.h>
#include <result/figures.h>
#include <result/metrics.h>
#include <result/table.h>
#include <study/doubt.h>
#include <study/pareto.h>
#include <study/report.h>
#include <study/results.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::study {

namespace {

/// "verdict.fits.holds"
const std::string& holds_name(const std::string& part) {
  static const std::map<std::string, std::string> names = [] {
    std::map<std::string, std::string> of_parts;
    for (const char* name : result::verdict_parts)
      of_parts[name] = "verdict." + std::string(name) + ".holds";
    return of_parts;
  }();
  return names.at(part);
}

/// The figures that rows have: of what the sweep asks for, and of `more`.
result::Metrics::Names figures_of(const Manifest& manifest,
                                  const std::vector<vp::Expression>& more) {
  std::set<std::string> names;
  const auto add = [&](const vp::Expression& expression) {
    names.insert(expression.names().begin(), expression.names().end());
  };
  for (const char* part : result::verdict_parts) names.insert(holds_name(part));
  for (const char* text : usual_objectives) add(Objective(text, manifest.name).figure());
  for (const std::string& text : manifest.objectives) add(Objective(text, manifest.name).figure());
  for (const std::string& text : manifest.constraints) add(vp::Expression(text, manifest.name));
  if (!manifest.job.empty()) add(vp::Expression(manifest.job, manifest.name));
  names.insert(manifest.metrics.begin(), manifest.metrics.end());
  for (const vp::Expression& expression : more) add(expression);
  std::set<std::string> with_bands = names;
  for (const std::string& name : names) {
    for (const std::string& end : band_of(name)) with_bands.insert(end);
  }
  return {with_bands.begin(), with_bands.end()};
}

bool has(const ResultRow& row, const std::string& name) {
  return row.metrics.find(name) || !row.value(name).empty();
}

constexpr std::string_view of_clocks = "clocks.list.", frequency = ".frequency_mhz";

bool is_of_clock(const std::string& name) {
  return name.compare(0, of_clocks.size(), of_clocks) == 0;
}

bool is_frequency(const std::string& name) {
  return name.size() > frequency.size() &&
         name.compare(name.size() - frequency.size(), frequency.size(), frequency) == 0;
}

}  // namespace

const std::string* ResultRow::parameter(const std::string& path) const {
  if (const std::string* changed = find(changes, path)) return changed;
  if (!base) return nullptr;
  const auto found = base->find(path);
  return found == base->end() ? nullptr : &found->second;
}

std::string ResultRow::value(const std::string& path) const {
  if (const std::string* text = find(swept, path)) return *text;
  if (const std::string* text = parameter(path)) return *text;
  return path == "inputs"                        ? inputs.text()
         : path == "system" || path == "program" ? program.text()
                                                 : "";
}

void Repetitions::look_at(const result::Metrics& figures) {
  results_.clear();
  clocks_.clear();
  const std::vector<std::string>& names = figures.names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_of_clock(names[i])) {
      results_.push_back(i);
    } else if (is_frequency(names[i])) {
      const std::string clock = names[i].substr(0, names[i].size() - frequency.size());
      clocks_.emplace_back(i, figures.place_of(clock + ".used"));
    }
  }
  names_ = figures;
}

std::optional<std::size_t> Repetitions::find(const result::Metrics& figures, std::size_t row) {
  if (figures.empty()) return std::nullopt;
  if (!figures.shares_names(names_)) look_at(figures);
  const std::vector<double>& all = figures.values();
  std::vector<double> values;
  values.reserve(all.size());
  for (const std::size_t place : results_) values.push_back(all[place]);
  for (const auto& [place, used] : clocks_) {
    const bool is_idle = used < all.size() && all[used] == 0;
    values.push_back(is_idle ? 0 : all[place]);
  }
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  const std::size_t hash = std::hash<std::string_view>()({bytes, values.size() * sizeof(double)});
  const auto [known, is_new] = rows_.emplace(hash, row);
  return is_new ? std::nullopt : std::optional(known->second);
}

Results::Results(const Manifest& asked) {
  if (!asked.job.empty()) job.emplace(asked.job, asked.name);
  for (const std::string& text : asked.constraints) constraints.emplace_back(text, asked.name);
}

void Results::add(const Manifest& from, Point point, Outcome outcome) {
  while (bases_.size() < from.families.size())
    bases_.push_back(std::make_shared<const std::map<std::string, std::string>>(
        from.families[bases_.size()].configuration));
  ResultRow row;
  common_.add(outcome.metrics);
  row.same_as = repetitions_.find(outcome.metrics, rows.size());
  if (selection_) outcome.metrics = selection_->of(outcome.metrics);
  static_cast<Outcome&>(row) = std::move(outcome);
  if (!rows.empty()) row.metrics.share_names(rows.back().metrics);
  row.base = bases_[point.family];
  row.program = from.families[point.family].contents.value("program", "");
  row.inputs = vp::join(from.input_sets[point.input_set].inputs, "+");
  static_cast<Point&>(row) = std::move(point);
  rows.push_back(std::move(row));
}

std::uint64_t Results::failed() const {
  return std::count_if(rows.begin(), rows.end(), [](const ResultRow& row) { return row.failed; });
}

result::Holds Results::holds(const ResultRow& row, const std::string& part) const {
  if (part == "ran" && row.failed) return result::Holds::no;
  if (part == "job" && job && !row.metrics.empty()) {
    const auto lookup = [&](const std::string& name) { return value_in(row, name); };
    return !missing_in(row, *job) && job->holds(lookup) ? result::Holds::yes : result::Holds::no;
  }
  const double* found = row.metrics.find(holds_name(part));
  if (!found || (*found > 0 && *found < 1)) return result::Holds::unknown;
  return *found == 0 ? result::Holds::no : result::Holds::yes;
}

result::Holds Results::feasible(const ResultRow& row) const {
  result::Holds worst = result::Holds::yes;
  for (const char* part : result::verdict_parts) worst = std::min(worst, holds(row, part));
  return broken(row).empty() ? worst : result::Holds::no;
}

std::vector<const vp::Expression*> Results::broken(const ResultRow& row) const {
  std::vector<const vp::Expression*> broken;
  if (row.failed) return broken;
  const auto lookup = [&](const std::string& name) { return value_in(row, name); };
  for (const vp::Expression& constraint : constraints) {
    if (missing_in(row, constraint) || !constraint.holds(lookup)) broken.push_back(&constraint);
  }
  return broken;
}

std::vector<std::string> Results::reasons(const ResultRow& row) const {
  std::vector<std::string> reasons;
  if (row.failed) reasons.push_back("failed: " + row.failure.message);
  for (const auto& [part, why] : row.complaints) {
    const bool told = part == "ran" && row.failed;
    if (!told && !(part == "job" && job)) reasons.push_back(why);
  }
  if (job && holds(row, "job") == result::Holds::no)
    reasons.push_back("not its job: " + job->text());
  for (const vp::Expression* constraint : broken(row))
    reasons.push_back("breaks " + constraint->text());
  if (reasons.empty() && feasible(row) != result::Holds::yes)
    reasons.emplace_back("without a verdict");
  return reasons;
}

result::Metrics Results::metrics_of(const ResultRow& row, Shards::Block& block) const {
  return shards_ ? shards_->metrics(row.key, block) : row.metrics;
}

std::vector<std::string> Results::metric_names() const {
  if (shards_) return names_;
  std::set<std::string> names;
  const result::Metrics* before = nullptr;
  for (const ResultRow& row : rows) {
    if (before && row.metrics.shares_names(*before)) continue;
    names.insert(row.metrics.names().begin(), row.metrics.names().end());
    before = &row.metrics;
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> Results::chosen_metrics() const {
  return manifest.metrics.empty() ? metric_names() : manifest.metrics;
}

Results read_results(std::shared_ptr<const Shards> shards, Manifest&& manifest,
                     const std::vector<vp::Expression>& more) {
  Results results(manifest);
  results.rows.reserve(manifest.points.size());
  results.selection_.emplace(figures_of(manifest, more));
  result::Metrics before;
  Shards::Block block;
  for (Point& point : manifest.points) {
    std::optional<Outcome> outcome = shards->outcome(point.key, Shards::Want::all, block);
    if (!outcome) {
      ++results.missing;
      continue;
    }
    result::Metrics& metrics = outcome->metrics;
    metrics.share_names(before);
    before = metrics;
    results.add(manifest, std::move(point), *std::move(outcome));
  }
  std::vector<Point>().swap(manifest.points);  // and its room
  results.repetitions_ = {};
  results.manifest = std::move(manifest);
  results.shards_ = std::move(shards);
  results.names_ = results.selection_->seen();
  return results;
}

void check_names(const Results& results, const vp::Expression& expression) {
  if (results.failed() == results.rows.size()) return;  // then what there would be is not known
  std::vector<std::string> known = results.metric_names();
  if (results.rows.front().base) {
    for (const auto& [path, unused] : *results.rows.front().base) known.push_back(path);
  }
  for (const std::string& name : expression.names()) {
    const auto has_it = [&](const ResultRow& row) { return has(row, name); };
    if (std::find(known.begin(), known.end(), name) != known.end() ||
        std::any_of(results.rows.begin(), results.rows.end(), has_it))
      continue;
    const std::string nearest = vp::nearest_match(name, known);
    expression.refuse(name, (result::figures().of(name) ? "no point has '" : "unknown metric '") +
                                name + "'" +
                                (nearest.empty() ? ": 'markervp metrics' lists them"
                                                 : "; did you mean '" + nearest + "'?"));
  }
}

const std::string* missing_in(const ResultRow& row, const vp::Expression& expression) {
  const auto& names = expression.names();
  const auto missing = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return !has(row, name); });
  return missing == names.end() ? nullptr : &*missing;
}

vp::ExpressionValue value_in(const ResultRow& row, const std::string& name) {
  if (const double* metric = row.metrics.find(name)) return static_cast<long double>(*metric);
  const std::string text = row.value(name);
  return value_of(kind_of({name, text, text, "", {}, ""}), text);
}

std::optional<double> figure_in(const ResultRow& row, const vp::Expression& expression) {
  if (missing_in(row, expression)) return std::nullopt;
  const vp::ExpressionValue value =
      expression.value([&](const std::string& name) { return value_in(row, name); });
  if (!value.known) return std::nullopt;
  return static_cast<double>(value.number);
}

namespace {

/// A column of numbers as texts. Many figures are those of the row before.
class NumberColumn {
 public:
  const std::string& text(double value) {
    if (std::memcmp(&value, &value_, sizeof value) != 0 || text_.empty())
      text_ = result::csv_number(value);
    value_ = value;
    return text_;
  }

 private:
  double value_ = 0;
  std::string text_;
};

/// The figures of rows, each behind a comma. What all rows share is put into words once.
class FigureFields {
 public:
  FigureFields(const std::vector<std::string>& names, const result::CommonFigures& common)
      : none_(names.size(), ','), selection_(names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::optional<double> shared = common.value(names[i]);
      end_ += ',';
      if (shared) {
        end_ += result::csv_number(*shared);
      } else {
        columns_.push_back({std::exchange(end_, {}), i, {}});
      }
    }
  }

  void append(std::string& line, const result::Metrics& figures) {
    if (figures.empty()) {
      line += none_;
      return;
    }
    const std::vector<std::size_t>& places = selection_.places_in(figures);
    for (Column& column : columns_) {
      line += column.before;
      const std::size_t place = places[column.name];
      if (place < figures.values().size()) line += column.numbers.text(figures.values()[place]);
    }
    line += end_;
  }

 private:
  struct Column {
    std::string before;  ///< shared figures, and its comma
    std::size_t name;
    NumberColumn numbers;
  };

  std::string none_;  ///< a row without figures
  std::vector<Column> columns_;
  std::string end_;  ///< behind the last column
  result::Selection selection_;
};

/// Lines of a table that are written together.
constexpr std::size_t write_bytes = 1 << 18;

}  // namespace

void write_csv(const std::string& path, const Results& results) {
  vp::OutputFile file(path);
  const std::vector<std::string> metrics = results.chosen_metrics();
  std::vector<std::string> fields{"key", "status", "message", "feasible", "same_as"};
  fields.insert(fields.end(), results.manifest.swept.begin(), results.manifest.swept.end());
  fields.insert(fields.end(), metrics.begin(), metrics.end());
  file.write(result::csv_line(fields));
  FigureFields figures(metrics, results.common());
  Shards::Block block;
  std::string lines;
  for (const ResultRow& row : results.rows) {
    fields = {row.key, row.failed ? "failed" : "done", row.failure.message,
              to_string(results.feasible(row)), row.same_as ? results.rows[*row.same_as].key : ""};
    for (const std::string& swept : results.manifest.swept) fields.push_back(row.value(swept));
    lines += result::csv_line(fields);
    lines.pop_back();
    figures.append(lines, results.metrics_of(row, block));
    lines += '\n';
    if (lines.size() < write_bytes) continue;
    file.write(lines);
    lines.clear();
  }
  file.write(lines);
  file.commit_durably();
}

std::string verdicts_text(const Results& results) {
  constexpr std::pair<const char*, const char*> parts[] = {{"ran", "did not run"},
                                                           {"job", "did not do their job"},
                                                           {"fits", "do not fit"},
                                                           {"clocks", "have impossible clocks"},
                                                           {"timing", "miss timing"}};
  const auto count = [&](const auto& wanted) {
    return std::count_if(results.rows.begin(), results.rows.end(), wanted);
  };
  using result::Holds;
  std::string text = std::to_string(count([&](const ResultRow& row) {
                       return results.feasible(row) == Holds::yes;
                     })) +
                     " of " + result::counted(results.rows.size(), "point") + " feasible";
  const auto add = [&](auto number, const std::string& what) {
    if (number != 0) text += ", " + std::to_string(number) + " " + what;
  };
  for (const auto& [part, what] : parts) {
    add(count([&, name = part](const ResultRow& row) {
          return results.holds(row, name) == Holds::no;
        }),
        what);
  }
  add(count([&](const ResultRow& row) { return results.feasible(row) == Holds::unknown; }),
      "unknown");
  add(count([&](const ResultRow& row) { return !results.broken(row).empty(); }),
      "break a constraint");
  add(count([](const ResultRow& row) { return row.same_as.has_value(); }), "the same as another");
  return text;
}

std::string repetition_text(const Results& results, const ResultRow& row) {
  if (!row.same_as) return "";
  const ResultRow& first = results.rows[*row.same_as];
  std::vector<std::string> values;
  for (const auto& [path, value] : first.swept) {
    if (row.value(path) != value.text()) values.push_back(value);
  }
  return "same as " + vp::join(values, ", ");
}

}  // namespace platform::study

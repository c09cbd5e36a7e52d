#include <study/results.h>

#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <result/figures.h>
#include <vp/file.h>

namespace platform::study {

namespace {

constexpr const char* tables = R"(
CREATE TABLE sweep(name TEXT PRIMARY KEY, value TEXT);
CREATE TABLE points(key TEXT, position INTEGER PRIMARY KEY, status TEXT, exit_code INTEGER,
                    signal INTEGER, message TEXT, program TEXT, inputs TEXT, feasible TEXT,
                    same_as TEXT, has_metrics INTEGER);
CREATE TABLE parameters(key TEXT REFERENCES points(key), path TEXT, value TEXT, number REAL,
                        PRIMARY KEY(key, path)) WITHOUT ROWID;
CREATE TABLE constants(path TEXT PRIMARY KEY, value TEXT);
CREATE TABLE metric_names(id INTEGER PRIMARY KEY, name TEXT UNIQUE, value REAL, unit TEXT,
                          better TEXT);
CREATE TABLE runs(key TEXT REFERENCES points(key), engine TEXT, host TEXT, date TEXT,
                  attempt INTEGER, wall_s REAL, cpu_s REAL);
)";

/// Values of a row of metric_values: a row for each would take ten times as long, and four times
/// the room.
constexpr std::size_t row_values = 64;

/// "v0", …
std::string value_column(std::size_t i) {
  return "v" + std::to_string(i);
}

/// The metrics that differ, `rows` rows a point, and the view of them all. The rows are numbered
/// up, so that each goes to the end of its table.
std::string metric_tables(std::size_t rows) {
  std::string columns, choice;
  for (std::size_t i = 0; i < row_values; ++i) {
    columns += ", " + value_column(i) + " REAL";
    choice += " WHEN " + std::to_string(i) + " THEN " + value_column(i);
  }
  const std::string values = std::to_string(row_values);
  return "CREATE TABLE metric_values(place INTEGER PRIMARY KEY" + columns +
         ");"
         "CREATE VIEW metrics AS"
         " SELECT key, name, value FROM metric_names JOIN points"
         " WHERE value IS NOT NULL AND has_metrics"
         " UNION ALL SELECT key, name, number FROM"
         " (SELECT key, name, CASE id % " +
         values + choice +
         " END AS number FROM metric_names JOIN points"
         " JOIN metric_values ON place = position * " +
         std::to_string(rows) + " + id / " + values +
         " WHERE metric_names.value IS NULL)"
         " WHERE number IS NOT NULL;";
}

class Database {
 public:
  explicit Database(const std::string& path) : path_(path) {
    sqlite3* opened = nullptr;
    // One thread uses it: without a lock for every value.
    const int code =
        sqlite3_open_v2(path.c_str(), &opened,
                        SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
    handle_.reset(opened);
    check(code);
  }

  void execute(const char* sql) {
    check(sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr));
  }

  void check(int code) const {
    if (code == SQLITE_OK || code == SQLITE_DONE || code == SQLITE_ROW) return;
    throw vp::OutputError("'" + path_ + "' cannot be written: " + sqlite3_errmsg(handle_.get()));
  }

  sqlite3* get() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };

  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// INSERT with the values of a row.
class Insert {
 public:
  Insert(const Database& database, const std::string& table, std::size_t columns)
      : database_(database) {
    std::string sql = "INSERT INTO " + table + " VALUES(?";
    for (std::size_t i = 1; i < columns; ++i) sql += ",?";
    sql += ")";
    sqlite3_stmt* statement = nullptr;
    database_.check(sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr));
    statement_.reset(statement);
  }

  template <class... Values>
  void row(const Values&... values) {
    (add(values), ...);
    end_row();
  }

  /// A row value by value.
  template <class Value>
  void add(const Value& value) {
    bind(++bound_, value);
  }
  void end_row() {
    bound_ = 0;
    database_.check(sqlite3_step(statement_.get()));
    database_.check(sqlite3_reset(statement_.get()));
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  void bind(int column, const std::string& text) {
    database_.check(sqlite3_bind_text(statement_.get(), column, text.data(),
                                      static_cast<int>(text.size()), SQLITE_STATIC));
  }
  void bind(int column, std::int64_t value) {
    database_.check(sqlite3_bind_int64(statement_.get(), column, value));
  }
  void bind(int column, double value) {
    database_.check(sqlite3_bind_double(statement_.get(), column, value));
  }
  void bind(int column, std::nullptr_t) {
    database_.check(sqlite3_bind_null(statement_.get(), column));
  }
  void bind(int column, const std::optional<double>& value) {
    value ? bind(column, *value) : bind(column, nullptr);
  }

  const Database& database_;
  int bound_ = 0;  ///< values of the row
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// Parameters that do not have one value everywhere, and those that are swept.
class Varying {
 public:
  explicit Varying(const Results& results)
      : paths_(results.manifest.swept.begin(), results.manifest.swept.end()) {
    for (const ResultRow& row : results.rows) compare(row, results.rows.front());
  }

  std::set<std::string> take() { return std::move(paths_); }

 private:
  using Values = std::map<std::string, std::string>;

  void compare(const ResultRow& row, const ResultRow& first) {
    for (const Assignment* changes : {&row.changes, &first.changes}) {
      for (const auto& [path, unused] : *changes) {
        const std::string* here = row.parameter(path);
        const std::string* there = first.parameter(path);
        if (!here || !there || *here != *there) paths_.insert(path);
      }
    }
    if (row.base == first.base) return;
    for (const std::string& path : differences(*row.base, first)) {
      if (find(row.changes, path) == nullptr) paths_.insert(path);
    }
  }

  /// Found once for all points of a family.
  const std::vector<std::string>& differences(const Values& base, const ResultRow& first) {
    const auto [known, is_new] = differences_.try_emplace(&base);
    if (!is_new) return known->second;
    for (const auto& [path, value] : base) {
      const std::string* there = first.parameter(path);
      if (!there || *there != value) known->second.push_back(path);
    }
    for (const auto& [path, unused] : *first.base) {
      if (base.count(path) == 0) known->second.push_back(path);
    }
    return known->second;
  }

  std::set<std::string> paths_;
  std::map<const Values*, std::vector<std::string>> differences_;
};

/// In the order of the tables' keys: a table then grows at its end only.
std::vector<std::size_t> by_key(const Results& results) {
  std::vector<std::size_t> order(results.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return results.rows[a].key < results.rows[b].key;
  });
  return order;
}

/// A parameter's values, with their numbers in base units if they have some, each found once.
class ParameterColumn {
 public:
  explicit ParameterColumn(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  std::optional<double> number(const std::string& text) {
    const auto [known, is_new] = numbers_.try_emplace(text);
    if (!is_new) return known->second;
    const ParameterKind kind = kind_of({path_, text, text, "", {}, ""});
    if (kind.kind == ParameterKind::Kind::quantity) known->second = number_of(kind, text);
    return known->second;
  }

 private:
  std::string path_;
  std::unordered_map<std::string, std::optional<double>> numbers_;
};

/// `order`: by_key().
void add_parameters(const Database& database, const Results& results,
                    const std::vector<std::size_t>& order) {
  const std::set<std::string> differing = Varying(results).take();
  std::vector<ParameterColumn> columns(differing.begin(), differing.end());
  Insert parameters(database, "parameters", 4);
  for (const std::size_t position : order) {
    const ResultRow& row = results.rows[position];
    for (ParameterColumn& column : columns) {
      const std::string text = row.value(column.path());
      if (!text.empty()) parameters.row(row.key, column.path(), text, column.number(text));
    }
  }
  Insert constants(database, "constants", 2);
  if (results.rows.empty()) return;
  const ResultRow& first = results.rows.front();
  for (const auto& [path, unused] : *first.base) {
    if (differing.count(path) == 0) constants.row(path, *first.parameter(path));
  }
}

/// `measured` says which points have metrics. The index is made at once, of sorted keys.
void add_points(Database& database, const Results& results, const std::vector<bool>& measured) {
  {
    Insert points(database, "points", 11);
    for (std::size_t position = 0; position < results.rows.size(); ++position) {
      const ResultRow& row = results.rows[position];
      points.row(row.key, static_cast<std::int64_t>(position),
                 std::string(row.failed ? "failed" : "done"),
                 std::int64_t{row.failed ? row.failure.exit_code : 0},
                 std::int64_t{row.failure.signal}, row.failure.message, row.program.text(),
                 row.inputs.text(), std::string(to_string(results.feasible(row))),
                 row.same_as ? results.rows[*row.same_as].key : "",
                 std::int64_t{measured[position] ? 1 : 0});
    }
  }
  database.execute("CREATE UNIQUE INDEX points_key ON points(key)");
}

/// "more", "less"; empty: neither, or nothing declares the metric.
std::string better_of(const std::string& metric) {
  const facts::Figure* const figure = result::figures().of(metric);
  const bool is_judged = figure && figure->better != facts::Better::neither;
  return is_judged ? facts::to_string(figure->better) : "";
}

/// Writes the metrics of all points. Returns which points have any.
std::vector<bool> add_metrics(Database& database, const Results& results) {
  const std::vector<std::string> names = results.metric_names();
  std::vector<std::optional<double>> shared;
  std::vector<std::size_t> differing;  // places in `names`, by id
  for (std::size_t i = 0; i < names.size(); ++i) {
    shared.push_back(results.common().value(names[i]));
    if (!shared[i]) differing.push_back(i);
  }
  const std::size_t rows = (differing.size() + row_values - 1) / row_values;
  database.execute(metric_tables(rows).c_str());
  Insert ids(database, "metric_names", 5);
  std::size_t id = 0, next = differing.size();
  for (std::size_t i = 0; i < names.size(); ++i)
    ids.row(static_cast<std::int64_t>(shared[i] ? next++ : id++), names[i], shared[i],
            result::unit_of_metric(names[i]), better_of(names[i]));
  Insert values(database, "metric_values", 1 + row_values);
  result::Selection selection(names);
  Shards::Block block;
  std::vector<bool> measured;
  for (std::size_t position = 0; position < results.rows.size(); ++position) {
    const result::Metrics metrics = results.metrics_of(results.rows[position], block);
    measured.push_back(!metrics.empty());
    if (metrics.empty()) continue;
    auto place = static_cast<std::int64_t>(position * rows);
    const std::vector<std::size_t>& places = selection.places_in(metrics);
    for (std::size_t first = 0; first < differing.size(); first += row_values) {
      values.add(place++);
      for (std::size_t i = first; i < first + row_values; ++i) {
        const bool has_it = i < differing.size() && places[differing[i]] < metrics.values().size();
        if (has_it) {
          values.add(metrics.values()[places[differing[i]]]);
        } else {
          values.add(nullptr);
        }
      }
      values.end_row();
    }
  }
  return measured;
}

std::string date_text(std::int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// The computations of the sweep's points; of one of which nothing is known, a row with its key.
/// `order`: by_key().
void add_runs(const Database& database, const Results& results, const Shards& shards,
              const std::vector<std::size_t>& order) {
  std::vector<bool> known(results.rows.size());
  Insert runs(database, "runs", 7);
  shards.visit([&](const Computation& run) {
    const auto row = std::lower_bound(
        order.begin(), order.end(), run.key,
        [&](std::size_t a, const std::string& key) { return results.rows[a].key < key; });
    const bool is_ours = row != order.end() && results.rows[*row].key == run.key;
    if (!is_ours || run.outcome.attempt == 0) return;
    known[*row] = true;
    runs.row(run.key, run.engine, run.host, date_text(run.outcome.date),
             std::int64_t{run.outcome.attempt}, run.outcome.wall_s, run.outcome.cpu_s);
  });
  const std::string none;
  for (const std::size_t row : order) {
    if (!known[row]) runs.row(results.rows[row].key, none, none, none, nullptr, nullptr, nullptr);
  }
}

}  // namespace

void write_database(const std::string& path, const Results& results, const Shards& shards) {
  vp::OutputFile file(path, vp::OutputFile::By::name);
  {
    Database database(file.part());
    // It appears under its name when it is whole: no journal is needed.
    database.execute(
        "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA locking_mode = EXCLUSIVE;"
        "PRAGMA page_size = 16384; PRAGMA cache_size = -65536; BEGIN");
    database.execute(tables);
    {
      Insert facts(database, "sweep", 2);
      const Manifest& manifest = results.manifest;
      facts.row(std::string("name"), manifest.name);
      facts.row(std::string("title"), manifest.title);
      facts.row(std::string("file"), manifest.source);
      facts.row(std::string("markervp"), manifest.program.dump());
    }
    add_points(database, results, add_metrics(database, results));
    const std::vector<std::size_t> order = by_key(results);
    add_parameters(database, results, order);
    add_runs(database, results, shards, order);
    database.execute("COMMIT");
  }
  file.commit();
}

}  // namespace platform::study

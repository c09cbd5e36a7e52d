#include <sweep/database.h>

#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

#include <vp/file.h>

namespace platform::sweep {

namespace {

constexpr const char* tables = R"(
CREATE TABLE sweep(name TEXT PRIMARY KEY, value TEXT);
CREATE TABLE points(key TEXT PRIMARY KEY, position INTEGER UNIQUE, status TEXT, exit_code INTEGER,
                    signal INTEGER, message TEXT, program TEXT, inputs TEXT, feasible TEXT);
CREATE TABLE parameters(key TEXT REFERENCES points, path TEXT, value TEXT, number REAL,
                        PRIMARY KEY(key, path)) WITHOUT ROWID;
CREATE TABLE constants(path TEXT PRIMARY KEY, value TEXT);
CREATE TABLE metric_names(id INTEGER PRIMARY KEY, name TEXT UNIQUE);
CREATE TABLE metric_values(position INTEGER REFERENCES points(position),
                           metric INTEGER REFERENCES metric_names, value REAL);
CREATE VIEW metrics AS SELECT key, name, value FROM metric_values
  JOIN metric_names ON metric_names.id = metric JOIN points USING(position);
CREATE TABLE runs(key TEXT REFERENCES points, engine TEXT, host TEXT, date TEXT, attempt INTEGER,
                  wall_s REAL, cpu_s REAL);
)";

/// Metrics that go into their table with one statement.
constexpr int rows_together = 16;

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

/// INSERT with the values of a row, or of some rows together: that costs less for each.
class Insert {
 public:
  /// Texts of rows that go together must live as long as it takes to give all of them.
  Insert(const Database& database, const std::string& table, int columns, int rows = 1)
      : database_(database), places_(columns * rows) {
    std::string row = "(?";
    for (int i = 1; i < columns; ++i) row += ",?";
    row += ")";
    std::string sql = "INSERT INTO " + table + " VALUES" + row;
    for (int i = 1; i < rows; ++i) sql += "," + row;
    sqlite3_stmt* statement = nullptr;
    database_.check(sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr));
    statement_.reset(statement);
  }

  template <class... Values>
  void row(const Values&... values) {
    (bind(++bound_, values), ...);
    if (bound_ < places_) return;
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
  int places_;     ///< for values
  int bound_ = 0;  ///< of them
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// Parameters that do not have one value everywhere, and those that are swept.
std::set<std::string> varying(const Results& results) {
  std::set<std::string> paths(results.manifest.swept.begin(), results.manifest.swept.end());
  if (results.rows.empty()) return paths;
  const ResultRow& first = results.rows.front();
  for (const ResultRow& row : results.rows) {
    const auto compare = [&](const std::map<std::string, std::string>& candidates) {
      for (const auto& [path, unused] : candidates) {
        const std::string* here = row.parameter(path);
        const std::string* there = first.parameter(path);
        if (!here || !there || *here != *there) paths.insert(path);
      }
    };
    compare(row.changes);
    compare(first.changes);
    if (row.base == first.base) continue;
    compare(*row.base);
    compare(*first.base);
  }
  return paths;
}

/// In the order of the tables' keys: a table then grows at its end only.
std::vector<std::size_t> by_key(const Results& results) {
  std::vector<std::size_t> order(results.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return results.rows[a].key < results.rows[b].key;
  });
  return order;
}

void add_parameters(const Database& database, const Results& results) {
  const std::set<std::string> differing = varying(results);
  Insert parameters(database, "parameters", 4);
  for (const std::size_t position : by_key(results)) {
    const ResultRow& row = results.rows[position];
    for (const std::string& path : differing) {
      const std::string text = row.value(path);
      if (text.empty()) continue;
      const ParameterKind kind = kind_of({path, text, text, "", {}, ""});
      if (kind.kind == ParameterKind::Kind::quantity) {
        parameters.row(row.key, path, text, number_of(kind, text));
      } else {
        parameters.row(row.key, path, text, nullptr);
      }
    }
  }
  Insert constants(database, "constants", 2);
  if (results.rows.empty()) return;
  const ResultRow& first = results.rows.front();
  for (const auto& [path, unused] : *first.base) {
    if (differing.count(path) == 0) constants.row(path, *first.parameter(path));
  }
}

void add_points(const Database& database, const Results& results) {
  Insert points(database, "points", 9);
  for (const std::size_t position : by_key(results)) {
    const ResultRow& row = results.rows[position];
    const std::string status = row.failed ? "failed" : "done";
    points.row(row.key, static_cast<std::int64_t>(position), status,
               std::int64_t{row.failed ? row.failure.exit_code : 0},
               std::int64_t{row.failure.signal}, row.failure.message, row.program, row.inputs,
               std::string(to_string(results.feasible(row))));
  }
}

void add_metrics(const Database& database, const Results& results) {
  const std::vector<std::string> names = results.metric_names();
  Insert ids(database, "metric_names", 2);
  for (std::size_t id = 0; id < names.size(); ++id)
    ids.row(static_cast<std::int64_t>(id), names[id]);
  Insert one(database, "metric_values", 3);
  Insert some(database, "metric_values", 3, rows_together);
  for (std::size_t position = 0; position < results.rows.size(); ++position) {
    const Metrics& metrics = results.rows[position].metrics;
    // Both are sorted.
    auto id = names.begin();
    const std::size_t count = metrics.names().size();
    for (std::size_t i = 0; i < count; ++i, ++id) {
      while (*id != metrics.names()[i]) ++id;
      Insert& values = i < count - count % rows_together ? some : one;
      values.row(static_cast<std::int64_t>(position), std::int64_t{id - names.begin()},
                 metrics.values()[i]);
    }
  }
}

void add_runs(const Database& database, const Results& results,
              const std::vector<RunEntry>& entries) {
  std::set<std::string> keys;
  for (const ResultRow& row : results.rows) keys.insert(row.key);
  Insert runs(database, "runs", 7);
  for (const RunEntry& run : entries) {
    if (keys.count(run.key) != 0)
      runs.row(run.key, run.engine, run.host, run.date, std::int64_t{run.attempt}, run.wall_s,
               run.cpu_s);
  }
}

}  // namespace

void write_database(const std::string& path, const Results& results,
                    const std::vector<RunEntry>& runs) {
  vp::OutputFile file(path, vp::OutputFile::By::name);
  {
    Database database(file.part());
    // It appears under its name when it is whole: no journal is needed.
    database.execute(
        "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA locking_mode = EXCLUSIVE;"
        "PRAGMA page_size = 16384; BEGIN");
    database.execute(tables);
    {
      Insert facts(database, "sweep", 2);
      const Manifest& manifest = results.manifest;
      facts.row(std::string("name"), manifest.name);
      facts.row(std::string("title"), manifest.title);
      facts.row(std::string("file"), manifest.source);
      facts.row(std::string("markervp"), manifest.program.dump());
    }
    add_points(database, results);
    add_metrics(database, results);
    add_parameters(database, results);
    add_runs(database, results, runs);
    database.execute("COMMIT");
  }
  file.commit();
}

}  // namespace platform::sweep

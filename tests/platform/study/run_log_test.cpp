#include <malloc.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include <result/table.h>
#include <result/verdict.h>
#include <study/report.h>
#include <study/results.h>
#include <study/run_log.h>

#include "child_process.h"
#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform::study;
namespace result = platform::result;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

/// A sweep's folder whose points were made up: numbers, each with so many figures.
class Folder : public kit::TemporaryFolder {
 public:
  Folder(int points, int figures) : store_(*this / "sweep") {
    manifest_.name = "numbers";
    manifest_.swept = {"a", "b"};
    manifest_.families.push_back({"hybrid",
                                  {{"a", "x"}, {"b", "y"}, {"c", "7 MHz"}},
                                  {{"a", "x"}, {"b", "y"}, {"c", "7 MHz"}},
                                  {{"program", "hybrid"}}});
    manifest_.input_sets.push_back({{"demo"}, {{"name", "demo"}}});
    for (int i = 0; i < points; ++i) {
      PlannedPoint point;
      point.changes = point.swept = {{"a", std::to_string(i)}, {"b", std::to_string(i % 10)}};
      point.key = key_of(manifest_.identity(point));
      manifest_.points.push_back(point);
      write(i, result(i, figures));
    }
  }

  static Json result(int number, int figures) {
    Json json;
    json["summary"]["number"] = number;
    json["summary"]["fps"]["mean"] = 100.0 + number % 37 / 7.0;
    json["power"]["total_w"]["nominal"] = 2 + std::sin(number);
    for (int i = 0; i < figures; ++i)
      json["more"]["figure_" + std::to_string(i)] = i % 4 == 0 ? number * 0.1 + i : i;
    json["verdict"]["feasible"] = "yes";
    for (const char* part : platform::result::verdict_parts)
      json["verdict"][part] = {{"holds", "yes"}};
    return json;
  }

  void write(int number, Json result) const {
    store_.write(done_record(manifest_, manifest_.points[number], std::move(result)));
  }
  void log(int number, const std::string& engine = "local") const {
    RunLog(store_, engine).add(key(number), 0.5, 0.25, 1, file(number));
  }
  void log_all() const {
    RunLog log(store_, "local");
    for (std::size_t i = 0; i < manifest_.points.size(); ++i)
      log.add(key(static_cast<int>(i)), 0.5, 0.25, 1, file(static_cast<int>(i)));
  }
  void forget_logs() const {
    std::filesystem::remove_all(store_.path("runs"));
    std::filesystem::create_directory(store_.path("runs"));
  }

  /// What the point's file says.
  Outcome file(int number) const { return outcome_of(store_.read(key(number))); }
  const std::string& key(int number) const { return manifest_.points[number].key; }
  const Store& store() const { return store_; }
  const Manifest& manifest() const { return manifest_; }
  std::shared_ptr<RunLogs> logs() const { return std::make_shared<RunLogs>(store_); }
  std::string log_file() const {
    return std::filesystem::directory_iterator(store_.path("runs"))->path().string();
  }

  /// Tables of the results as texts, but for who computed what.
  std::string tables() const {
    const auto logs = this->logs();
    const Results results = read_results(logs, Manifest(manifest_));
    const std::string csv = *this / "t.csv", database = *this / "t.sqlite";
    write_csv(csv, results);
    write_database(database, results, *logs);
    const kit::Outcome dump = kit::run_process(
        "/bin/sh",
        {"-c", "sqlite3 " + database +
                   " 'select * from metrics order by 1, 2; select * from points order by 1; "
                   "select * from parameters order by 1, 2; select * from constants'"},
        path());
    BOOST_TEST(dump.exit_code == 0, dump.err);
    return kit::read_file(csv) + dump.out;
  }

 private:
  Store store_;
  Manifest manifest_;
};

void check_equal(const Outcome& a, const Outcome& b) {
  BOOST_TEST(a.failed == b.failed);
  BOOST_TEST(a.failure.message == b.failure.message);
  BOOST_TEST((a.complaints == b.complaints));
  BOOST_TEST((a.metrics.names() == b.metrics.names()));
  BOOST_TEST((a.metrics.values() == b.metrics.values()));
}

/// Bytes of the heap that are in use.
std::size_t heap() {
  return ::mallinfo2().uordblks;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run_logs)

BOOST_AUTO_TEST_CASE(a_log_says_what_the_points_files_say) {
  const Folder folder(5, 20);
  folder.write(1, Json::parse(R"({"summary": {"other": 1.5}})"));
  folder.store().write(failed_record(folder.manifest(), folder.manifest().points[2], {3, 9, "why"},
                                     Folder::result(2, 20)));
  folder.store().write(
      failed_record(folder.manifest(), folder.manifest().points[3], {-1, 11, "crash"}));
  folder.log_all();
  const RunLogs logs(folder.store());
  for (int i = 0; i < 5; ++i) check_equal(logs.logged(folder.key(i)).value(), folder.file(i));
  BOOST_TEST(logs.logged(folder.key(4))
                 .value()
                 .metrics.shares_names(logs.logged(folder.key(0)).value().metrics),
             "points of one kind share names");
  BOOST_TEST(!logs.logged("no such point").has_value());
}

BOOST_AUTO_TEST_CASE(points_are_found_in_any_order_with_one_block) {
  constexpr int points = 400;  // some 100 kB of log, more than a block
  const Folder folder(points, 100);
  for (int log = 0; log < 2; ++log) {
    RunLog half(folder.store(), "local");
    for (int i = log; i < points; i += 2) half.add(folder.key(i), 0.5, 0.25, 1, folder.file(i));
  }
  const RunLogs logs(folder.store());
  RunLogs::Block block;
  const auto number = [&](int i) {
    return *logs.metrics(folder.key(i), block).find("summary.number");
  };
  for (int i = 0; i < points; ++i) BOOST_TEST(number(i) == i);
  for (int i = points; i-- > 0;) BOOST_TEST(number(i) == i);
  for (int i = 0; i < points; ++i) BOOST_TEST(number(i * 37 % points) == i * 37 % points);
  const auto facts = logs.logged(folder.key(3), RunLogs::Want::facts, block);
  BOOST_TEST(facts.value().metrics.empty());
  BOOST_TEST(!facts->failed);
}

BOOST_AUTO_TEST_CASE(a_file_that_was_changed_is_read_itself) {
  const Folder folder(2, 3);
  folder.log_all();
  folder.write(0, Folder::result(17, 3));
  const RunLogs logs(folder.store());
  BOOST_TEST(!logs.logged(folder.key(0)).has_value());
  BOOST_TEST(*logs.outcome(folder.key(0)).value().metrics.find("summary.number") == 17);
  kit::write_file(folder.store().point_path(folder.key(0)), "no point");
  BOOST_TEST(contains(complaint([&] { logs.outcome(folder.key(0)); }), "damaged"));
  std::filesystem::remove(folder.store().point_path(folder.key(1)));
  BOOST_TEST(!logs.outcome(folder.key(1)).has_value(), "a point that was removed is gone");
}

BOOST_AUTO_TEST_CASE(a_damaged_log_counts_up_to_the_damage) {
  const Folder folder(4, 3);
  folder.log_all();
  const std::string whole = kit::read_file(folder.log_file());
  const auto known = [&](const std::string& bytes) {
    kit::write_file(folder.log_file(), bytes);
    const RunLogs logs(folder.store());
    int count = 0;
    for (int i = 0; i < 4; ++i) count += logs.logged(folder.key(i)).has_value() ? 1 : 0;
    for (int i = 0; i < 4; ++i) check_equal(logs.outcome(folder.key(i)).value(), folder.file(i));
    return count;
  };
  BOOST_TEST(known(whole) == 4);
  BOOST_TEST(known(whole.substr(0, whole.size() - 1)) == 3);
  std::string flipped = whole;
  flipped[whole.size() - 20] = static_cast<char>(flipped[whole.size() - 20] ^ 1);
  BOOST_TEST(known(flipped) == 3);
  BOOST_TEST(known(whole + std::string(100, '\0')) == 4, "as a power failure leaves it");
  BOOST_TEST(known("markervp_runs 999 local host\n" + whole) == 0, "another version");
  BOOST_TEST(known("") == 0);
}

BOOST_AUTO_TEST_CASE(logs_grow_while_they_are_read) {
  const Folder folder(3, 3);
  folder.log(0);
  RunLogs logs(folder.store());
  folder.log(1, "slurm");
  BOOST_TEST(!logs.logged(folder.key(1)).has_value());
  logs.refresh();
  BOOST_TEST(logs.logged(folder.key(1)).has_value());
  logs.complete(folder.manifest());
  BOOST_TEST(logs.logged(folder.key(2)).has_value());
  std::map<std::string, std::string> engines;
  logs.visit([&](const RunEntry& entry) {
    engines[entry.key] = entry.engine;
    BOOST_TEST(entry.told() == (entry.key != folder.key(2)));
  });
  BOOST_TEST(engines.size() == 3u);
  BOOST_TEST(engines[folder.key(0)] == "local");
  BOOST_TEST(engines[folder.key(1)] == "slurm");
  BOOST_TEST(engines[folder.key(2)] == "", "not told");
}

BOOST_AUTO_TEST_CASE(tables_are_the_same_with_logs_and_without) {
  const Folder folder(300, 30);
  folder.write(7, Json::parse(R"({"summary": {"other": 1.5}})"));
  folder.store().write(
      failed_record(folder.manifest(), folder.manifest().points[8], {-1, 11, "crash"}));
  const std::string from_files = folder.tables();
  folder.log_all();
  BOOST_TEST((folder.tables() == from_files));
  BOOST_TEST(contains(from_files, "|more.figure_4|"));
  BOOST_TEST(contains(from_files, "|more.figure_5|5.0"), "a metric that most points share");
  BOOST_TEST(contains(from_files, "|summary.other|1.5"), "a metric of one point");
}

// More than a row of the database has room for; a point without figures lies between others.
BOOST_AUTO_TEST_CASE(each_figure_of_each_point_stands_in_both_tables) {
  const Folder folder(6, 400);
  Json negative = Folder::result(4, 400);
  negative["more"]["figure_5"] = -0.0;
  for (int i : {0, 1, 3, 5}) {
    Json zero = Folder::result(i, 400);
    zero["more"]["figure_5"] = 0.0;
    folder.write(i, zero);
  }
  folder.write(4, negative);
  folder.store().write(
      failed_record(folder.manifest(), folder.manifest().points[2], {-1, 11, "crash"}));
  folder.log_all();
  const auto logs = folder.logs();
  const Results results = read_results(logs, Manifest(folder.manifest()));
  BOOST_TEST(!results.common().value("more.figure_5"), "0 and -0 are two values");
  BOOST_TEST(results.common().value("more.figure_6").value() == 6);
  const std::string csv = folder / "t.csv", database = folder / "t.sqlite";
  write_csv(csv, results);
  write_database(database, results, *logs);
  const kit::Outcome dump =
      kit::run_process("/bin/sh",
                       {"-c", "sqlite3 -separator ' ' " + database +
                                  " 'select key, name, quote(value) from metrics'"},
                       folder.path());
  BOOST_TEST(dump.exit_code == 0, dump.err);
  std::map<std::pair<std::string, std::string>, double> stored;
  std::istringstream rows(dump.out);
  for (std::string key, name, value; rows >> key >> name >> value;)
    stored[{key, name}] = std::stod(value);
  std::string lines;
  std::size_t figures = 0;
  for (int i = 0; i < 6; ++i) {
    const result::Metrics metrics = folder.file(i).metrics;
    for (std::size_t place = 0; place < metrics.values().size(); ++place) {
      const auto found = stored.find({folder.key(i), metrics.names()[place]});
      BOOST_REQUIRE((found != stored.end() && found->second == metrics.values()[place]));
      lines += "," + result::csv_number(metrics.values()[place]);
      ++figures;
    }
    if (metrics.empty()) lines += std::string(results.metric_names().size(), ',');
    lines += '\n';
  }
  BOOST_TEST(stored.size() == figures);
  std::string texts;
  std::istringstream table(kit::read_file(csv));
  std::string line;
  for (std::getline(table, line); std::getline(table, line);) {
    const std::size_t fields = 5 + folder.manifest().swept.size();  // before the figures
    std::size_t at = 0;
    for (std::size_t field = 1; field < fields; ++field) at = line.find(',', at) + 1;
    texts += line.substr(line.find(',', at)) + '\n';
  }
  BOOST_TEST((texts == lines));
}

// Of a million points: 16 bytes for each of some 20 figures, and 600 for the rest.
BOOST_AUTO_TEST_CASE(results_take_less_than_a_kilobyte_a_point) {
  constexpr int points = 20'000, figures = 100;
  const Folder folder(points, figures);
  folder.log_all();
  const auto logs = folder.logs();
  const std::size_t before = heap();
  {
    Manifest manifest(folder.manifest());
    const std::size_t planned = heap();
    BOOST_TEST((planned - before) / points < 400u);
    const Results results = read_results(logs, std::move(manifest));
    BOOST_TEST(results.rows.size() == points);
    BOOST_TEST((heap() - before) / points < 1000u);
    RunLogs::Block block;
    BOOST_TEST(*results.metrics_of(results.rows[1234], block).find("more.figure_4") ==
               1234 * 0.1 + 4);
  }
  BOOST_TEST(static_cast<double>(std::filesystem::file_size(folder.log_file())) / points < 450);
}

BOOST_AUTO_TEST_SUITE_END()

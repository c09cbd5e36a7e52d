#include <malloc.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include <result/table.h>
#include <result/verdict.h>
#include <study/kept_result.h>
#include <study/report.h>
#include <study/results.h>
#include <study/shard.h>
#include <study/shards.h>
#include <vp/error.h>
#include <vp/file.h>

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
      Point point;
      point.changes = point.swept = {{"a", std::to_string(i)}, {"b", std::to_string(i % 10)}};
      point.key = key_of(manifest_.identity(point));
      manifest_.points.push_back(point);
      set(i, result(i, figures));
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

  void set(int number, const Json& result) {
    Outcome& outcome = outcomes_[number];
    outcome = {};
    outcome.metrics = platform::result::metrics_of(result);
    outcome.complaints = complaints_of(result);
    outcome.date = 1'000'000 + number;
    outcome.attempt = 1;
  }
  void fail(int number, const Failure& failure, const Json& result = nullptr) {
    if (result.is_null())
      outcomes_[number].metrics = {};
    else
      set(number, result);
    outcomes_[number].failed = true;
    outcomes_[number].failure = failure;
  }
  void add(int number, const std::string& engine = "local") const {
    Shard(store_, manifest_, engine).add(manifest_.points[number], outcome(number));
  }
  /// Points by turns in so many shards.
  void add_all(int shards = 1) const {
    for (int number = 0; number < shards; ++number) {
      Shard shard(store_, manifest_, "local");
      for (std::size_t i = number; i < manifest_.points.size(); i += shards)
        shard.add(manifest_.points[i], outcome(static_cast<int>(i)));
    }
  }
  void forget() const {
    std::filesystem::remove_all(store_.path("runs"));
    std::filesystem::create_directory(store_.path("runs"));
  }

  const Outcome& outcome(int number) const { return outcomes_.at(number); }
  const std::string& key(int number) const { return manifest_.points[number].key; }
  const Store& store() const { return store_; }
  const Manifest& manifest() const { return manifest_; }
  Manifest& manifest() { return manifest_; }
  std::string shard_file() const {
    return std::filesystem::directory_iterator(store_.path("runs"))->path().string();
  }

  /// Tables of the results as texts, but for who computed what.
  std::string tables() const {
    const auto shards = std::make_shared<Shards>(store_);
    const Results results = read_results(shards, Manifest(manifest_));
    const std::string csv = *this / "t.csv", database = *this / "t.sqlite";
    write_csv(csv, results);
    write_database(database, results, *shards);
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
  std::map<int, Outcome> outcomes_;
};

void check_equal(const Outcome& a, const Outcome& b) {
  BOOST_TEST(a.failed == b.failed);
  BOOST_TEST(a.failure.message == b.failure.message);
  BOOST_TEST(a.failure.signal == b.failure.signal);
  BOOST_TEST(a.date == b.date);
  BOOST_TEST(a.attempt == b.attempt);
  BOOST_TEST((a.complaints == b.complaints));
  BOOST_TEST((a.metrics.names() == b.metrics.names()));
  BOOST_TEST((a.metrics.values() == b.metrics.values()));
}

/// Bytes of the heap that are in use.
std::size_t heap() {
  return ::mallinfo2().uordblks;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(shards)

BOOST_AUTO_TEST_CASE(a_shard_says_what_was_added) {
  Folder folder(5, 20);
  folder.set(1, Json::parse(R"({"summary": {"other": 1.5}})"));
  folder.fail(2, {3, 9, "why"}, Folder::result(2, 20));
  folder.fail(3, {-1, 11, "crash"});
  folder.add_all();
  const Shards shards(folder.store());
  for (int i = 0; i < 5; ++i) check_equal(shards.outcome(folder.key(i)).value(), folder.outcome(i));
  BOOST_TEST(shards.outcome(folder.key(4))
                 .value()
                 .metrics.shares_names(shards.outcome(folder.key(0)).value().metrics),
             "points of one kind share names");
  BOOST_TEST(!shards.outcome("no such point").has_value());
  BOOST_TEST(shards.damages().empty());
}

BOOST_AUTO_TEST_CASE(a_point_can_be_asked_for_again) {
  Folder folder(2, 3);
  folder.manifest().program = {{"version", "1"}};
  folder.manifest().input = {{{"fit", "crop"}}, 7, 3};
  folder.manifest().families[0].configuration["d"] = "set";
  folder.add_all();
  const Shards shards(folder.store());
  for (int i = 0; i < 2; ++i) {
    const AskedPoint asked = shards.asked(folder.key(i)).value();
    const Setup planned = folder.manifest().setup(folder.manifest().points[i]);
    BOOST_TEST((asked.setup.settings == planned.settings));
    BOOST_TEST((asked.setup.inputs == planned.inputs));
    BOOST_TEST(asked.setup.program == "hybrid");
    BOOST_TEST((asked.setup.input.settings == planned.input.settings));
    BOOST_TEST(asked.setup.input.frames.value() == 7u);
    BOOST_TEST(asked.setup.input.repeat == 3u);
    BOOST_TEST(asked.program == folder.manifest().program);
  }
  BOOST_TEST(!shards.asked("no such point").has_value());
  std::string version;
  BOOST_TEST(shards.of_other_versions(folder.manifest().program, version) == 0u);
  BOOST_TEST(shards.of_other_versions({{"version", "2"}}, version) == 2u);
  BOOST_TEST(version == "1 ");
}

BOOST_AUTO_TEST_CASE(points_are_found_in_any_order_with_one_block) {
  constexpr int points = 400;  // some 100 kB of a shard, more than a piece of a block
  const Folder folder(points, 100);
  folder.add_all(3);
  const Shards shards(folder.store());
  Shards::Block block;
  const auto number = [&](int i) {
    return *shards.metrics(folder.key(i), block).find("summary.number");
  };
  for (int i = 0; i < points; ++i) BOOST_TEST(number(i) == i);
  for (int i = points; i-- > 0;) BOOST_TEST(number(i) == i);
  for (int i = 0; i < points; ++i) BOOST_TEST(number(i * 37 % points) == i * 37 % points);
  const auto facts = shards.outcome(folder.key(3), Shards::Want::facts, block);
  BOOST_TEST(facts.value().metrics.empty());
  BOOST_TEST(!facts->failed);
}

BOOST_AUTO_TEST_CASE(of_two_results_of_a_point_that_which_ran_counts_and_the_later_failure) {
  Folder folder(1, 3);
  const Outcome ran = folder.outcome(0);
  const auto failed_at = [&](std::int64_t date, const std::string& why) {
    folder.fail(0, {1, 0, why});
    Outcome outcome = folder.outcome(0);
    outcome.date = date;
    Shard(folder.store(), folder.manifest(), "local").add(folder.manifest().points[0], outcome);
  };
  const auto known = [&] { return Shards(folder.store()).outcome(folder.key(0)).value(); };
  failed_at(20, "later");
  failed_at(10, "earlier");
  BOOST_TEST(known().failure.message == "later");
  folder.set(0, Folder::result(0, 3));
  folder.add(0);
  check_equal(known(), ran);
  failed_at(2'000'000'000, "last");
  check_equal(known(), ran);
}

BOOST_AUTO_TEST_CASE(two_different_results_of_a_point_are_refused_with_both_names) {
  Folder folder(2, 3);
  folder.add_all();
  folder.add(0);
  BOOST_TEST(complaint([&] { Shards(folder.store()); }) == "", "equal ones are one");
  folder.set(1, Folder::result(7, 3));
  folder.add(1);
  const std::string said = complaint([&] { Shards(folder.store()); });
  BOOST_TEST(contains(said, "different results of the point " + folder.key(1)));
  const std::string number = std::to_string(::getpid());
  BOOST_TEST(contains(said, number + ".shard' have "), said);
  BOOST_TEST(contains(said, number + "-3.shard'"), said);
}

BOOST_AUTO_TEST_CASE(a_damaged_shard_counts_up_to_the_damage) {
  const Folder folder(4, 3);
  folder.add_all();
  const std::string whole = kit::read_file(folder.shard_file());
  std::size_t damages = 0;
  const auto known = [&](const std::string& bytes) {
    kit::write_file(folder.shard_file(), bytes);
    const Shards shards(folder.store());
    damages = shards.damages().size();
    int count = 0;
    for (int i = 0; i < 4; ++i) {
      if (!shards.has(folder.key(i))) continue;
      check_equal(shards.outcome(folder.key(i)).value(), folder.outcome(i));
      ++count;
    }
    return count;
  };
  BOOST_TEST(known(whole) == 4);
  BOOST_TEST(known(whole.substr(0, whole.size() - 1)) == 3, "as a kill in the midst leaves it");
  BOOST_TEST(damages == 0u);
  std::string flipped = whole;
  flipped[whole.size() - 20] = static_cast<char>(flipped[whole.size() - 20] ^ 1);
  BOOST_TEST(known(flipped) == 3);
  BOOST_TEST(damages == 1u);
  BOOST_TEST(known(whole + std::string(100, '\0')) == 4, "as a power failure leaves it");
  BOOST_TEST(known("") == 0, "as a process leaves it that was killed at once");
  BOOST_TEST(known(whole.substr(0, 20)) == 0);
  const auto said = [&](const std::string& bytes) {
    kit::write_file(folder.shard_file(), bytes);
    return complaint([&] { Shards(folder.store()); });
  };
  BOOST_TEST(contains(said("markervp_shard 999 local host {}\n"), "version 999"));
  BOOST_TEST(contains(said("my notes\n"), "is no results of a sweep"));
  BOOST_TEST(contains(said("markervp_shard 1 local host [\n"), "is no results of a sweep"));
}

BOOST_AUTO_TEST_CASE(a_shard_that_grows_too_large_is_an_error_of_the_machine_and_keeps_its_points) {
  const Folder folder(50, 3);
  const pid_t process = ::fork();
  if (process == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{3000, 3000};
    ::setrlimit(RLIMIT_FSIZE, &most);
    try {
      folder.add_all();
    } catch (const vp::OutputError& error) {
      ::_exit(contains(error.what(), "File too large") ? 0 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  BOOST_TEST(status == 0);
  const Shards shards(folder.store());
  BOOST_TEST(shards.damages().empty());
  int known = 0;
  while (shards.has(folder.key(known))) ++known;
  BOOST_TEST(known > 3);
  BOOST_TEST(known < 50);
  check_equal(shards.outcome(folder.key(known - 1)).value(), folder.outcome(known - 1));
}

// No bytes of any kind crash a reader, or become a result that was not.
BOOST_AUTO_TEST_CASE(whatever_byte_of_a_shard_changes_results_are_right_or_missing) {
  const Folder folder(3, 3);
  folder.add_all();
  const std::string whole = kit::read_file(folder.shard_file());
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    kit::write_file(folder.shard_file(), changed);
    try {
      const Shards shards(folder.store());
      for (int i = 0; i < 3; ++i) {
        if (const auto found = shards.outcome(folder.key(i)))
          BOOST_REQUIRE((found->metrics.values() == folder.outcome(i).metrics.values()));
      }
    } catch (const vp::InputError&) {
    }
  }
}

BOOST_AUTO_TEST_CASE(pipes_and_endless_files_among_shards_are_no_results_and_hold_nothing_up) {
  const Folder folder(1, 3);
  folder.add_all();
  BOOST_TEST_REQUIRE(::mkfifo(folder.store().path("runs/pipe.shard").c_str(), 0600) == 0);
  std::filesystem::create_symlink("/dev/zero", folder.store().path("runs/zero.shard"));
  const Shards shards(folder.store());
  check_equal(shards.outcome(folder.key(0)).value(), folder.outcome(0));
}

BOOST_AUTO_TEST_CASE(shards_grow_while_they_are_read) {
  const Folder folder(3, 3);
  folder.add(0);
  Shards shards(folder.store());
  folder.add(1, "slurm");
  BOOST_TEST(!shards.has(folder.key(1)));
  shards.refresh();
  BOOST_TEST(shards.has(folder.key(1)));
  std::map<std::string, std::string> engines;
  shards.visit([&](const Computation& found) { engines[found.key] = found.engine; });
  BOOST_TEST(engines.size() == 2u);
  BOOST_TEST(engines[folder.key(0)] == "local");
  BOOST_TEST(engines[folder.key(1)] == "slurm");
}

BOOST_AUTO_TEST_CASE(whole_results_without_a_shard_are_taken_over_once) {
  const Folder folder(3, 3);
  folder.add(0);
  for (int i : {0, 1, 2}) {
    const Point& point = folder.manifest().points[i];
    folder.store().keep({point.key, folder.manifest().identity(point),
                         folder.manifest().setup(point), folder.outcome(i), Folder::result(i, 3)});
  }
  kit::write_file(folder.store().kept_path(folder.key(2)), "{\"half");
  Shards shards(folder.store());
  std::vector<std::string> halves;
  const auto adopt = [&] {
    adopt_kept(folder.store(), folder.manifest(), shards, 0,
               [&](const std::string& file) { halves.push_back(file); });
  };
  adopt();
  BOOST_TEST((halves == std::vector<std::string>{folder.store().kept_path(folder.key(2))}));
  BOOST_TEST((shards.outcome(folder.key(1)).value().metrics.values() ==
              folder.outcome(1).metrics.values()));
  BOOST_TEST(shards.outcome(folder.key(1))->attempt == 0, "how it was computed is not known");
  BOOST_TEST(!shards.has(folder.key(2)));
  adopt();
  int computations = 0;
  shards.visit([&](const Computation&) { ++computations; });
  BOOST_TEST(computations == 2);
  BOOST_TEST(contains(folder.tables(), folder.key(1)));
}

BOOST_AUTO_TEST_CASE(tables_do_not_depend_on_how_many_shards_there_are) {
  Folder folder(300, 30);
  folder.set(7, Json::parse(R"({"summary": {"other": 1.5}})"));
  folder.fail(8, {-1, 11, "crash"});
  folder.add_all();
  const std::string from_one = folder.tables();
  folder.forget();
  folder.add_all(7);
  BOOST_TEST((folder.tables() == from_one));
  BOOST_TEST(contains(from_one, "|more.figure_4|"));
  BOOST_TEST(contains(from_one, "|more.figure_5|5.0"), "a metric that most points share");
  BOOST_TEST(contains(from_one, "|summary.other|1.5"), "a metric of one point");
}

// More than a row of the database has room for; a point without figures lies between others.
BOOST_AUTO_TEST_CASE(each_figure_of_each_point_stands_in_both_tables) {
  Folder folder(6, 400);
  Json negative = Folder::result(4, 400);
  negative["more"]["figure_5"] = -0.0;
  for (int i : {0, 1, 3, 5}) {
    Json zero = Folder::result(i, 400);
    zero["more"]["figure_5"] = 0.0;
    folder.set(i, zero);
  }
  folder.set(4, negative);
  folder.fail(2, {-1, 11, "crash"});
  folder.add_all();
  const auto shards = std::make_shared<Shards>(folder.store());
  const Results results = read_results(shards, Manifest(folder.manifest()));
  BOOST_TEST(!results.common().value("more.figure_5"), "0 and -0 are two values");
  BOOST_TEST(results.common().value("more.figure_6").value() == 6);
  const std::string csv = folder / "t.csv", database = folder / "t.sqlite";
  write_csv(csv, results);
  write_database(database, results, *shards);
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
    const result::Metrics& metrics = folder.outcome(i).metrics;
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
  folder.add_all();
  const auto shards = std::make_shared<Shards>(folder.store());
  const std::size_t before = heap();
  {
    Manifest manifest(folder.manifest());
    const std::size_t planned = heap();
    BOOST_TEST((planned - before) / points < 400u);
    const Results results = read_results(shards, std::move(manifest));
    BOOST_TEST(results.rows.size() == points);
    BOOST_TEST((heap() - before) / points < 1000u);
    Shards::Block block;
    BOOST_TEST(*results.metrics_of(results.rows[1234], block).find("more.figure_4") ==
               1234 * 0.1 + 4);
  }
  BOOST_TEST(static_cast<double>(std::filesystem::file_size(folder.shard_file())) / points < 450);
}

BOOST_AUTO_TEST_SUITE_END()

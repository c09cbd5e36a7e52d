// Documents that are meant to do harm: deep, endless, larger than they look. Each is refused within
// bounded memory and time, wherever a document is read.
#include <sys/stat.h>

#include <boost/test/unit_test.hpp>
#include <list>
#include <map>
#include <memory>

#include "command_line.h"

using namespace negative;

namespace {

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  text.reserve(part.size() * times);
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

/// 10 to the 20th values in less than a kilobyte.
std::string alias_bomb() {
  std::string text = "l0: &l0 [x]\n";
  for (int i = 1; i <= 20; ++i) {
    const std::string before = "*l" + std::to_string(i - 1);
    text += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " [" + before +
            repeated("," + before, 9) + "]\n";
  }
  return text;
}

constexpr const char* small_trace =
    "$timescale 1ps $end\n$scope module pl $end\n$var wire 1 ! a $end\n$upscope $end\n"
    "$enddefinitions $end\n#0\n0!\n#10\n1!\n";

/// Every option and command that reads a document, each reading `file` as its own. `folder` has the
/// document under each name that a folder of results may hold.
std::vector<Words> readers(const std::string& file, const std::string& folder) {
  return {{"config", "--config", file},
          {"config", "--set", "profile=" + file},
          {"config", "--set", "power.table=" + file},
          {"run", "--config", file, "--output", "out"},
          {"run", "--camera", file, "--output", "out"},
          {"run", "--point", file, "--output", "out"},
          {"run", "--program", file, "--output", "out"},
          {"power", file},
          {"sweep", file, "--dry-run"},
          {"compare", file, file},
          {"compare", folder, folder},
          {"report", folder},
          {"report", folder, folder},
          {"pareto", folder},
          {"sensitivity", folder},
          {"trace", "list", file},
          {"trace", "stats", file},
          {"trace", "check", file, "good.vcd"},
          {"trace", "stats", "good.vcd", "--map", file},
          {"trace", "diff", "good.vcd", file}};
}

struct Documents : CommandLine {
  Documents() { kit::write_file(*this / "good.vcd", small_trace); }

  /// Starts `markervp` with as much memory and time as a refusal may take.
  std::unique_ptr<kit::ChildProcess> begin(const Words& arguments) const {
#ifdef __SANITIZE_ADDRESS__
    const std::string memory;  // the sanitizer's own needs terabytes of addresses
#else
    const std::string memory = "ulimit -v 4000000 && ";
#endif
    Words all{"-c", memory + "exec timeout -s KILL 120 \"$0\" \"$@\"", MARKERVP_EXECUTABLE};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return std::make_unique<kit::ChildProcess>("/bin/sh", all, path());
  }

  void check_refused(kit::ChildProcess& process, const Words& arguments, const Words& parts) const {
    BOOST_TEST_CONTEXT("markervp " << vp_joined(arguments)) {
      const kit::Outcome outcome = process.wait();
      BOOST_TEST(outcome.signal == 0);
      BOOST_TEST(outcome.exit_code == 2);
      BOOST_TEST(outcome.out == "");
      check_one_line(outcome.err, parts);
      BOOST_TEST(outcome.err.size() < 5000u);
    }
  }

  void refused(const Words& arguments, const Words& parts) const {
    check_refused(*begin(arguments), arguments, parts);
  }

  /// All readers at once: a silent pipe is given up after some time.
  void refused_everywhere(const std::vector<Words>& commands) const {
    std::list<std::unique_ptr<kit::ChildProcess>> running;
    for (const Words& command : commands) running.push_back(begin(command));
    auto process = running.begin();
    for (const Words& command : commands) check_refused(**process++, command, {});
  }

  /// A folder with `text` as each file that a folder of results may have.
  void make_folder(const std::string& text) const {
    std::filesystem::create_directories(*this / "folder/points");
    for (const char* name : {"result.json", "manifest.json", "validation.json"})
      kit::write_file(*this / ("folder/" + std::string(name)), text);
  }

 private:
  static std::string vp_joined(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += word.substr(0, 100) + " ";
    return text;
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(documents, Documents)

BOOST_AUTO_TEST_CASE(hostile_documents_are_refused_by_every_reader) {
  const std::map<std::string, std::string> hostile{
      {"anchor inside itself", "camera_matrix: &a [*a]\n"},
      {"alias bomb", alias_bomb()},
      {"deep YAML", repeated("[", 100'000)},
      {"deep maps", repeated("{a: ", 100'000)},
      {"deep JSON",
       "{\"markervp_point\": " + repeated("[", 100'000) + repeated("]", 100'000) + "}"},
      {"deep result", "{\"summary\": {}, \"configuration\": " + repeated("{\"a\":", 100'000) + "1" +
                          repeated("}", 100'000) + "}"},
      {"XML", "<?xml version="},
      {"deep XML", "<?xml version=\"1.0\"?>\n<opencv_storage>" + repeated("<_>", 100'000)},
      {"zeros", std::string(1 << 20, '\0')}};
  for (const auto& [name, text] : hostile) {
    BOOST_TEST_CONTEXT(name) {
      kit::write_file(*this / "file.json", text);
      make_folder(text);
      for (const Words& command : readers("file.json", "folder")) refused(command, {});
    }
  }
}

BOOST_AUTO_TEST_CASE(endless_files_are_refused_by_every_reader) {
  std::filesystem::create_symlink("/dev/zero", *this / "zero.json");
  std::filesystem::create_directories(*this / "folder/points");
  for (const char* name : {"result.json", "manifest.json", "validation.json"})
    std::filesystem::create_symlink("/dev/zero", *this / ("folder/" + std::string(name)));
  for (const Words& command : readers("zero.json", "folder")) refused(command, {});
  std::filesystem::remove_all(*this / "folder");
  kit::write_file(*this / "hole.json", "");
  std::filesystem::resize_file(*this / "hole.json", std::uint64_t{1} << 40);
  make_folder("");
  for (const char* name : {"result.json", "manifest.json", "validation.json"})
    std::filesystem::resize_file(*this / ("folder/" + std::string(name)), std::uint64_t{1} << 40);
  for (const Words& command : readers("hole.json", "folder")) refused(command, {});
}

BOOST_AUTO_TEST_CASE(silent_pipes_are_refused_by_every_reader) {
  std::filesystem::create_directories(*this / "folder/points");
  for (const char* name :
       {"pipe.json", "folder/result.json", "folder/manifest.json", "folder/validation.json"})
    BOOST_TEST_REQUIRE(::mkfifo((*this / name).c_str(), 0600) == 0);
  refused_everywhere(readers("pipe.json", "folder"));
}

/// What another program says is as good as a file.
BOOST_AUTO_TEST_CASE(pipes_that_end_are_read) {
  const auto shell = [&](const std::string& command) {
    return kit::run_process("/bin/bash", {"-c", command, MARKERVP_EXECUTABLE}, path());
  };
  kit::Outcome outcome = shell("\"$0\" config --config <(echo 'pl.width: 320 px')");
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "width: 320 px"));
  outcome = shell("cat good.vcd | \"$0\" trace list /dev/stdin");
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  outcome = shell("\"$0\" config --config <(yes 'a: 1')");
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"larger than 4 MiB"});
}

BOOST_AUTO_TEST_CASE(expressions_are_bounded) {
  const std::string nots = repeated("not ", 300'000), sum = "a" + repeated(" + a", 300'000);
  const auto sweep = [&](const std::string& constraint) {
    kit::write_file(*this / "s.yaml",
                    "parameters: {ps.fclk_clk1.frequency: [50 MHz]}\n"
                    "constraints: [\"" +
                        constraint + "\"]\n");
    refused({"sweep", "s.yaml", "--dry-run"}, {"s.yaml"});
  };
  sweep(nots);
  sweep(nots + "unknown.name");
  sweep(sum);
  sweep(repeated("(", 300'000));
  sweep(repeated("- ", 300'000) + "1");
  const auto check = [&](const std::string& condition) {
    kit::write_file(*this / "c.checks", "one: never " + condition + "\n");
    refused({"trace", "check", "c.checks", "good.vcd"}, {"c.checks"});
  };
  check(nots);
  check(sum);
  check(repeated("(", 300'000));
  std::string edges = "a";
  for (int i = 0; i < 40; ++i) edges = "(" + edges + " rises)";
  kit::write_file(*this / "c.checks", "one: always 1\ntwo: never " + edges + "\n");
  const kit::Outcome outcome = begin({"trace", "check", "c.checks", "good.vcd"})->wait();
  BOOST_TEST(outcome.exit_code == 1, outcome.err);
  run_refuses({"--trace", "t.vcd", "--trace-trigger", "a" + repeated(" + a", 5000)},
              {"--trace-trigger", "more than 1000"});
}

BOOST_AUTO_TEST_CASE(messages_stay_short) {
  const std::string name(100'000, 'x');
  refused({"config", "--set", name + "=1"}, {"is not a key"});
  kit::write_file(*this / "c.yaml", name.substr(0, 600) + ": 1\n");
  refused({"config", "--config", "c.yaml"}, {"c.yaml:1:1", "500 characters"});
  std::string keys;
  for (int i = 0; i < 100'000; ++i) keys += "unknown_" + std::to_string(i) + ": 1\n";
  kit::write_file(*this / "c.yaml", keys);
  refused({"config", "--config", "c.yaml"}, {"unknown key", "and 99990 more"});
  refused({"trace", "plot", "good.vcd", name}, {"there is no signal"});
  refused({"config", "--set", "pl.a\x1b[2J=1"}, {"pl.a\\x1b[2J"});
}

BOOST_AUTO_TEST_SUITE_END()

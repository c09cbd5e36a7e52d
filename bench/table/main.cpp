// Runs the benchmark programs in turn, round after round, and compares them.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "../folder_in_memory.h"
#include "../images.h"
#include "programs.h"
#include "table.h"

/// libsystemc refers to it.
extern "C" int sc_main(int, char**) {
  return 1;
}

namespace {

struct Options {
  bench::ProgramOptions programs{BENCH_PROGRAMS, bench::image_names()};
  int rounds = 5;
  int long_run = 0;      ///< frames of the run whose memory is looked at; 0: none
  double slack = 0;      ///< 0: nothing is checked
  std::string document;  ///< to write the table into
};

/// A measurement that failed, or whose program is not there, is left out of the table.
class Measurement {
 public:
  explicit Measurement(const Options& options) : options_(options) {}

  void run() {
    const auto all = bench::programs(options_.programs);
    for (int i = 1; i <= options_.rounds; ++i) {
      std::cerr << "round " << i << " of " << options_.rounds << '\n';
      bench::Round& round = rounds.emplace_back();
      for (const bench::Program& program : all) measure(program, round);
    }
    if (options_.long_run != 0) measure_memory();
  }

  /// Samples that should have computed the same and did not.
  std::vector<std::string> disagreements() const {
    std::vector<std::string> names;
    for (const auto& group : bench::equal_groups(options_.programs.images)) {
      const auto differing = bench::disagreeing(rounds, group);
      names.insert(names.end(), differing.begin(), differing.end());
    }
    return names;
  }

  std::vector<bench::Round> rounds;
  std::vector<std::string> failures;

 private:
  void measure_memory() {
    for (const auto& [name, frames] :
         {std::pair{"memory_short/demo", 100}, std::pair{"memory_long/demo", options_.long_run}}) {
      std::cerr << "memory of " << frames << " frames\n";
      measure(bench::memory_run(options_.programs, name, frames), rounds.front());
    }
  }

  void measure(const bench::Program& program, bench::Round& round) {
    if (!std::filesystem::exists(program.command[0])) {
      tell_once(program.command[0] + " was not built");
      return;
    }
    const bench::FolderInMemory folder;
    const bench::ProcessResult result = bench::run_process(program.command, folder / "");
    if (!result.succeeded) {
      if (tell_once(program.name + ": " + result.message)) failures.push_back(program.name);
    } else if (program.kind == bench::Program::Kind::process) {
      round[program.name] = {result.usage.cpu_ms, {{"memory_mb", result.usage.memory_mb}}, ""};
    } else {
      std::ifstream out(folder / bench::json_file);
      const std::string json{std::istreambuf_iterator<char>(out), {}};
      for (const auto& [name, sample] : bench::read_samples(json, program.name)) {
        round[name] = sample;
      }
    }
  }

  bool tell_once(const std::string& text) {
    if (!told_.insert(text).second) return false;
    std::cerr << "left out: " << text << '\n';
    return true;
  }

  const Options& options_;
  std::set<std::string> told_;
};

/// How the RTL was built, as a sentence; empty if it was not.
std::string tools() {
  const std::string tools = BENCH_RTL_TOOLS;
  return tools.empty() ? "" : "RTL: " + tools + ".\n";
}

void write_document(const std::string& path, const bench::Table& table) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  const std::string document{std::istreambuf_iterator<char>(in), {}};
  const std::string replaced =
      bench::replace_between_markers(document, bench::markdown(table) + "\n" + tools());
  std::ofstream out(path);
  out << replaced;
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

int report(const Options& options, const Measurement& measurement) {
  const bench::Table table = bench::make_table(bench::figures(options.programs.fidelity),
                                               measurement.rounds, options.programs.images);
  std::cout << bench::plain_text(table) << tools();
  const std::vector<std::string> disagreements = measurement.disagreements();
  for (const std::string& name : disagreements) {
    std::cerr << name << ": not the same words at the same clocks as its peers\n";
  }
  if (!disagreements.empty()) return 1;
  if (!options.document.empty()) write_document(options.document, table);
  if (options.slack == 0) return 0;
  const std::vector<std::string> misses = bench::misses(table, options.slack);
  for (const std::string& miss : misses) std::cerr << "too slow: " << miss << '\n';
  return misses.empty() && measurement.failures.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{"Runs the benchmark programs in turn and compares them."};
  app.add_option("--rounds", options.rounds, "how often; medians are printed")
      ->check(CLI::Range(1, 1000));
  app.add_option("--images", options.programs.images, "to run on; bounds hold for the first")
      ->check(CLI::IsMember(bench::image_names()));
  app.add_option("--fidelity", options.programs.fidelity, "of the whole system");
  app.add_option("--memory", options.long_run, "also the memory of a run of so many frames")
      ->check(CLI::Range(100, 1'000'000));
  app.add_flag("!--no-parts", options.programs.parts, "without parts of a frame and rendering");
  app.add_option("--write", options.document, "write the table into this document");
  app.add_option(
         "--check", options.slack,
         "fail if a figure against a peer misses what it must reach, loosened by this factor")
      ->check(CLI::Range(1.0, 100.0));
  CLI11_PARSE(app, argc, argv);
  Measurement measurement(options);
  measurement.run();
  return report(options, measurement);
} catch (const std::exception& error) {
  std::cerr << "bench_table: " << error.what() << '\n';
  return 2;
}

#pragma once

#include <cli/program.h>
#include <sstream>
#include <string>
#include <vector>

#include "../../kit/simulation.h"
#include "fake_simulation.h"
#include "temporary_files.h"

namespace cli_test {

/// Runs the program as a user does, with a fake platform, in a folder of its own.
class Terminal : kit::Simulation {
 public:
  int run(std::vector<std::string> arguments) {
    out.str("");
    err.str("");
    return platform::cli::run_program(
        arguments,
        [this](const platform::cli::SimulationOptions& options) {
          asked = options;
          return std::make_unique<FakeSimulation>(behaviour);
        },
        out, err);
  }

  /// The same with `run`, and the results in `results`.
  int run_inputs(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--output", folder / "results"});
    return run(arguments);
  }

  bool has_results() const { return std::filesystem::exists(folder / "results"); }
  std::string result() const { return kit::read_file(folder / "results/result.json"); }

  kit::TemporaryFolder folder;
  FakeSimulation::Behaviour behaviour;
  platform::cli::SimulationOptions asked;
  std::ostringstream out;
  std::ostringstream err;
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// One line with the program's name, holding `part`.
inline bool is_one_line_with(const std::string& text, const std::string& part) {
  return text.rfind("markervp: ", 0) == 0 && text.find('\n') == text.size() - 1 &&
         contains(text, part);
}

}  // namespace cli_test

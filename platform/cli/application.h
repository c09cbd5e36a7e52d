#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <facts/result.h>
#include <facts/summary.h>

namespace CLI {
class App;
}
namespace platform::host {
class OutputFolder;
}

namespace platform::cli {

/// Runs a command that was parsed. Returns the exit code, and throws vp::InputError for what the
/// user got wrong. `arguments`: the command line, without the program's name.
using RunCommand = std::function<int(const std::vector<std::string>& arguments, std::ostream& out,
                                     std::ostream& err)>;

/// A command by its name.
struct Command {
  std::string name;
  RunCommand run;
};

/// An option of `run`: exit code 1 if a tally of the design's does not hold for a unit.
struct Requirement {
  const char* option;  ///< "--require-echo"
  const char* tally;   ///< facts::Tally::name
  const char* meaning;
};

/// What an application adds to the platform: commands, what it calls itself and its runs, and views
/// of its units of work. Its kinds of input, designs and metrics register themselves
/// (study::InputKindRegistration, DesignRegistration, result::UnitMetrics).
struct Application {
  const char* description = "Virtual platform of a Zynq-7000 with a design of yours.";
  const char* examples = nullptr;       ///< of runs, for --help; null: none of its own
  const char* run_help = nullptr;       ///< what INPUT is, below the help of `run`
  const char* input_command = nullptr;  ///< a command that prints the names of inputs, for shells
  /// Each adds one command to the parser, or options to one that is there, and returns what runs
  /// it.
  std::vector<Command (*)(CLI::App& parser)> commands = {};
  std::vector<Requirement> requirements = {};
  /// Lines for the summary of a run; may be null.
  std::vector<std::string> (*summary_lines)(const facts::Summary&) = nullptr;
  /// Draws a unit into a file of the folder, unless there is nothing to see; returns whether it
  /// did. May be null.
  bool (*draw)(const facts::UnitReport& unit, host::OutputFolder& folder) = nullptr;
  /// What the page shows of a unit, a JSON text; may be null.
  std::string (*page_view)(const facts::UnitReport& unit) = nullptr;
};

/// The one of this program.
const Application& application();

/// Makes it that: an object of the application, before main().
class ApplicationRegistration {
 public:
  explicit ApplicationRegistration(Application application);
};

}  // namespace platform::cli

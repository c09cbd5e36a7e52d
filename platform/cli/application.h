#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace platform::cli {

/// Runs a command that was parsed. Returns the exit code, and throws vp::InputError for what the
/// user got wrong. `arguments`: the command line, without the program's name.
using RunCommand = std::function<int(const std::vector<std::string>& arguments, std::ostream& out,
                                     std::ostream& err)>;

/// What an application adds to the platform's command line.
struct Application {
  /// Each adds one command to the parser, and returns what runs it.
  std::vector<RunCommand (*)(CLI::App& parser)> commands;
  /// Whether `markervp run WORD` has an input of this name.
  bool (*is_input)(const std::string& word) = [](const std::string&) { return false; };
};

}  // namespace platform::cli

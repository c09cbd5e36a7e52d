#pragma once

#include <memory>
#include <string>
#include <vector>

#include <cli/application.h>
#include <cli/options.h>
#include <CLI/App.hpp>

namespace platform::cli {

/// The commands and options of the program, with those of its application; parsing fills `target`,
/// which must live as long.
std::unique_ptr<CLI::App> make_app(CommandLine& target);

/// Adds --config and --set.
void add_configuration_options(CLI::App& command, ConfigurationOptions& target);

/// Adds --design.
void add_design_option(CLI::App& command, ConfigurationOptions& target);

/// Adds the inputs of a run, and what is said of them.
void add_input_options(CLI::App& command, RunOptions& target);

/// Adds `rtl` and its commands.
void add_rtl(CLI::App& app, RtlOptions& target);

/// Adds those of architecture exploration: sweep, pareto, sensitivity, compare.
void add_exploration(CLI::App& app, CommandLine& target);

/// Adds those that make a run again to ask it something: history, debug, faults.
void add_again(CLI::App& app, CommandLine& target);

/// One line on what was wrong with `arguments` (without the program's name), with the nearest match
/// of a misspelled command or option.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& arguments);

/// Adds `trace` and its commands.
void add_trace_command(CLI::App& app, TraceCommandOptions& target);

/// What a value on the command line is, for a shell that completes it.
struct ValueKind {
  enum class Kind { none, file, folder, choice, input, any };

  Kind kind = Kind::none;  ///< none: a flag
  std::vector<std::string> choices;
};

struct OptionDescription {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for what is alone
  std::string documentation;
  ValueKind value;
};

struct CommandDescription {
  std::string name;
  std::string documentation;
  std::vector<OptionDescription> options;
  ValueKind positional;  ///< none: takes none
};

/// The commands of the program as it parses them.
std::vector<CommandDescription> describe_commands(const CLI::App& app);

/// A script for bash, made from the description: it cannot fall behind the program.
std::string bash_completion(const std::vector<CommandDescription>& commands);

}  // namespace platform::cli

#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include <cli/options.h>

namespace platform::cli {

/// The commands and options of the program; parsing fills `target`, which must live as long.
std::unique_ptr<CLI::App> make_app(CommandLine& target);

/// Adds those of architecture exploration: sweep, pareto, sensitivity, compare.
void add_exploration(CLI::App& app, CommandLine& target);

/// One line on what was wrong with `arguments` (without the program's name), with the nearest match
/// of a misspelled command or option.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& arguments);

/// Adds `trace` and its commands.
void add_trace_command(CLI::App& app, TraceCommandOptions& target);

}  // namespace platform::cli

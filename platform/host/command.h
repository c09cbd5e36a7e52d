#pragma once

#include <string>
#include <vector>

namespace platform::host {

constexpr int no_such_command = 127;

struct CommandEnd {
  int exit_code = -1;  ///< no_such_command if it is not installed; -1: a signal ended it
  std::string out;     ///< what it printed, errors too
};

/// Runs a command of the host and waits for it. Ctrl-C does not reach it. Throws
/// std::system_error if the host has no process left.
CommandEnd run_command(const std::vector<std::string>& arguments);

/// A word for the shell, in quotes.
std::string shell_quoted(const std::string& text);

/// Runs gnuplot on `script`, which sets its terminal; the plot goes into `file`, whole or not at
/// all. Returns how it ended: 127 if it is not installed. Throws vp::OutputError if nothing can be
/// written there.
CommandEnd draw_with_gnuplot(const std::string& file, const std::string& script);

/// Text in single quotes for gnuplot.
std::string gnuplot_quoted(const std::string& text);

}  // namespace platform::host

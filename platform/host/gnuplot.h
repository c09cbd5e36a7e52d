#pragma once

#include <string>

#include <host/command.h>

namespace platform::host {

/// Runs gnuplot on `script`, which sets its terminal; the plot goes into `file`, whole or not at
/// all. Returns how it ended: 127 if it is not installed. Throws vp::OutputError if nothing can be
/// written there.
CommandEnd draw_with_gnuplot(const std::string& file, const std::string& script);

/// Text in single quotes for gnuplot.
std::string gnuplot_quoted(const std::string& text);

}  // namespace platform::host

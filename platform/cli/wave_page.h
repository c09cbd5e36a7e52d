#pragma once

#include <iosfwd>
#include <string>

#include <cli/options.h>

namespace platform::cli {

/// What the page's viewer shows of a trace: a JSON text with its signals and, if it has buses,
/// their transactions. The options say which trace, signals and window, and how it is read. Throws
/// vp::InputError.
std::string waves_json(const TraceCommandOptions& options, std::ostream& err);

/// The same of the trace that a run wrote. Of one that is too large for every page, or that cannot
/// be read, it says so only (`tooLarge`, `problem`); of a pipe it is empty.
std::string waves_of_run(const std::string& file);

}  // namespace platform::cli

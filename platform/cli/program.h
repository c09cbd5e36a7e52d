#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include <cli/options.h>
#include <facts/result.h>
#include <vp/configuration.h>

namespace platform::cli {

/// The whole program but main(), with what its application adds: parses `arguments` (without the
/// program's name), runs the command, writes what the user reads to `out` and one line on what went
/// wrong to `err`. Returns the exit code.
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

/// Parses the arguments of a run that was made before. Throws vp::InputError if they are none.
void parse_again(const std::vector<std::string>& arguments, CommandLine& line);

/// "0.1.0".
std::string program_version();
/// The state of the sources as git described it when the build was configured; may be empty.
std::string source_revision();
/// What --version prints.
std::string version_text();

/// Where a run's result comes from: program, command line, host, now.
facts::Provenance provenance(const RunOptions& options, const std::vector<std::string>& arguments,
                             const vp::Configuration& configuration);

}  // namespace platform::cli

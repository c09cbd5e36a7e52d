#pragma once

#include <string>
#include <vector>

#include <cli/options.h>
#include <report/result.h>
#include <vp/configuration.h>

namespace platform::cli {

/// Where a run's result comes from: program, command line, host, now.
report::Provenance provenance(const RunOptions& options, const std::vector<std::string>& arguments,
                              const vp::Configuration& configuration);

}  // namespace platform::cli

#pragma once

#include <string>
#include <vector>

namespace bench {

/// A command and its arguments.
using Command = std::vector<std::string>;

/// What a process took.
struct Usage {
  double cpu_ms = 0;     ///< of the processor, in user and kernel mode; waiting costs none
  double memory_mb = 0;  ///< most memory in use
};

/// How a process ended.
struct ProcessResult {
  bool succeeded = false;
  std::string message;  ///< the last line it said if it did not succeed
  Usage usage;
};

/// Runs a command to its end in `folder`, where it leaves its output ("stdout", "stderr"). Throws
/// std::runtime_error if it cannot be started.
ProcessResult run_process(const Command& command, const std::string& folder);

}  // namespace bench

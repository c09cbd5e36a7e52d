#pragma once

#include <string>
#include <vector>

#include "table.h"

namespace bench {

/// Where programs leave their result, in the folder in which they run. Their standard output is not
/// theirs alone.
inline constexpr const char* json_file = "result.json";

/// A command and its arguments.
using Command = std::vector<std::string>;

/// A process to measure, once a round.
struct Program {
  enum class Kind {
    benchmark,  ///< leaves Google Benchmark's JSON in json_file
    process,    ///< measured from outside, start to exit
  };

  std::string name;  ///< of its sample: "clocked/demo"
  Kind kind = Kind::benchmark;
  Command command;
};

struct ProgramOptions {
  std::string folder;               ///< with the executables
  std::vector<std::string> images;  ///< to run on
  std::string fidelity = "tlm";     ///< of the whole system
  bool parts = true;                ///< also the parts of a frame, OpenCV's FAST, rendering
};

/// What a round consists of. Peers stand next to each other, so that they see the same machine.
std::vector<Program> programs(const ProgramOptions& options);

/// A run of `frames` frames whose memory is looked at.
Program memory_run(const ProgramOptions& options, const std::string& name, int frames);

/// Groups of samples that must have computed the same.
std::vector<std::vector<std::string>> equal_groups(const std::vector<std::string>& images);

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

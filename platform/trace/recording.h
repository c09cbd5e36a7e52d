#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <trace/replay.h>
#include <vp/frame_gate.h>

namespace platform::trace {

struct RecordingOptions {
  vp::TraceFilter filter;
  std::vector<std::string> signals;  ///< as users write them; empty: all that the filter selects
  std::uint64_t from_ps = 0;
  std::uint64_t to_ps = std::numeric_limits<std::uint64_t>::max();
  std::size_t most_changes = 1'000'000;  ///< of all signals; those that change most are left out
  std::size_t most_signals = 20'000;
};

/// A window of a trace, small enough to put it into a page.
struct Recording {
  enum class Form : std::uint8_t { bit, words, real };
  struct Signal {
    std::string path;
    Form form = Form::words;
    unsigned width = 1;
    std::uint64_t count = 0;  ///< of changes
    /// For each change the ps since the one before (the first: since `from_ps`), and the value: of
    /// a bit 0, 1, 2 (x) or 3 (z), else the place in `words`. Numbers of seven bits a byte, the
    /// lowest first; of a bit one number, time · 4 + value.
    std::string changes;
    std::vector<std::string> words;  ///< values as people write them
    std::int64_t same_as = -1;       ///< place of the signal whose other name this is; -1: none
  };
  std::uint64_t from_ps = 0, to_ps = 0;
  std::vector<Signal> signals;
  std::uint64_t left_out = 0;  ///< signals for which there is no room
};

/// Appends a number to bytes as Recording::Signal has them.
void append_number(std::string& bytes, std::uint64_t number);

/// Reads the trace. Throws vp::InputError if the window has nothing of it, or the filter selects
/// nothing.
Recording recording(TraceFile& file, const RecordingOptions& options);

}  // namespace platform::trace

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <trace/statistics.h>
#include <vp/frame_gate.h>

namespace platform::trace {

/// What is in a trace.
struct Listing {
  struct Signal {
    std::string path, type;  ///< "8 bits", "real", "text", "event"
    std::string alias_of;    ///< the first name of the same values; empty: this is it
    std::uint64_t changes = 0;
    std::vector<std::string> words;  ///< that its values are called
  };
  std::string file;
  std::uint64_t timescale_fs = 0;
  bool has_times = false;  ///< else there are no values
  std::string first, last;
  std::uint64_t changes = 0;
  std::vector<Signal> signals;

  std::string text() const;
  std::vector<Table> tables() const;
};

/// Reads the whole trace. Throws vp::InputError.
Listing listing(TraceFile& file, const vp::TraceFilter& filter);

/// A time with its femtoseconds, if there are any: "1.2 ns", "1.2 ns 300 fs".
std::string exact_time(std::uint64_t ps, unsigned below_ps);

}  // namespace platform::trace

#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <trace/statistics.h>
#include <vp/frame_gate.h>

namespace platform::trace {

/// What is in a trace.
class Listing {
 public:
  /// Reads the whole trace. Throws vp::InputError.
  Listing(TraceFile& file, const vp::TraceFilter& filter);

  void write(std::ostream& out) const;
  std::string text() const;
  std::vector<Table> tables() const;
  const std::string& last() const { return last_; }

 private:
  struct Signal {
    std::string path, type;  ///< "8 bits", "real", "text", "event"
    std::string alias_of;    ///< the first name of the same values; empty: this is it
    std::uint64_t values = 0;
    std::vector<std::string> words;  ///< that its values are called
  };
  /// One after the other: there may be millions.
  void each(const std::function<void(const Signal&)>& take) const;

  const TraceFile& file_;
  vp::TraceFilter filter_;
  std::vector<std::uint32_t> first_of_net_;  ///< its first variable + 1; 0: it is not listed
  std::vector<std::uint64_t> values_of_net_;
  std::string first_, last_;  ///< times; empty: there are no values
  std::uint64_t signals_ = 0, values_ = 0;
};

/// A time with its femtoseconds, if there are any: "1.2 ns", "1.2 ns 300 fs".
std::string exact_time(std::uint64_t ps, unsigned below_ps);

}  // namespace platform::trace

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trace/trace_file.h>
#include <vp/expression.h>

namespace platform::trace {

/// One assertion of a checks file (docs/traces.md has the grammar).
struct Check {
  enum class Kind : std::uint8_t {
    always,     ///< `first` holds whenever it is known
    never,      ///< `first` does not hold
    at,         ///< when `first` comes true, `second` holds
    within,     ///< when `first` comes true, `second` holds `limit_ps` later at the latest
    stable,     ///< `first` does not change while `second` holds
    increases,  ///< `first` grows from one instant in which `second` holds to the next
    bursts      ///< `first` holds at every `limit`-th beat (`second`), and only there
  };
  Kind kind = Kind::always;
  std::string name;
  std::string text;  ///< as written
  std::uint64_t line = 0;
  vp::Expression first, second;
  std::optional<vp::Expression> restart;  ///< of `increases`: begins anew when it comes true
  std::uint64_t limit_ps = 0;
  std::uint64_t limit = 0;
  std::uint64_t clock_hz = 0;  ///< that stands above it in the file
};

/// Throws vp::InputError with the line.
std::vector<Check> read_checks(const std::string& file);

struct CheckResult {
  const Check* check = nullptr;
  bool skipped = false;  ///< the trace lacks a signal
  std::string missing;   ///< that signal
  std::uint64_t failures = 0;
  std::uint64_t first_ps = 0;   ///< of the first failure
  std::string detail;           ///< of the first failure: "4 after 7"
  std::uint64_t occasions = 0;  ///< how often there was something to check

  /// It has looked at something.
  bool exercised() const { return occasions != 0 || failures != 0; }
};

/// Judges the trace. Throws vp::InputError for a signal that it lacks, unless `skip_missing`; if
/// then nothing is left, too.
std::vector<CheckResult> run_checks(TraceFile& trace, const std::vector<Check>& checks,
                                    bool skip_missing);

}  // namespace platform::trace

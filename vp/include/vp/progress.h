#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace vp {

/// The bar as text: "points  [#####.....]  50 %  5/10  12 s left". `seconds` is the time since the
/// start; the time left follows from it, and is left out as long as nothing is done.
std::string progress_line(const std::string& label, std::uint64_t done, std::uint64_t total,
                          double seconds);

/// A progress bar on stderr for long runs: only if stderr is a terminal, nothing otherwise. Knows
/// host time only, and nothing that is simulated depends on it.
class Progress {
 public:
  /// `total` steps; `label` says of what.
  Progress(std::string label, std::uint64_t total);
  /// Clears the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` steps of the total are done. Cheap: draws a few times a second.
  void update(std::uint64_t done);
  /// Another label from here on.
  void label(std::string label) { label_ = std::move(label); }
  /// One more step is done.
  void step() { update(done_ + 1); }

 private:
  using HostClock = std::chrono::steady_clock;

  std::string label_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool terminal_;
  bool drawn_ = false;
  HostClock::time_point start_;
  HostClock::time_point next_draw_;
};

}  // namespace vp

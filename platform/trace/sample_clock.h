#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <trace/replay.h>

namespace platform::trace {

/// Counts the edges of a clock up to now: of its wire, if it is in the trace, else of a frequency:
/// edge n falls at round(n · 10¹² / f) ps, as everywhere in the platform.
class SampleClock {
 public:
  /// `hertz` counts only if the trace has no wire called `path`.
  SampleClock(Replay& replay, TraceFile& file, const std::string& path, std::uint64_t hertz)
      : replay_(replay), hertz_(hertz) {
    const int variable = file.find(path);
    if (variable >= 0) wire_ = replay.watch(static_cast<std::uint32_t>(variable));
  }

  bool has_wire() const { return wire_.has_value(); }
  std::uint64_t hertz() const { return hertz_; }

  /// In every instant, before edges().
  void instant(std::uint64_t ps) {
    if (!wire_) {
      // The last n with n · 10¹² / f < ps + 1/2.
      constexpr unsigned __int128 twice = 2'000'000'000'000;
      const auto scaled = (static_cast<unsigned __int128>(ps) * 2 + 1) * hertz_;
      edges_ = static_cast<std::uint64_t>((scaled + twice - 1) / twice) - (hertz_ != 0 ? 1 : 0);
      return;
    }
    const bool high = replay_.known(*wire_) && replay_.bits(*wire_) != 0;
    const bool was_high = replay_.was_known(*wire_) && replay_.bits_before(*wire_) != 0;
    edges_ += high && !was_high && replay_.was_known(*wire_);
    if (high && !was_high) last_edge_ps_ = ps;
    on_edge_ = last_edge_ps_ == ps;
  }
  std::uint64_t edges() const { return edges_; }

  /// True if an edge falls on `ps`, the present instant.
  bool falls_on(std::uint64_t ps) const {
    if (wire_) return on_edge_;
    constexpr unsigned __int128 second = 1'000'000'000'000;
    const auto place = (static_cast<unsigned __int128>(edges_) * second + hertz_ / 2) / hertz_;
    return static_cast<std::uint64_t>(place) == ps;
  }

 private:
  Replay& replay_;
  std::optional<Replay::Slot> wire_;
  std::uint64_t hertz_;
  std::uint64_t edges_ = 0;
  std::uint64_t last_edge_ps_ = ~std::uint64_t{0};
  bool on_edge_ = false;
};

}  // namespace platform::trace

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <trace/replay.h>
#include <trace/statistics.h>

namespace platform::trace {

/// How well the changes of a link follow one clock.
struct ClockFit {
  std::uint64_t on_edge = 0;              ///< changes that fall on an edge, up or down
  std::optional<std::uint64_t> delay_ps;  ///< of the first that does not, after an edge
  std::uint64_t with_delay = 0;           ///< changes that come as long after an edge

  /// A change in the present instant.
  void note(const SampleClock& clock, std::uint64_t ps);
  std::uint64_t explained() const { return on_edge + with_delay; }
  /// A change on an edge says more than one with a delay, which every faster clock explains.
  std::uint64_t weight() const { return std::max(2 * on_edge, with_delay); }
  /// Nearly all of the changes follow the clock: 95 %.
  bool fits(std::uint64_t changes) const {
    constexpr std::uint64_t one_in = 20;
    return (changes - explained()) * one_in <= changes;
  }
};

/// The clocks that the links of a trace may be sampled on.
class ClockSet {
 public:
  /// `options` must outlive it.
  ClockSet(Replay& replay, const TraceFile& file, const StatisticsOptions& options);

  /// The place of the clock on this wire, which is followed.
  std::size_t of(std::uint32_t variable, bool falling);
  /// The places of the clocks that a link may be sampled on, the likeliest first: the one that the
  /// user named, or up to four wires called clk or clock, nearest by scope and name, and behind
  /// them the assumed clock. `names`: of the link, the first without its channel.
  std::vector<std::size_t> candidates(const std::vector<std::string>& names);
  /// Which of a link's candidates it follows. `fits` is the link's own, by candidate; `weight` by
  /// place, of all links of the same interface.
  std::size_t best(const std::vector<std::size_t>& candidates, const std::vector<ClockFit>& fits,
                   const std::map<std::size_t, std::uint64_t>& weight, std::uint64_t changes) const;

  /// In every instant, before the clocks are asked.
  void instant(std::uint64_t ps) {
    for (SampleClock& clock : clocks_) clock.instant(ps);
  }
  const SampleClock& operator[](std::size_t place) const { return clocks_[place]; }
  /// The wire's variable, and whether its falling edges count; none: assumed.
  std::optional<std::pair<std::uint32_t, bool>> wire(std::size_t place) const {
    return wire_of_[place];
  }
  /// The place of the clock with the frequency of the options, for a trace without the wire.
  std::size_t assumed();
  /// Its signal and edge, or its frequency.
  std::string text(std::size_t place) const;

 private:
  std::optional<std::size_t> named(const std::vector<std::string>& names);

  Replay& replay_;
  const TraceFile& file_;
  const StatisticsOptions& options_;
  std::vector<std::uint32_t> wires_;  ///< variables that may be clocks
  std::vector<SampleClock> clocks_;
  std::vector<std::optional<std::pair<std::uint32_t, bool>>> wire_of_;  ///< by place
};

/// How near a clock is to a link: levels that both are in, then letters that their names share.
std::pair<std::size_t, std::size_t> nearness(std::string_view link, std::string_view clock);
/// A bit that is called a clock, and not the reset of one.
bool may_be_clock(std::string_view path, const vp::WaveVariable& variable);

/// What is behind the last '.'.
std::string_view leaf_of(std::string_view path);
/// "pl.filter" of "pl.filter.sum"; empty without a level.
std::string_view scope_of(std::string_view path);

}  // namespace platform::trace

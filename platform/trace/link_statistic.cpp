#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include <trace/clock_choice.h>
#include <trace/statistics.h>
#include <vp/error.h>
#include <vp/text.h>

// Handshakes, counted on clock edges that are never looked at one by one: between two changes all
// edges see the same.

namespace platform::trace {

namespace {

constexpr double bytes_per_megabyte = 1e6;

/// What the edges of one clock saw of a link.
struct LinkCount {
  std::uint64_t beats = 0, packets = 0, stalls = 0, starved = 0;
  std::map<std::uint64_t, std::uint64_t> waits;   ///< edges before a beat: beats
  std::map<std::uint64_t, std::uint64_t> bursts;  ///< beats up to and with TLAST: bursts
  std::uint64_t waiting = 0, in_burst = 0;
  std::uint64_t longest = 0, longest_ps = 0;
  std::uint64_t first_beat = 0, last_beat = 0;  ///< numbers of edges
  std::uint64_t edges = 0;                      ///< at the last look
};

struct Link {
  std::string name;
  std::string interface;  ///< the same for the five channels of AXI
  Replay::Slot valid, ready;
  std::optional<Replay::Slot> data, last;
  unsigned bytes = 4;  ///< a beat

  std::vector<std::size_t> clocks;  ///< that may be its own, the likeliest first
  std::vector<LinkCount> counts;    ///< by clock
  std::vector<ClockFit> fits;       ///< by clock
  std::size_t best = 0;             ///< of both
  std::uint64_t wait_began_ps = 0;
  bool waits = false;
  std::uint64_t changes = 0;
};

class LinkStatistic final : public Statistic {
 public:
  LinkStatistic(Replay& replay, TraceFile& file, const StatisticsOptions& options)
      : replay_(replay), file_(file), clocks_(replay, file, options) {
    for (std::size_t i = 0; i < file.paths().size(); ++i) add_link(static_cast<std::uint32_t>(i));
    for (Link& link : links_) {
      link.clocks = clocks_.candidates({link.interface, link.name});
      link.counts.resize(link.clocks.size());
      link.fits.resize(link.clocks.size());
    }
  }
  bool found() const override { return !links_.empty(); }

  void instant(std::uint64_t ps) override {
    clocks_.instant(ps);
    bool any = !started_;
    for (const Replay::Slot slot : replay_.changed()) {
      if (slot < belongs_.size() && belongs_[slot]) any = true;
    }
    if (any) sample(ps);
  }
  void finish(std::uint64_t ps) override {
    sample(ps);
    choose_clocks();
    const bool none =
        std::all_of(links_.begin(), links_.end(), [](const Link& link) { return !fits(link); });
    if (none) refuse(links_.front());
  }
  void report(std::vector<Table>& tables) const override;

 private:
  void add_link(std::uint32_t variable);
  void choose_clocks();
  Replay::Slot follow(std::int64_t variable) {
    const Replay::Slot slot = replay_.watch(static_cast<std::uint32_t>(variable));
    if (slot >= belongs_.size()) belongs_.resize(slot + 1, 0);
    belongs_[slot] = 1;
    return slot;
  }

  /// The edges since the last look saw what stood before this instant.
  void sample(std::uint64_t ps) {
    for (Link& link : links_) {
      const bool known = replay_.was_known(link.valid) && replay_.was_known(link.ready);
      for (std::size_t i = 0; i < link.clocks.size(); ++i) {
        LinkCount& counted = link.counts[i];
        const std::uint64_t now = clocks_[link.clocks[i]].edges();
        const std::uint64_t edges = started_ ? now - counted.edges : 0;
        counted.edges = now;
        if (edges != 0 && known) count(link, counted, edges);
      }
      if (started_) note_changes(link, ps);
    }
    started_ = true;
  }
  void count(Link& link, LinkCount& counted, std::uint64_t edges);
  void note_changes(Link& link, std::uint64_t ps);

  /// Nearly all of its changes follow the clock that it was counted on.
  static bool fits(const Link& link) { return link.fits[link.best].fits(link.changes); }
  const SampleClock& clock(const Link& link) const { return clocks_[link.clocks[link.best]]; }
  std::string clock_text(const Link& link) const { return clocks_.text(link.clocks[link.best]); }
  [[noreturn]] void refuse(const Link& link) const;

  Replay& replay_;
  TraceFile& file_;
  ClockSet clocks_;
  std::vector<Link> links_;
  std::vector<char> belongs_;  ///< by slot
  bool started_ = false;
};

void LinkStatistic::add_link(std::uint32_t variable) {
  const std::string& path = file_.paths()[variable];
  const bool capitals = vp::ends_with(path, "VALID");
  if (!capitals && !vp::ends_with(path, "valid")) return;
  constexpr std::size_t word = 5;
  const std::string stem = path.substr(0, path.size() - word);
  const auto part = [&](const char* name) {
    return file_.find(stem + (capitals ? name : vp::lower(name)));
  };
  const std::int64_t ready = part("READY");
  if (ready < 0) return;
  Link link;
  const std::string_view leaf = leaf_of(stem);
  // A stream that has a scope to itself is called after it.
  link.name = vp::lower(leaf) == "t" && leaf.size() < stem.size() ? stem.substr(0, stem.size() - 2)
              : vp::ends_with(vp::lower(leaf), "_t")              ? stem.substr(0, stem.size() - 2)
                                                                  : stem;
  link.interface = link.name;
  const std::string small = vp::lower(leaf);
  for (const char* channel : {"aw", "ar", "w", "b", "r"}) {
    if (!vp::ends_with(small, channel)) continue;
    link.interface = stem.substr(0, stem.size() - std::string_view(channel).size());
    while (vp::ends_with(link.interface, "_") || vp::ends_with(link.interface, "."))
      link.interface.pop_back();
    break;
  }
  link.valid = follow(variable);
  link.ready = follow(ready);
  if (const std::int64_t last = part("LAST"); last >= 0) link.last = follow(last);
  if (const std::int64_t data = part("DATA"); data >= 0) {
    link.data = follow(data);
    link.bytes = (file_.variable(static_cast<std::uint32_t>(data)).width + 7) / 8;
  }
  links_.push_back(std::move(link));
}

void LinkStatistic::count(Link& link, LinkCount& counted, std::uint64_t edges) {
  const bool valid = replay_.bits_before(link.valid) != 0;
  const bool ready = replay_.bits_before(link.ready) != 0;
  if (!valid) {
    counted.starved += ready ? edges : 0;
    return;
  }
  if (!ready) {
    counted.stalls += edges;
    counted.waiting += edges;
    if (counted.waiting > counted.longest) {
      counted.longest = counted.waiting;
      counted.longest_ps = link.wait_began_ps;
    }
    return;
  }
  if (counted.beats == 0) counted.first_beat = counted.edges - edges;
  counted.beats += edges;
  counted.last_beat = counted.edges;
  ++counted.waits[counted.waiting];
  if (edges > 1) counted.waits[0] += edges - 1;
  counted.waiting = 0;
  counted.in_burst += edges;
  if (!link.last || !replay_.was_known(*link.last) || replay_.bits_before(*link.last) == 0) return;
  // TLAST stood at each of these edges: every beat after the first is a burst of its own.
  counted.packets += edges;
  ++counted.bursts[counted.in_burst - (edges - 1)];
  if (edges > 1) counted.bursts[1] += edges - 1;
  counted.in_burst = 0;
}

void LinkStatistic::note_changes(Link& link, std::uint64_t ps) {
  const auto changed = [&](Replay::Slot slot) {
    return replay_.known(slot) && replay_.was_known(slot) &&
           replay_.bits(slot) != replay_.bits_before(slot);
  };
  if (!changed(link.valid) && !changed(link.ready)) return;
  ++link.changes;
  for (std::size_t i = 0; i < link.clocks.size(); ++i)
    link.fits[i].note(clocks_[link.clocks[i]], ps);
  const bool waits = replay_.bits(link.valid) != 0 && replay_.bits(link.ready) == 0;
  if (waits && !link.waits) link.wait_began_ps = ps;
  link.waits = waits;
}

/// The clock of an interface explains most changes of all its channels; of several the nearest.
void LinkStatistic::choose_clocks() {
  for (Link& link : links_) {
    std::map<std::size_t, std::uint64_t> weight;
    for (const Link& other : links_) {
      if (other.interface != link.interface) continue;
      for (std::size_t i = 0; i < other.clocks.size(); ++i)
        weight[other.clocks[i]] += other.fits[i].weight();
    }
    link.best = clocks_.best(link.clocks, link.fits, weight, link.changes);
  }
}

void LinkStatistic::refuse(const Link& link) const {
  throw vp::InputError("trace '" + file_.name() +
                       "': " + std::to_string(link.changes - link.fits[link.best].explained()) +
                       " of " + std::to_string(link.changes) + " changes of " + link.name +
                       (clock(link).has_wire()
                            ? " do not follow the clock " + clock_text(link)
                            : " do not fall on an edge of a clock of " + clock_text(link)) +
                       ": give the right one with --clock, or trace it (--trace-clocks)");
}

void LinkStatistic::report(std::vector<Table>& tables) const {
  const bool wires = std::all_of(links_.begin(), links_.end(),
                                 [&](const Link& link) { return clock(link).has_wire(); });
  Table links{
      "links",
      wires ? "Links" : "Links (clock assumed, see --clock)",
      {"link", "beats", "packets", "stalls", "starved", "mean_wait_cycles", "longest_stall_cycles",
       "longest_stall_at_us", "mb_per_s", "of_peak_percent", "clock", "interface"},
      {},
      false};
  Table left_out{"links_left_out",
                 "Links left out: name their clock with --clock LINK=SIGNAL",
                 {"link", "changes", "beside_the_clock", "clock"},
                 {},
                 false};
  Table waits{"waits", "Cycles that a beat waited", {"link", "wait_cycles", "beats"}, {}, true};
  Table bursts{"bursts", "Bursts by length", {"link", "beats", "bursts"}, {}, false};
  for (const Link& link : links_) {
    const LinkCount& counted = link.counts[link.best];
    if (!fits(link)) {
      left_out.rows.push_back({link.name, link.changes,
                               link.changes - link.fits[link.best].explained(), clock_text(link)});
      continue;
    }
    const double period_s = clock(link).period_s();
    const double span_s = static_cast<double>(counted.last_beat - counted.first_beat) * period_s;
    const double rate =
        static_cast<double>(counted.beats * link.bytes) / span_s / bytes_per_megabyte;
    const double peak = static_cast<double>(link.bytes) / period_s / bytes_per_megabyte;
    const bool any = counted.beats != 0 && period_s > 0;
    const double mean = counted.beats == 0 ? 0
                                           : static_cast<double>(counted.stalls) /
                                                 static_cast<double>(counted.beats);
    links.rows.push_back({link.name, counted.beats, counted.packets, counted.stalls,
                          counted.starved, mean, counted.longest,
                          static_cast<double>(counted.longest_ps) / ps_per_us, any ? rate : 0,
                          any ? 100 * rate / peak : 0, clock_text(link), link.interface});
    for (const auto& [cycles, beats] : counted.waits)
      waits.rows.push_back({link.name, cycles, beats});
    for (const auto& [beats, n] : counted.bursts) bursts.rows.push_back({link.name, beats, n});
  }
  tables.push_back(std::move(links));
  tables.push_back(std::move(left_out));
  tables.push_back(std::move(bursts));
  tables.push_back(std::move(waits));
}

}  // namespace

std::unique_ptr<Statistic> link_statistic(Replay& replay, TraceFile& file,
                                          const StatisticsOptions& options) {
  return std::make_unique<LinkStatistic>(replay, file, options);
}

}  // namespace platform::trace

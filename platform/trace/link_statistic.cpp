// Handshakes, counted on clock edges that are never looked at one by one: between two changes all
// edges see the same.
#include <trace/statistics.h>

#include <map>
#include <optional>

#include <vp/error.h>
#include <vp/unit.h>

namespace platform::trace {

namespace {

constexpr double bytes_per_megabyte = 1e6;

struct Link {
  std::string name;
  Replay::Slot valid, ready;
  std::optional<Replay::Slot> data, last;
  unsigned bytes = 4;  ///< a beat

  std::uint64_t beats = 0, packets = 0, stalls = 0, starved = 0, edges = 0;
  std::map<std::uint64_t, std::uint64_t> waits;   ///< edges before a beat: beats
  std::map<std::uint64_t, std::uint64_t> bursts;  ///< beats up to and with TLAST: bursts
  std::uint64_t waiting = 0, in_burst = 0;
  std::uint64_t longest = 0, longest_ps = 0, wait_began_ps = 0;
  std::uint64_t first_beat_ps = 0, last_beat_ps = 0;
  std::uint64_t changes = 0, off_edge = 0;
};

class LinkStatistic final : public Statistic {
 public:
  LinkStatistic(Replay& replay, TraceFile& file, const StatisticsOptions& options)
      : replay_(replay), file_(file), clock_(replay, file, "ps.fclk_clk0.clk", options.system_hz) {
    for (std::size_t i = 0; i < file.paths().size(); ++i) add_link(static_cast<std::uint32_t>(i));
  }
  bool found() const override { return !links_.empty(); }

  void instant(std::uint64_t ps) override {
    clock_.instant(ps);
    bool any = !started_;
    for (const Replay::Slot slot : replay_.changed()) {
      if (slot < belongs_.size() && belongs_[slot]) any = true;
    }
    if (any) sample(ps);
  }
  void finish(std::uint64_t ps) override {
    sample(ps);
    for (const Link& link : links_) check_clock(link);
  }
  void report(std::vector<Table>& tables) const override;

 private:
  void add_link(std::uint32_t variable) {
    const std::string& path = file_.paths()[variable];
    const std::string word = "valid";
    if (path.size() <= word.size() ||
        path.compare(path.size() - word.size(), word.size(), word) != 0) {
      return;
    }
    const std::string stem = path.substr(0, path.size() - word.size());
    const int ready = file_.find(stem + "ready");
    if (ready < 0) return;
    Link link;
    const std::size_t dot = path.rfind('.');
    link.name = stem.back() == 't' && dot != std::string::npos ? path.substr(0, dot) : stem;
    link.valid = follow(static_cast<int>(variable));
    link.ready = follow(ready);
    if (const int last = file_.find(stem + "last"); last >= 0) link.last = follow(last);
    if (const int data = file_.find(stem + "data"); data >= 0) {
      link.data = follow(data);
      link.bytes = (file_.variable(static_cast<std::uint32_t>(data)).width + 7) / 8;
    }
    links_.push_back(std::move(link));
  }
  Replay::Slot follow(int variable) {
    const Replay::Slot slot = replay_.watch(static_cast<std::uint32_t>(variable));
    if (slot >= belongs_.size()) belongs_.resize(slot + 1, 0);
    belongs_[slot] = 1;
    return slot;
  }

  /// The edges since the last look saw what stood before this instant.
  void sample(std::uint64_t ps) {
    const std::uint64_t edges = clock_.edges() - (started_ ? edges_ : clock_.edges());
    for (Link& link : links_) {
      const bool known = replay_.was_known(link.valid) && replay_.was_known(link.ready);
      if (edges != 0 && known) count(link, edges, ps);
      if (started_) note_changes(link, ps);
    }
    started_ = true;
    edges_ = clock_.edges();
  }
  void count(Link& link, std::uint64_t edges, std::uint64_t ps);
  void note_changes(Link& link, std::uint64_t ps);
  void check_clock(const Link& link) const;

  Replay& replay_;
  TraceFile& file_;
  SampleClock clock_;
  std::vector<Link> links_;
  std::vector<char> belongs_;  ///< by slot
  bool started_ = false;
  std::uint64_t edges_ = 0;
};

void LinkStatistic::count(Link& link, std::uint64_t edges, std::uint64_t ps) {
  const bool valid = replay_.bits_before(link.valid) != 0;
  const bool ready = replay_.bits_before(link.ready) != 0;
  link.edges += edges;
  if (!valid) {
    link.starved += ready ? edges : 0;
    return;
  }
  if (!ready) {
    link.stalls += edges;
    link.waiting += edges;
    if (link.waiting > link.longest) {
      link.longest = link.waiting;
      link.longest_ps = link.wait_began_ps;
    }
    return;
  }
  if (link.beats == 0) link.first_beat_ps = ps;
  link.beats += edges;
  link.last_beat_ps = ps;
  ++link.waits[link.waiting];
  if (edges > 1) link.waits[0] += edges - 1;
  link.waiting = 0;
  link.in_burst += edges;
  if (!link.last || !replay_.was_known(*link.last) || replay_.bits_before(*link.last) == 0) return;
  // TLAST stood at each of these edges: every beat after the first is a burst of its own.
  link.packets += edges;
  ++link.bursts[link.in_burst - (edges - 1)];
  if (edges > 1) link.bursts[1] += edges - 1;
  link.in_burst = 0;
}

void LinkStatistic::note_changes(Link& link, std::uint64_t ps) {
  const auto changed = [&](Replay::Slot slot) {
    return replay_.known(slot) && replay_.was_known(slot) &&
           replay_.bits(slot) != replay_.bits_before(slot);
  };
  if (!changed(link.valid) && !changed(link.ready)) return;
  ++link.changes;
  link.off_edge += !clock_.falls_on(ps);
  const bool waits = replay_.bits(link.valid) != 0 && replay_.bits(link.ready) == 0;
  if (waits && link.waiting == 0) link.wait_began_ps = ps;
}

void LinkStatistic::check_clock(const Link& link) const {
  constexpr std::uint64_t one_in = 20;
  if (link.off_edge * one_in <= link.changes) return;
  throw vp::InputError("trace '" + file_.name() + "': " + std::to_string(link.off_edge) + " of " +
                       std::to_string(link.changes) + " changes of " + link.name +
                       " do not fall on an edge of a clock of " +
                       vp::format_quantity(vp::Decimal(clock_.hertz(), 0), vp::Unit::frequency) +
                       ": give the right one with --clock, or trace it (--trace-clocks)");
}

void LinkStatistic::report(std::vector<Table>& tables) const {
  Table links{"links",
              clock_.has_wire() ? "Links" : "Links (clock assumed, see --clock)",
              {"link", "beats", "packets", "stalls", "starved", "mean_wait_cycles",
               "longest_stall_cycles", "longest_stall_at_us", "mb_per_s", "of_peak_percent"},
              {},
              false};
  Table waits{"waits", "Cycles that a beat waited", {"link", "wait_cycles", "beats"}, {}, true};
  Table bursts{"bursts", "Bursts by length", {"link", "beats", "bursts"}, {}, false};
  for (const Link& link : links_) {
    const double span_s = static_cast<double>(link.last_beat_ps - link.first_beat_ps) / ps_per_s +
                          1.0 / static_cast<double>(clock_.hertz());
    const double rate = static_cast<double>(link.beats * link.bytes) / span_s / bytes_per_megabyte;
    const double peak =
        static_cast<double>(link.bytes) * static_cast<double>(clock_.hertz()) / bytes_per_megabyte;
    const double mean =
        link.beats == 0 ? 0 : static_cast<double>(link.stalls) / static_cast<double>(link.beats);
    links.rows.push_back({link.name, link.beats, link.packets, link.stalls, link.starved, mean,
                          link.longest, static_cast<double>(link.longest_ps) / ps_per_us,
                          link.beats == 0 ? 0 : rate, link.beats == 0 ? 0 : 100 * rate / peak});
    for (const auto& [cycles, beats] : link.waits) waits.rows.push_back({link.name, cycles, beats});
    for (const auto& [beats, n] : link.bursts) bursts.rows.push_back({link.name, beats, n});
  }
  tables.push_back(std::move(links));
  tables.push_back(std::move(bursts));
  tables.push_back(std::move(waits));
}

}  // namespace

std::unique_ptr<Statistic> link_statistic(Replay& replay, TraceFile& file,
                                          const StatisticsOptions& options) {
  return std::make_unique<LinkStatistic>(replay, file, options);
}

}  // namespace platform::trace

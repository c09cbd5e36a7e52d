#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include <trace/statistics.h>
#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/unit.h>

// Handshakes, counted on clock edges that are never looked at one by one: between two changes all
// edges see the same.

namespace platform::trace {

namespace {

constexpr double bytes_per_megabyte = 1e6;

/// The most clocks that a link is counted on at a time, until their edges tell which is its own.
constexpr std::size_t most_clocks = 4;

/// What the edges of one clock saw of a link.
struct LinkCount {
  std::uint64_t beats = 0, packets = 0, stalls = 0, starved = 0;
  std::map<std::uint64_t, std::uint64_t> waits;   ///< edges before a beat: beats
  std::map<std::uint64_t, std::uint64_t> bursts;  ///< beats up to and with TLAST: bursts
  std::uint64_t waiting = 0, in_burst = 0;
  std::uint64_t longest = 0, longest_ps = 0;
  std::uint64_t first_beat = 0, last_beat = 0;  ///< numbers of edges
  std::uint64_t on_edge = 0;                    ///< changes that fall on an edge, up or down
  std::optional<std::uint64_t> delay_ps;        ///< of the first that does not, after an edge
  std::uint64_t with_delay = 0;                 ///< changes that come as long after an edge
  std::uint64_t edges = 0;                      ///< at the last look

  std::uint64_t explained() const { return std::max(on_edge, with_delay); }
  /// A change on an edge says more than one with a delay, which every faster clock explains.
  std::uint64_t weight() const { return std::max(2 * on_edge, with_delay); }
};

struct Link {
  std::string name;
  std::string interface;  ///< the same for the five channels of AXI
  Replay::Slot valid, ready;
  std::optional<Replay::Slot> data, last;
  unsigned bytes = 4;  ///< a beat

  std::vector<std::size_t> clocks;  ///< that may be its own, the likeliest first
  std::vector<LinkCount> counts;    ///< by clock
  std::size_t best = 0;             ///< of both
  std::uint64_t wait_began_ps = 0;
  bool waits = false;
  std::uint64_t changes = 0;
};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return result;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string_view leaf_of(std::string_view path) {
  return path.substr(path.rfind('.') + 1);
}

/// How near a clock is to a link: levels that both are in, then letters that their names share.
std::pair<std::size_t, std::size_t> nearness(std::string_view link, std::string_view clock) {
  std::size_t levels = 0, same = 0;
  for (; same < std::min(link.size(), clock.size()) && link[same] == clock[same]; ++same)
    levels += link[same] == '.' ? 1 : 0;
  const std::string_view a = leaf_of(link), b = leaf_of(clock);
  std::size_t letters = 0;
  while (letters < std::min(a.size(), b.size()) && a[letters] == b[letters]) ++letters;
  return {levels, letters};
}

class LinkStatistic final : public Statistic {
 public:
  LinkStatistic(Replay& replay, TraceFile& file, const StatisticsOptions& options)
      : replay_(replay), file_(file), options_(options) {
    for (std::size_t i = 0; i < file.paths().size(); ++i) add_link(static_cast<std::uint32_t>(i));
    if (!links_.empty()) find_clocks();
  }
  bool found() const override { return !links_.empty(); }

  void instant(std::uint64_t ps) override {
    for (SampleClock& clock : clocks_) clock.instant(ps);
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
  void find_clocks();
  /// The place of a clock's wire among `clocks_`, which gets it.
  std::size_t clock_of(std::uint32_t variable, bool falling);
  std::size_t assumed_clock();
  std::optional<std::size_t> named_clock(const Link& link);
  void choose_clocks();
  Replay::Slot follow(int variable) {
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
  static bool fits(const Link& link) {
    constexpr std::uint64_t one_in = 20;
    const std::uint64_t off = link.changes - link.counts[link.best].explained();
    return off * one_in <= link.changes;
  }
  const SampleClock& clock(const Link& link) const { return clocks_[link.clocks[link.best]]; }
  std::string clock_text(const Link& link) const;
  [[noreturn]] void refuse(const Link& link) const;

  Replay& replay_;
  TraceFile& file_;
  const StatisticsOptions& options_;
  std::vector<SampleClock> clocks_;
  std::vector<std::string> clock_names_;
  std::vector<Link> links_;
  std::vector<char> belongs_;  ///< by slot
  bool started_ = false;
};

void LinkStatistic::add_link(std::uint32_t variable) {
  const std::string& path = file_.paths()[variable];
  const bool capitals = ends_with(path, "VALID");
  if (!capitals && !ends_with(path, "valid")) return;
  constexpr std::size_t word = 5;
  const std::string stem = path.substr(0, path.size() - word);
  const auto part = [&](const char* name) {
    return file_.find(stem + (capitals ? name : lower(name)));
  };
  const int ready = part("READY");
  if (ready < 0) return;
  Link link;
  const std::string_view leaf = leaf_of(stem);
  // A stream that has a scope to itself is called after it.
  link.name = lower(leaf) == "t" && leaf.size() < stem.size() ? stem.substr(0, stem.size() - 2)
              : ends_with(lower(leaf), "_t")                  ? stem.substr(0, stem.size() - 2)
                                                              : stem;
  link.interface = link.name;
  const std::string small = lower(leaf);
  for (const char* channel : {"aw", "ar", "w", "b", "r"}) {
    if (!ends_with(small, channel)) continue;
    link.interface = stem.substr(0, stem.size() - std::string_view(channel).size());
    while (ends_with(link.interface, "_") || ends_with(link.interface, "."))
      link.interface.pop_back();
    break;
  }
  link.valid = follow(static_cast<int>(variable));
  link.ready = follow(ready);
  if (const int last = part("LAST"); last >= 0) link.last = follow(last);
  if (const int data = part("DATA"); data >= 0) {
    link.data = follow(data);
    link.bytes = (file_.variable(static_cast<std::uint32_t>(data)).width + 7) / 8;
  }
  links_.push_back(std::move(link));
}

/// For each link the clock that the user named, or those that lie near it.
void LinkStatistic::find_clocks() {
  const std::string usual = "ps.fclk_clk0.clk";
  std::vector<std::uint32_t> wires;
  for (std::uint32_t i = 0; i < file_.paths().size(); ++i) {
    const std::string leaf = lower(leaf_of(file_.paths()[i]));
    const bool named =
        leaf.find("clk") != std::string::npos || leaf.find("clock") != std::string::npos;
    const bool resets =
        leaf.find("rst") != std::string::npos || leaf.find("reset") != std::string::npos;
    const vp::WaveVariable& variable = file_.variable(i);
    if (named && !resets && variable.width == 1 && variable.kind == vp::WaveVariable::Kind::bits)
      wires.push_back(i);
  }
  for (Link& link : links_) {
    if (const auto named = named_clock(link)) {
      link.clocks = {*named};
    } else {
      std::vector<std::uint32_t> near = wires;
      std::stable_sort(near.begin(), near.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto how_near = [&](std::uint32_t wire) {
          const auto [levels, letters] = nearness(link.interface, file_.paths()[wire]);
          return std::make_tuple(levels, letters, file_.paths()[wire] == usual);
        };
        return how_near(a) > how_near(b);
      });
      for (const std::uint32_t wire : near) {
        const std::size_t place = clock_of(wire, false);
        if (std::find(link.clocks.begin(), link.clocks.end(), place) == link.clocks.end())
          link.clocks.push_back(place);
        if (link.clocks.size() == most_clocks) break;
      }
      link.clocks.push_back(assumed_clock());
    }
    link.counts.resize(link.clocks.size());
  }
}

/// For a trace without the wire.
std::size_t LinkStatistic::assumed_clock() {
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    if (!clocks_[i].has_wire()) return i;
  }
  clocks_.emplace_back(options_.system_hz);
  clock_names_.emplace_back();
  return clocks_.size() - 1;
}

std::size_t LinkStatistic::clock_of(std::uint32_t variable, bool falling) {
  const Replay::Slot slot = replay_.watch(variable);
  for (std::size_t i = 0; i < clocks_.size(); ++i) {
    if (clocks_[i].is_of(slot, falling)) return i;
  }
  clocks_.emplace_back(replay_, slot, falling);
  clock_names_.push_back(file_.paths()[variable] + (falling ? " falling" : ""));
  return clocks_.size() - 1;
}

std::optional<std::size_t> LinkStatistic::named_clock(const Link& link) {
  const ClockEdge* edge = options_.clock ? &*options_.clock : nullptr;
  for (const auto& [name, named] : options_.clock_of_link) {
    if (name == link.name || name == link.interface || ends_with(link.name, "." + name) ||
        ends_with(link.interface, "." + name)) {
      edge = &named;
    }
  }
  if (!edge) return std::nullopt;
  return clock_of(vp::find_path(edge->signal, file_.paths(), "--clock: "), edge->falling);
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
  for (std::size_t i = 0; i < link.clocks.size(); ++i) {
    LinkCount& counted = link.counts[i];
    const SampleClock& clock = clocks_[link.clocks[i]];
    if (clock.falls_on(ps) || clock.goes_back()) {
      ++counted.on_edge;
      continue;
    }
    // A bench may drive some time after the edge.
    const std::optional<std::uint64_t> delay = clock.since_edge(ps);
    if (!delay) continue;
    if (!counted.delay_ps) counted.delay_ps = delay;
    counted.with_delay += delay == counted.delay_ps ? 1 : 0;
  }
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
        weight[other.clocks[i]] += other.counts[i].weight();
    }
    for (std::size_t i = 1; i < link.clocks.size(); ++i) {
      const bool is_wire = clocks_[link.clocks[i]].has_wire();
      if (is_wire && weight[link.clocks[i]] > weight[link.clocks[link.best]]) link.best = i;
    }
    // The assumed one counts where no wire is its clock.
    const std::size_t nearest = link.best, last = link.clocks.size() - 1;
    if (fits(link) || clocks_[link.clocks[last]].has_wire()) continue;
    link.best = last;
    if (!fits(link)) link.best = nearest;
  }
}

std::string LinkStatistic::clock_text(const Link& link) const {
  const std::string& name = clock_names_[link.clocks[link.best]];
  if (!name.empty()) return name;
  return vp::format_quantity(vp::Decimal(options_.system_hz, 0), vp::Unit::frequency);
}

void LinkStatistic::refuse(const Link& link) const {
  throw vp::InputError("trace '" + file_.name() +
                       "': " + std::to_string(link.changes - link.counts[link.best].explained()) +
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
      left_out.rows.push_back(
          {link.name, link.changes, link.changes - counted.explained(), clock_text(link)});
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

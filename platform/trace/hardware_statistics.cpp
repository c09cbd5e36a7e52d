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

namespace {

struct Buffer {
  std::string name;
  Replay::Slot count;
  std::optional<Replay::Slot> depth_signal;
  std::uint64_t depth;
  std::map<std::uint64_t, std::uint64_t> ps_at;  ///< level: how long
  std::optional<std::uint64_t> full_ps;          ///< the first time
  std::uint64_t high_water = 0, high_water_ps = 0;
};

struct Counter {
  std::string name;
  Replay::Slot slot;
  std::uint64_t total = 0;
  std::optional<std::uint64_t> first_ps;
};

class BufferStatistic final : public Statistic {
 public:
  BufferStatistic(Replay& replay, const Vocabulary& words) : replay_(replay) {
    for (const Vocabulary::Buffer& known : words.buffers) {
      if (const auto count = replay.follow(known.count)) {
        buffers_.push_back(
            {known.count, *count, replay.follow(known.depth), known.usual_depth, {}, {}, 0, 0});
      }
    }
    for (const Vocabulary::Loss& loss : words.losses) {
      if (const auto slot = replay.follow(loss.path))
        counters_.push_back({loss.path, *slot, 0, {}});
    }
  }
  bool found() const override { return !buffers_.empty() || !counters_.empty(); }

  void instant(std::uint64_t ps) override {
    pass(ps);
    for (Buffer& buffer : buffers_) {
      if (buffer.depth_signal && replay_.known(*buffer.depth_signal)) {
        buffer.depth = replay_.bits(*buffer.depth_signal);
      }
      if (!replay_.known(buffer.count)) continue;
      const std::uint64_t level = replay_.bits(buffer.count);
      if (level >= buffer.depth && !buffer.full_ps) buffer.full_ps = ps;
      if (level > buffer.high_water) {
        buffer.high_water = level;
        buffer.high_water_ps = ps;
      }
    }
    for (Counter& counter : counters_) {
      if (!replay_.known(counter.slot) || !replay_.was_known(counter.slot)) continue;
      const std::uint64_t now = replay_.bits(counter.slot);
      const std::uint64_t before = replay_.bits_before(counter.slot);
      if (now <= before) continue;  // cleared for a new frame
      counter.total += now - before;
      if (!counter.first_ps) counter.first_ps = ps;
    }
  }
  void finish(std::uint64_t ps) override {
    for (Buffer& buffer : buffers_) {
      if (started_ && replay_.known(buffer.count)) {
        buffer.ps_at[replay_.bits(buffer.count)] += ps - last_ps_;
      }
    }
  }
  void report(std::vector<Table>& tables) const override;

 private:
  void pass(std::uint64_t ps) {
    if (started_) {
      for (Buffer& buffer : buffers_) {
        if (replay_.was_known(buffer.count)) {
          buffer.ps_at[replay_.bits_before(buffer.count)] += ps - last_ps_;
        }
      }
    }
    started_ = true;
    last_ps_ = ps;
  }

  Replay& replay_;
  std::vector<Buffer> buffers_;
  std::vector<Counter> counters_;
  bool started_ = false;
  std::uint64_t last_ps_ = 0;
};

void BufferStatistic::report(std::vector<Table>& tables) const {
  Table buffers{"buffers",
                "Buffers",
                {"buffer", "depth", "high_water", "high_water_at_us", "mean", "full_us", "empty_us",
                 "first_full_at_us"},
                {},
                false};
  Table levels{"occupancy", "Time at each level", {"buffer", "level", "us", "percent"}, {}, true};
  for (const Buffer& buffer : buffers_) {
    double all = 0, weighted = 0, full = 0, empty = 0;
    for (const auto& [level, ps] : buffer.ps_at) {
      const double us = static_cast<double>(ps) / ps_per_us;
      all += us;
      weighted += us * static_cast<double>(level);
      if (level >= buffer.depth) full += us;
      if (level == 0) empty += us;
    }
    for (const auto& [level, ps] : buffer.ps_at) {
      const double us = static_cast<double>(ps) / ps_per_us;
      levels.rows.push_back({buffer.name, level, us, all > 0 ? 100 * us / all : 0});
    }
    using Cell = Table::Cell;
    buffers.rows.push_back({buffer.name, buffer.depth, buffer.high_water,
                            static_cast<double>(buffer.high_water_ps) / ps_per_us,
                            all > 0 ? weighted / all : 0, full, empty,
                            buffer.full_ps ? Cell(static_cast<double>(*buffer.full_ps) / ps_per_us)
                                           : Cell(std::string("never"))});
  }
  Table overflows{"overflows", "Overflows", {"counter", "lost", "first_at_us"}, {}, false};
  for (const Counter& counter : counters_) {
    using Cell = Table::Cell;
    overflows.rows.push_back({counter.name, counter.total,
                              counter.first_ps
                                  ? Cell(static_cast<double>(*counter.first_ps) / ps_per_us)
                                  : Cell(std::string("never"))});
  }
  tables.push_back(std::move(buffers));
  tables.push_back(std::move(overflows));
  tables.push_back(std::move(levels));
}

}  // namespace

std::unique_ptr<Statistic> buffer_statistic(Replay& replay, const Vocabulary& words) {
  return std::make_unique<BufferStatistic>(replay, words);
}

namespace {

/// Lines of the PS and their numbers (UG585 table 7-4).
const Vocabulary::Interrupt chip_interrupts[] = {{"ps.global_timer.irq", 27, {}, {}},
                                                 {"ps.private_timer.irq", 29, {}, {}}};

struct Interrupt {
  std::string name;
  InterruptLine line;
  std::optional<std::uint64_t> raised_ps;
  std::uint64_t raised = 0, served = 0;
  std::uint64_t sum_ps = 0, least_ps = ~std::uint64_t{0}, most_ps = 0, most_at_ps = 0;
};

class InterruptStatistic final : public Statistic {
 public:
  InterruptStatistic(Replay& replay, const Vocabulary& words) : replay_(replay) {
    // Without the interrupt controller's word, the handler's beginning must do.
    const auto active = replay.follow("ps.gic.active");
    const auto service = active ? active : replay.follow("ps.cpu.in_handler");
    if (!service) return;
    has_number_ = active.has_value();
    service_ = *service;
    const auto irq_f2p = replay.follow(words.irq_f2p);
    for (const auto& known : words.interrupts) follow(known, irq_f2p);
    for (const auto& known : chip_interrupts) follow(known, std::nullopt);
  }
  bool found() const override { return !interrupts_.empty(); }

  void instant(std::uint64_t ps) override {
    for (Interrupt& interrupt : interrupts_) {
      if (interrupt.line.rises()) {
        ++interrupt.raised;
        interrupt.raised_ps = ps;
      }
      if (interrupt.raised_ps && begins(interrupt.line.id())) serve(interrupt, ps);
    }
  }
  void finish(std::uint64_t) override {}
  void report(std::vector<Table>& tables) const override {
    Table table{"interrupts",
                "Interrupts, from the line's rise to the acknowledgement",
                {"interrupt", "id", "raised", "served", "min_us", "mean_us", "max_us", "max_at_us"},
                {},
                false};
    for (const Interrupt& i : interrupts_) {
      const double mean =
          i.served == 0 ? 0 : static_cast<double>(i.sum_ps) / static_cast<double>(i.served);
      table.rows.push_back({i.name, i.line.id(), i.raised, i.served,
                            static_cast<double>(i.served == 0 ? 0 : i.least_ps) / ps_per_us,
                            mean / ps_per_us, static_cast<double>(i.most_ps) / ps_per_us,
                            static_cast<double>(i.most_at_ps) / ps_per_us});
    }
    tables.push_back(std::move(table));
  }

 private:
  void follow(const Vocabulary::Interrupt& known, std::optional<Replay::Slot> irq_f2p) {
    const auto line = replay_.follow(known.line);
    if (line) interrupts_.push_back({known.line, {replay_, *line, irq_f2p, known.id}, {}});
  }
  /// Service of interrupt `id` begins in this instant.
  bool begins(std::uint64_t id) const {
    const auto& changed = replay_.changed();
    if (std::find(changed.begin(), changed.end(), service_) == changed.end()) return false;
    if (!replay_.known(service_)) return false;
    const std::uint64_t now = replay_.bits(service_);
    if (has_number_) return now == id;
    return now != 0 && replay_.was_known(service_) && replay_.bits_before(service_) == 0;
  }
  static void serve(Interrupt& interrupt, std::uint64_t ps) {
    const std::uint64_t latency = ps - *interrupt.raised_ps;
    ++interrupt.served;
    interrupt.sum_ps += latency;
    interrupt.least_ps = std::min(interrupt.least_ps, latency);
    if (latency > interrupt.most_ps) {
      interrupt.most_ps = latency;
      interrupt.most_at_ps = *interrupt.raised_ps;
    }
    interrupt.raised_ps.reset();
  }

  Replay& replay_;
  bool has_number_ = false;
  Replay::Slot service_ = 0;
  std::vector<Interrupt> interrupts_;
};

}  // namespace

std::unique_ptr<Statistic> interrupt_statistic(Replay& replay, const Vocabulary& words) {
  return std::make_unique<InterruptStatistic>(replay, words);
}

}  // namespace platform::trace

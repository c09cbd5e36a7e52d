#include <algorithm>
#include <map>
#include <optional>

#include <trace/statistics.h>
#include <vp/error.h>
#include <vp/unit.h>

// Handshakes, counted on clock edges that are never looked at one by one: between two changes all
// edges see the same.

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
      : replay_(replay), file_(file), clock_(replay, "ps.fclk_clk0.clk", options.system_hz) {
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

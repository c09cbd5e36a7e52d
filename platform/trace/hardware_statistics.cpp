#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <trace/statistics.h>

namespace platform::trace {

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

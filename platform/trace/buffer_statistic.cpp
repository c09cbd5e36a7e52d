#include <trace/statistics.h>

#include <map>
#include <optional>

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
  BufferStatistic(Replay& replay, TraceFile& file, const Vocabulary& words) : replay_(replay) {
    const auto watch = [&](int variable) {
      return replay.watch(static_cast<std::uint32_t>(variable));
    };
    for (const Vocabulary::Buffer& known : words.buffers) {
      const int count = file.find(known.count);
      if (count < 0) continue;
      Buffer buffer{known.count, watch(count), std::nullopt, known.usual_depth, {}, {}, 0, 0};
      const int depth = file.find(known.depth);
      if (depth >= 0) buffer.depth_signal = watch(depth);
      buffers_.push_back(std::move(buffer));
    }
    for (const Vocabulary::Loss& loss : words.losses) {
      const int variable = file.find(loss.path);
      if (variable >= 0) counters_.push_back({loss.path, watch(variable), 0, {}});
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

std::unique_ptr<Statistic> buffer_statistic(Replay& replay, TraceFile& file,
                                            const Vocabulary& words) {
  return std::make_unique<BufferStatistic>(replay, file, words);
}

}  // namespace platform::trace

#include <trace/statistics.h>

#include <algorithm>
#include <optional>

namespace platform::trace {

namespace {

/// Lines of the PS and their numbers (UG585 table 7-4).
const Vocabulary::Interrupt chip_interrupts[] = {{"ps.global_timer.irq", 27, {}, {}},
                                                 {"ps.private_timer.irq", 29, {}, {}}};

struct Interrupt {
  std::string name;
  std::uint64_t id;
  Replay::Slot line;
  std::optional<std::uint64_t> raised_ps;
  std::uint64_t raised = 0, served = 0;
  std::uint64_t sum_ps = 0, least_ps = ~std::uint64_t{0}, most_ps = 0, most_at_ps = 0;
};

class InterruptStatistic final : public Statistic {
 public:
  InterruptStatistic(Replay& replay, TraceFile& file, const Vocabulary& words) : replay_(replay) {
    // Without the interrupt controller's word, the handler's beginning must do.
    const int active = file.find("ps.gic.active");
    const int handler = file.find("ps.cpu.in_handler");
    if (active < 0 && handler < 0) return;
    has_number_ = active >= 0;
    service_ = replay.watch(static_cast<std::uint32_t>(has_number_ ? active : handler));
    for (const Vocabulary::Interrupt& known : words.interrupts) follow(file, known);
    for (const Vocabulary::Interrupt& known : chip_interrupts) follow(file, known);
  }
  bool found() const override { return !interrupts_.empty(); }

  void instant(std::uint64_t ps) override {
    for (Interrupt& interrupt : interrupts_) {
      const bool high = replay_.known(interrupt.line) && replay_.bits(interrupt.line) != 0;
      const bool was_high =
          !replay_.was_known(interrupt.line) || replay_.bits_before(interrupt.line) != 0;
      if (high && !was_high) {
        ++interrupt.raised;
        interrupt.raised_ps = ps;
      }
      if (interrupt.raised_ps && begins(interrupt.id)) serve(interrupt, ps);
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
      table.rows.push_back({i.name, i.id, i.raised, i.served,
                            static_cast<double>(i.served == 0 ? 0 : i.least_ps) / ps_per_us,
                            mean / ps_per_us, static_cast<double>(i.most_ps) / ps_per_us,
                            static_cast<double>(i.most_at_ps) / ps_per_us});
    }
    tables.push_back(std::move(table));
  }

 private:
  void follow(TraceFile& file, const Vocabulary::Interrupt& known) {
    const int line = file.find(known.line);
    if (line < 0) return;
    Interrupt interrupt;
    interrupt.name = known.line;
    interrupt.id = known.id;
    interrupt.line = replay_.watch(static_cast<std::uint32_t>(line));
    interrupts_.push_back(std::move(interrupt));
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

std::unique_ptr<Statistic> interrupt_statistic(Replay& replay, TraceFile& file,
                                               const Vocabulary& words) {
  return std::make_unique<InterruptStatistic>(replay, file, words);
}

}  // namespace platform::trace

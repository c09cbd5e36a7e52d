#include <ps/gic/interrupt_logic.h>
#include <algorithm>

namespace ps {

namespace {

constexpr std::uint32_t idle_priority = 0xFF;
constexpr std::uint8_t this_cpu = 1;
constexpr std::uint32_t ppi_edges = 0x7DC00000;  ///< ICDICFR1 after reset

}  // namespace

void InterruptLogic::reset() {
  std::array<bool, gic::id_count> wires{};
  for (std::uint32_t id = 0; id < gic::id_count; ++id) wires[id] = interrupts_[id].wire;
  interrupts_ = {};
  for (std::uint32_t id = 0; id < gic::id_count; ++id) {
    Interrupt& interrupt = interrupts_[id];
    interrupt.wire = wires[id];
    if (id < gic::sgi_count) {
      interrupt.enabled = interrupt.edge = true;
    } else if (id < gic::first_spi) {
      interrupt.edge = (ppi_edges >> (2 * (id - 16)) & 2) != 0;
    }
    if (id < gic::first_spi) interrupt.targets = this_cpu;
  }
  icddcr = iccicr = iccpmr = 0;
  iccbpr = 2;
  iccabpr = 3;
}

void InterruptLogic::set_wire(std::uint32_t id, bool level) {
  Interrupt& interrupt = interrupts_[id];
  if (level && !interrupt.wire && interrupt.edge) interrupt.latched = true;
  interrupt.wire = level;
}

bool InterruptLogic::forwarded(const Interrupt& interrupt) const {
  const std::uint32_t group = interrupt.non_secure ? gic::icddcr::EnableNS : gic::icddcr::EnableS;
  return (icddcr & group) != 0 && interrupt.enabled && interrupt.pending() && !interrupt.active &&
         (interrupt.targets & this_cpu) != 0;
}

// The most urgent interrupt that the distributor forwards; of equals the lowest id.
std::uint32_t InterruptLogic::candidate() const {
  std::uint32_t best = gic::spurious_id;
  for (std::uint32_t id = 0; id < gic::id_count; ++id) {
    if (!forwarded(interrupts_[id])) continue;
    if (best == gic::spurious_id || interrupts_[id].priority < interrupts_[best].priority)
      best = id;
  }
  return best;
}

std::uint32_t InterruptLogic::running_priority() const {
  std::uint32_t running = idle_priority;
  for (const Interrupt& interrupt : interrupts_) {
    if (interrupt.active) running = std::min<std::uint32_t>(running, interrupt.priority);
  }
  return running;
}

// Only the bits above the binary point count against the running interrupt.
bool InterruptLogic::preempts(const Interrupt& interrupt) const {
  const std::uint32_t running = running_priority();
  if (running == idle_priority) return true;
  const bool own_point = interrupt.non_secure && (iccicr & gic::iccicr::SBPR) == 0;
  // The non-secure binary point counts one bit less.
  const std::uint32_t point = own_point ? iccabpr - 1 : iccbpr;
  const std::uint32_t group = 0xFFu << (point + 1) & 0xFFu;
  return (interrupt.priority & group) < (running & group);
}

InterruptLogic::Line InterruptLogic::signalled() const {
  const std::uint32_t id = candidate();
  if (id == gic::spurious_id) return Line::none;
  const Interrupt& interrupt = interrupts_[id];
  const std::uint32_t enable = interrupt.non_secure ? gic::iccicr::EnableNS : gic::iccicr::EnableS;
  if ((iccicr & enable) == 0 || interrupt.priority >= iccpmr || !preempts(interrupt)) {
    return Line::none;
  }
  const bool fast = !interrupt.non_secure && (iccicr & gic::iccicr::FIQEn) != 0;
  return fast ? Line::fiq : Line::irq;
}

std::uint32_t InterruptLogic::as_seen(std::uint32_t id) const {
  if (id == gic::spurious_id) return id;
  const bool hidden = interrupts_[id].non_secure && (iccicr & gic::iccicr::AckCtl) == 0;
  return hidden ? gic::non_secure_id : id;
}

std::uint32_t InterruptLogic::acknowledgeable() const {
  return signalled() == Line::none ? gic::spurious_id : as_seen(candidate());
}

std::uint32_t InterruptLogic::acknowledge() {
  const std::uint32_t id = acknowledgeable();
  if (id < gic::id_count) {
    interrupts_[id].latched = false;
    interrupts_[id].active = true;
  }
  return id;
}

bool InterruptLogic::end(std::uint32_t id) {
  if (id >= gic::id_count || !interrupts_[id].active) return false;
  interrupts_[id].active = false;
  return true;
}

std::uint32_t InterruptLogic::highest_pending() const {
  return as_seen(candidate());
}

}  // namespace ps

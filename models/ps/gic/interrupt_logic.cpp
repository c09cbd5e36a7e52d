#include <ps/gic/interrupt_logic.h>
#include <algorithm>

namespace ps {

namespace {

constexpr std::uint32_t idle_priority = 0xFF;
constexpr std::uint32_t ppi_edges = 0x7DC00000;  ///< ICDICFR1 after reset

/// Calls `visit` with the id of each bit of a word, the lowest first.
template <class Visit>
void for_each_id(unsigned n, std::uint32_t word, Visit visit) {
  for (; word != 0; word &= word - 1) {
    visit(32 * n + static_cast<std::uint32_t>(__builtin_ctz(word)));
  }
}

}  // namespace

InterruptLogic::InterruptLogic() {
  for (std::uint32_t id = 0; id < gic::first_spi; ++id) {
    const bool by_software = id < gic::sgi_count;
    enabled.set(id, by_software);
    edge.set(id, by_software || (ppi_edges >> (2 * (id - gic::sgi_count)) & 2) != 0);
    targeted.set(id, true);
  }
}

void InterruptLogic::set_wire(std::uint32_t id, bool level) {
  if (level && !wire[id] && edge[id]) latched.set(id, true);
  wire.set(id, level);
}

// What the distributor lets through of interrupts 32 · n …
std::uint32_t InterruptLogic::forwarded(unsigned n) const {
  const std::uint32_t groups = ((icddcr & gic::icddcr::EnableNS) != 0 ? non_secure.word(n) : 0) |
                               ((icddcr & gic::icddcr::EnableS) != 0 ? ~non_secure.word(n) : 0);
  return waiting(n) & groups;
}

// The most urgent interrupt that the distributor forwards; of equals the lowest id.
std::uint32_t InterruptLogic::candidate() const {
  std::uint32_t best = gic::spurious_id;
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    for_each_id(n, forwarded(n), [&](std::uint32_t id) {
      if (best == gic::spurious_id || priority[id] < priority[best]) best = id;
    });
  }
  return best;
}

std::uint16_t InterruptLogic::first_active() const {
  std::uint32_t found = gic::spurious_id;
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    for (std::uint32_t word = active.word(n); word != 0; word &= word - 1) {
      const std::uint32_t id = 32 * n + static_cast<std::uint32_t>(__builtin_ctz(word));
      if (found == gic::spurious_id || priority[id] < priority[found]) found = id;
    }
  }
  return static_cast<std::uint16_t>(found);
}

std::uint32_t InterruptLogic::running_priority() const {
  std::uint32_t running = idle_priority;
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    for_each_id(n, active.word(n), [&](std::uint32_t id) {
      running = std::min<std::uint32_t>(running, priority[id]);
    });
  }
  return running;
}

// Only the bits above the binary point count against the running interrupt.
bool InterruptLogic::preempts(std::uint32_t id) const {
  const std::uint32_t running = running_priority();
  if (running == idle_priority) return true;
  const bool own_point = non_secure[id] && (iccicr & gic::iccicr::SBPR) == 0;
  // The non-secure binary point counts one bit less.
  const std::uint32_t point = own_point ? iccabpr - 1 : iccbpr;
  const std::uint32_t group = 0xFFu << (point + 1) & 0xFFu;
  return (priority[id] & group) < (running & group);
}

InterruptLogic::Line InterruptLogic::line_of(std::uint32_t id) const {
  if (id == gic::spurious_id) return Line::none;
  const std::uint32_t enable = non_secure[id] ? gic::iccicr::EnableNS : gic::iccicr::EnableS;
  if ((iccicr & enable) == 0 || priority[id] >= iccpmr || !preempts(id)) return Line::none;
  const bool fast = !non_secure[id] && (iccicr & gic::iccicr::FIQEn) != 0;
  return fast ? Line::fiq : Line::irq;
}

std::uint32_t InterruptLogic::as_seen(std::uint32_t id) const {
  if (id == gic::spurious_id) return id;
  const bool hidden = non_secure[id] && (iccicr & gic::iccicr::AckCtl) == 0;
  return hidden ? gic::non_secure_id : id;
}

InterruptLogic::Signalled InterruptLogic::signalled() const {
  const std::uint32_t id = candidate();
  const Line line = line_of(id);
  return {line, line == Line::none ? gic::spurious_id : as_seen(id)};
}

void InterruptLogic::acknowledge(std::uint32_t id) {
  if (id >= gic::id_count) return;
  latched.set(id, false);
  active.set(id, true);
}

bool InterruptLogic::end(std::uint32_t id) {
  if (id >= gic::id_count || !active[id]) return false;
  active.set(id, false);
  return true;
}

std::uint32_t InterruptLogic::highest_pending() const {
  return as_seen(candidate());
}

}  // namespace ps

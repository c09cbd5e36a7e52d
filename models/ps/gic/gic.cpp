#include <gic_registers.h>

#include <ps/gic/gic.h>

#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/unit.h>

#include <algorithm>
#include <stdexcept>
#include <string>

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

constexpr std::uint32_t f2p_listener = ~std::uint32_t{0};

vp::RegisterBankOptions options(unsigned address_bits) {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;  // reserved words read 0
  options.address_bits = address_bits;
  return options;
}

/// Of ICDIPTR and ICDSGIR.
constexpr std::uint32_t target_bit(unsigned cpu) {
  return 1u << cpu;
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

void InterruptLogic::share(const InterruptLogic& other) {
  for (unsigned n = gic::first_spi / 32; n < gic::bit_registers; ++n) {
    for (Bits InterruptLogic::*bits :
         {&InterruptLogic::non_secure, &InterruptLogic::enabled, &InterruptLogic::edge,
          &InterruptLogic::latched, &InterruptLogic::active, &InterruptLogic::wire}) {
      (this->*bits).word(n) = (other.*bits).word(n);
    }
  }
  std::copy(other.priority.begin() + gic::first_spi, other.priority.end(),
            priority.begin() + gic::first_spi);
  icddcr = other.icddcr;
}

void InterruptLogic::set_wire(std::uint32_t id, bool level) {
  if (level && !wire[id] && edge[id]) latched.set(id, true);
  wire.set(id, level);
}

bool InterruptLogic::any_enabled() const {
  if ((icddcr & (gic::icddcr::EnableS | gic::icddcr::EnableNS)) == 0) return false;
  if ((iccicr & (gic::iccicr::EnableS | gic::iccicr::EnableNS)) == 0) return false;
  constexpr std::uint32_t by_software = (1u << gic::sgi_count) - 1;  // always enabled
  std::uint32_t any = enabled.word(0) & targeted.word(0) & ~by_software;
  for (unsigned n = 1; n < gic::bit_registers; ++n) any |= enabled.word(n) & targeted.word(n);
  return any != 0;
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
    for (std::uint32_t word = own.word(n); word != 0; word &= word - 1) {
      const std::uint32_t id = 32 * n + static_cast<std::uint32_t>(__builtin_ctz(word));
      if (found == gic::spurious_id || priority[id] < priority[found]) found = id;
    }
  }
  return static_cast<std::uint16_t>(found);
}

std::uint32_t InterruptLogic::running_priority() const {
  std::uint32_t running = idle_priority;
  for (unsigned n = 0; n < gic::bit_registers; ++n) {
    for_each_id(n, own.word(n), [&](std::uint32_t id) {
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
  if (hidden) return gic::non_secure_id;
  if (id >= gic::sgi_count || sources[id] == 0) return id;
  return id | static_cast<std::uint32_t>(__builtin_ctz(sources[id])) << gic::icciar::CPUID_shift;
}

InterruptLogic::Signalled InterruptLogic::signalled() const {
  const std::uint32_t id = candidate();
  const Line line = line_of(id);
  return {line, line == Line::none ? gic::spurious_id : as_seen(id)};
}

void InterruptLogic::raise(std::uint32_t id, unsigned source) {
  latched.set(id, true);
  sources[id] = static_cast<std::uint8_t>(sources[id] | target_bit(source));
}

// Of a software interrupt that both CPUs raised, the other one's stays pending.
void InterruptLogic::acknowledge(std::uint32_t word) {
  const std::uint32_t id = word & gic::icciar::ACKINTID;
  if (id >= gic::id_count) return;
  if (id < gic::sgi_count) sources[id] = static_cast<std::uint8_t>(sources[id] & (sources[id] - 1));
  latched.set(id, id < gic::sgi_count && sources[id] != 0);
  active.set(id, true);
  own.set(id, true);
}

bool InterruptLogic::end(std::uint32_t id) {
  if (id >= gic::id_count || !own[id]) return false;
  active.set(id, false);
  own.set(id, false);
  return true;
}

std::uint32_t InterruptLogic::highest_pending() const {
  return as_seen(candidate());
}

Gic::Gic(sc_core::sc_module_name name, vp::ClockScheduler& scheduler) : Gic(name, scheduler, 0) {}

Gic::Gic(sc_core::sc_module_name name, Gic& first) : Gic(name, first.scheduler_, 1) {
  other_ = &first;
  first.other_ = this;
}

Gic::Gic(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, unsigned number)
    : sc_module(name),
      cpu_interface("cpu_interface", gic::cpu_interface_registers, options(8), &scheduler),
      distributor("distributor", gic::distributor_registers, options(12), &scheduler),
      number_(number),
      scheduler_(scheduler) {
  wire_cpu_interface();
  wire_distributor();
}

void Gic::connect(std::uint32_t id, vp::Signal<bool>& signal) {
  if (id < gic::sgi_count || id >= gic::id_count || !wires_.emplace(id, &signal).second) {
    throw std::logic_error(std::string(name()) + ": interrupt " + std::to_string(id) +
                           " has no input, or is wired already");
  }
}

void Gic::end_of_elaboration() {
  for (const auto& [id, signal] : wires_) {
    signal->attach(*this, id);
    logic_.set_wire(id, signal->get());
  }
  if (irq_f2p.bound()) {
    irq_f2p.signal()->attach(*this, f2p_listener);
    set_f2p(static_cast<std::uint16_t>(irq_f2p.read()));
  }
  update_lines();
  // CPU 0 has the shared inputs.
  if (other_) (number_ == 0 ? *this : *other_).update_other();
}

void Gic::on_change(vp::SignalBase&, std::uint32_t id) {
  bool risen = true;
  if (id == f2p_listener) {
    risen = set_f2p(static_cast<std::uint16_t>(irq_f2p.read()));
  } else {
    set_level(id, wires_.at(id)->get());
  }
  if (risen || !idle_) update_lines();
  if (other_) update_other();
}

void Gic::set_wire(std::uint32_t id, bool level) {
  set_level(id, level);
  update_lines();
  if (other_) update_other();
}

void Gic::set_level(std::uint32_t id, bool level) {
  if (level && !logic_.wire[id]) risen_ps_[id] = scheduler_.now_ps();
  logic_.set_wire(id, level);
}

Gic::Request Gic::request() const {
  const std::uint32_t id = logic_.signalled().word & gic::icciar::ACKINTID;
  if (id >= gic::id_count) return {id, 0};
  return {id, risen_ps(id)};
}

std::uint64_t Gic::risen_ps(std::uint32_t id) const {
  const Gic& wired = other_ && number_ != 0 && id >= gic::first_spi ? *other_ : *this;
  return wired.risen_ps_[id];
}

// True if an input has risen.
// An interrupt that software has acknowledged was seen, however short.
void Gic::check_pulse(std::uint32_t id) {
  if (!logic_.enabled[id] || logic_.active[id]) return;
  const std::uint64_t width = scheduler_.now_ps() - risen_ps_[id];
  const bool edge = logic_.edge[id];
  if (width >= (edge ? shortest_edge : shortest_level)) return;
  reports_.violate(vp::Rule::interrupt_pulse, nullptr,
                   "interrupt " + std::to_string(id) + ", " + (edge ? "edge" : "level") +
                       "-sensitive, was high for " + vp::format_time(width));
}

bool Gic::set_f2p(std::uint32_t levels) {
  const bool risen = (levels & ~f2p_levels_) != 0;
  for (std::uint32_t changed = levels ^ f2p_levels_; changed != 0; changed &= changed - 1) {
    const auto bit = static_cast<unsigned>(__builtin_ctz(changed));
    const std::uint32_t id = gic::irq_f2p_id(bit);
    if ((levels >> bit & 1) == 0) check_pulse(id);
    set_level(id, (levels >> bit & 1) != 0);
  }
  f2p_levels_ = levels;
  return risen;
}

// After every change of the logic. ICCIAR shows what it came to.
void Gic::update_outputs() {
  update_lines();
  active = logic_.first_active();
  if (other_) update_other();
}

void Gic::update_other() {
  other_->logic_.share(logic_);
  other_->update_lines();
}

// A register whose word is shared was written here.
void Gic::show_shared(std::uint32_t offset) {
  if (other_) other_->distributor[offset] = distributor[offset].value();
}

// No interrupt became active or ended.
void Gic::update_lines() {
  InterruptLogic::Signalled signalled;
  idle_ = !logic_.any_waiting();
  if (!idle_) signalled = logic_.signalled();
  acknowledgeable_ = signalled.word;
  n_irq = signalled.line != InterruptLogic::Line::irq;
  n_fiq = signalled.line != InterruptLogic::Line::fiq;
}

void Gic::wire_cpu_interface() {
  const auto plain = [this](std::uint32_t offset, std::uint32_t InterruptLogic::*field) {
    vp::Register& shown = cpu_interface[offset];
    shown.after_write([this, &shown, field](std::uint32_t) {
      logic_.*field = shown.value();
      update_outputs();
    });
  };
  plain(gic::ICCICR, &InterruptLogic::iccicr);
  plain(gic::ICCPMR, &InterruptLogic::iccpmr);

  const auto binary_point = [this](std::uint32_t offset, std::uint32_t InterruptLogic::*field) {
    vp::Register& shown = cpu_interface[offset];
    shown.after_write([this, &shown, field](std::uint32_t) {
      shown = std::max(shown.value(), shown.reset_value());
      logic_.*field = shown.value();
      update_outputs();
    });
  };
  binary_point(gic::ICCBPR, &InterruptLogic::iccbpr);
  binary_point(gic::ICCABPR, &InterruptLogic::iccabpr);

  vp::Register& icciar = cpu_interface[gic::ICCIAR];
  icciar.computed_by([this] { return acknowledgeable_; });
  icciar.after_read([this](std::uint32_t word) {
    logic_.acknowledge(word);
    ++((word & gic::icciar::ACKINTID) < gic::id_count ? acknowledged : spurious);
    update_outputs();
  });
  cpu_interface[gic::ICCEOIR].after_write([this](std::uint32_t word) { end_of_interrupt(word); });
  cpu_interface[gic::ICCRPR].computed_by([this] { return logic_.running_priority(); });
  cpu_interface[gic::ICCHPIR].computed_by([this] { return logic_.highest_pending(); });
}

void Gic::end_of_interrupt(std::uint32_t word) {
  const std::uint32_t id = word & gic::icciar::ACKINTID;
  if (id == gic::spurious_id || id == gic::non_secure_id) return;
  if (!logic_.end(id)) {
    vp::warn(
        *this, "/markervp/gic/eoi",
        "ICCEOIR was written with " + std::to_string(id) + ", an interrupt that is not active");
  }
  update_outputs();
}

void Gic::wire_distributor() {
  vp::Register& icddcr = distributor[gic::ICDDCR];
  icddcr.after_write([this, &icddcr](std::uint32_t) {
    logic_.icddcr = icddcr.value();
    show_shared(gic::ICDDCR);
    update_outputs();
  });
  for (unsigned n = 0; n < gic::bit_registers; ++n) wire_bit_registers(n);
  for (unsigned n = 0; n < gic::byte_registers; ++n) wire_priorities(n);
  for (unsigned n = gic::first_spi / 4; n < gic::byte_registers; ++n) wire_targets(n);
  for (unsigned n = 0; n < gic::first_spi / 4; ++n) {
    vp::Register& icdiptr = distributor[gic::ICDIPTR(n)];
    icdiptr = icdiptr.reset_value() << number_;
  }
  for (unsigned n = gic::first_spi / 16; n < gic::sense_registers; ++n) wire_sensitivities(n);
  // Whatever their sensitivity, enabled or not.
  distributor[gic::PPI_STATUS].computed_by(
      [this] { return logic_.wire.word(0) >> gic::sgi_count; });
  for (unsigned n = 0; n < 2; ++n) {
    distributor[gic::SPI_STATUS(n)].computed_by([this, n] { return logic_.wire.word(n + 1); });
  }
  distributor[gic::ICDSGIR].after_write(
      [this](std::uint32_t word) { raise_software_interrupt(word); });
}

// The state of an interrupt lives in the logic; the registers are views of it.
void Gic::wire_bit_registers(unsigned n) {
  const auto show = [this](std::uint32_t offset, auto value) {
    distributor[offset].computed_by(value);
  };
  const auto change = [this](std::uint32_t offset, auto apply) {
    const std::uint32_t writable = distributor[offset].info().writable;
    distributor[offset].after_write([this, writable, apply](std::uint32_t word) {
      apply(word & writable, writable);
      update_outputs();
    });
  };
  InterruptLogic& l = logic_;
  show(gic::ICDISR(n), [&l, n] { return l.non_secure.word(n); });
  show(gic::ICDISER(n), [&l, n] { return l.enabled.word(n); });
  show(gic::ICDICER(n), [&l, n] { return l.enabled.word(n); });
  show(gic::ICDISPR(n), [&l, n] { return l.pending(n); });
  show(gic::ICDICPR(n), [&l, n] { return l.pending(n); });
  show(gic::ICDABR(n), [&l, n] { return l.active.word(n); });

  change(gic::ICDISR(n), [&l, n](std::uint32_t word, std::uint32_t writable) {
    l.non_secure.word(n) = (l.non_secure.word(n) & ~writable) | word;
  });
  change(gic::ICDISER(n), [&l, n](std::uint32_t word, auto) { l.enabled.word(n) |= word; });
  change(gic::ICDICER(n), [&l, n](std::uint32_t word, auto) { l.enabled.word(n) &= ~word; });
  change(gic::ICDISPR(n), [&l, n](std::uint32_t word, auto) { l.latched.word(n) |= word; });
  change(gic::ICDICPR(n), [&l, n](std::uint32_t word, auto) { l.latched.word(n) &= ~word; });
}

void Gic::wire_priorities(unsigned n) {
  vp::Register& icdipr = distributor[gic::ICDIPR(n)];
  icdipr.after_write([this, &icdipr, n](std::uint32_t) {
    for (unsigned i = 0; i < 4; ++i) {
      logic_.priority[4 * n + i] = static_cast<std::uint8_t>(icdipr >> (8 * i));
    }
    if (4 * n >= gic::first_spi) show_shared(gic::ICDIPR(n));
    update_outputs();
  });
}

void Gic::wire_targets(unsigned n) {
  vp::Register& icdiptr = distributor[gic::ICDIPTR(n)];
  icdiptr.after_write([this, &icdiptr, n](std::uint32_t) {
    for (unsigned i = 0; i < 4; ++i) {
      for (Gic* view : {this, other_}) {
        if (!view) continue;
        const bool here = (icdiptr >> (8 * i) & target_bit(view->number_)) != 0;
        view->logic_.targeted.set(4 * n + i, here);
      }
    }
    show_shared(gic::ICDIPTR(n));
    update_outputs();
  });
}

void Gic::wire_sensitivities(unsigned n) {
  vp::Register& icdicfr = distributor[gic::ICDICFR(n)];
  icdicfr.after_write([this, &icdicfr, n](std::uint32_t) {
    for (unsigned i = 0; i < 16; ++i) {
      const std::uint32_t sense = icdicfr >> (2 * i) & 3;
      logic_.edge.set(16 * n + i, sense == gic::icdicfr::rising_edge);
    }
    show_shared(gic::ICDICFR(n));
    update_outputs();
  });
}

void Gic::raise_software_interrupt(std::uint32_t word) {
  const std::uint32_t filter =
      (word & gic::icdsgir::TargetListFilter) >> gic::icdsgir::TargetListFilter_shift;
  const std::uint32_t list =
      (word & gic::icdsgir::CPUTargetList) >> gic::icdsgir::CPUTargetList_shift;
  const std::uint32_t id = word & gic::icdsgir::SGIINTID;
  if (software_interrupt_listener_) software_interrupt_listener_();
  for (Gic* view : {this, other_}) {
    if (!view) continue;
    const bool goes_there = filter == gic::icdsgir::filter_self ? view == this
                            : filter == gic::icdsgir::filter_others
                                ? view != this
                                : (list & target_bit(view->number_)) != 0;
    if (!goes_there) continue;
    view->logic_.raise(id, number_);
    view->risen_ps_[id] = scheduler_.now_ps();
  }
  update_outputs();
}

}  // namespace ps

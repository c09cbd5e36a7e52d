#include <gic_registers.h>

#include <ps/gic/gic.h>
#include <vp/report.h>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace ps {

namespace {

constexpr std::uint32_t f2p_listener = ~std::uint32_t{0};

vp::RegisterBankOptions options(unsigned address_bits) {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;  // reserved words read 0
  options.address_bits = address_bits;
  return options;
}

std::uint32_t f2p_id(unsigned bit) {
  return bit < 8 ? gic::irq_f2p_0_id + bit : gic::irq_f2p_8_id + (bit - 8);
}

}  // namespace

Gic::Gic(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name),
      cpu_interface("cpu_interface", gic::cpu_interface_registers, options(8), &scheduler),
      distributor("distributor", gic::distributor_registers, options(12), &scheduler) {
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
  update_outputs();
}

void Gic::on_change(vp::SignalBase&, std::uint32_t id) {
  bool risen = true;
  if (id == f2p_listener) {
    risen = set_f2p(static_cast<std::uint16_t>(irq_f2p.read()));
  } else {
    logic_.set_wire(id, wires_.at(id)->get());
  }
  if (risen || !idle_) update_lines();
}

// True if an input has risen.
bool Gic::set_f2p(std::uint32_t levels) {
  const bool risen = (levels & ~f2p_levels_) != 0;
  for (std::uint32_t changed = levels ^ f2p_levels_; changed != 0; changed &= changed - 1) {
    const auto bit = static_cast<unsigned>(__builtin_ctz(changed));
    logic_.set_wire(f2p_id(bit), (levels >> bit & 1) != 0);
  }
  f2p_levels_ = levels;
  return risen;
}

// After every change of the logic. ICCIAR shows what it came to.
void Gic::update_outputs() {
  update_lines();
  active = logic_.first_active();
}

// No interrupt became active or ended.
void Gic::update_lines() {
  InterruptLogic::Signalled signalled;
  idle_ = !logic_.any_waiting();
  if (!idle_) signalled = logic_.signalled();
  acknowledgeable_ = signalled.id;
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
  icciar.after_read([this](std::uint32_t id) {
    logic_.acknowledge(id);
    ++(id < gic::id_count ? acknowledged : spurious);
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

}  // namespace ps

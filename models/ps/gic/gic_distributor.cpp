#include <gic_registers.h>

#include <ps/gic/gic.h>

namespace ps {

namespace {

using Interrupt = InterruptLogic::Interrupt;

constexpr std::uint32_t this_cpu = 1;

/// `count` values of consecutive interrupts side by side in one word, the first in the lowest bits.
template <class Get>
std::uint32_t gather(const InterruptLogic& logic, unsigned first_id, unsigned count, Get get) {
  std::uint32_t word = 0;
  for (unsigned i = 0; i < count; ++i) {
    word |= static_cast<std::uint32_t>(get(logic[first_id + i])) << (i * (32 / count));
  }
  return word;
}

}  // namespace

void Gic::wire_distributor() {
  vp::Register& icddcr = distributor[gic::ICDDCR];
  icddcr.after_write([this, &icddcr](std::uint32_t) {
    logic_.icddcr = icddcr.value();
    update_outputs();
  });
  for (unsigned n = 0; n < gic::bit_registers; ++n) wire_bit_registers(n);
  for (unsigned n = 0; n < gic::byte_registers; ++n) wire_priorities(n);
  for (unsigned n = gic::first_spi / 4; n < gic::byte_registers; ++n) wire_targets(n);
  for (unsigned n = gic::first_spi / 16; n < gic::sense_registers; ++n) wire_sensitivities(n);
  distributor[gic::ICDSGIR].after_write(
      [this](std::uint32_t word) { raise_software_interrupt(word); });
}

// The state of an interrupt lives in the logic; the registers are views of it.
void Gic::wire_bit_registers(unsigned n) {
  const unsigned first = 32 * n;
  const auto view = [&](std::uint32_t offset, auto get, auto change) {
    vp::Register& shown = distributor[offset];
    shown.computed_by([this, first, get] { return gather(logic_, first, 32, get); });
    const std::uint32_t writable = shown.info().writable;
    shown.after_write([this, first, writable, change](std::uint32_t word) {
      for (unsigned i = 0; i < 32; ++i) {
        if ((writable >> i & 1) != 0) change(logic_[first + i], (word >> i & 1) != 0);
      }
      update_outputs();
    });
  };
  const auto group = [](const Interrupt& i) { return i.non_secure; };
  const auto enabled = [](const Interrupt& i) { return i.enabled; };
  const auto pending = [](const Interrupt& i) { return i.pending(); };
  const auto active = [](const Interrupt& i) { return i.active; };
  view(gic::ICDISR(n), group, [](Interrupt& i, bool bit) { i.non_secure = bit; });
  view(gic::ICDISER(n), enabled, [](Interrupt& i, bool bit) { i.enabled |= bit; });
  view(gic::ICDICER(n), enabled, [](Interrupt& i, bool bit) { i.enabled &= !bit; });
  view(gic::ICDISPR(n), pending, [](Interrupt& i, bool bit) { i.latched |= bit; });
  view(gic::ICDICPR(n), pending, [](Interrupt& i, bool bit) { i.latched &= !bit; });
  view(gic::ICDABR(n), active, [](Interrupt&, bool) {});
}

void Gic::wire_priorities(unsigned n) {
  vp::Register& icdipr = distributor[gic::ICDIPR(n)];
  icdipr.after_write([this, &icdipr, n](std::uint32_t) {
    for (unsigned i = 0; i < 4; ++i) {
      logic_[4 * n + i].priority = static_cast<std::uint8_t>(icdipr >> (8 * i));
    }
    update_outputs();
  });
}

void Gic::wire_targets(unsigned n) {
  vp::Register& icdiptr = distributor[gic::ICDIPTR(n)];
  icdiptr.after_write([this, &icdiptr, n](std::uint32_t) {
    for (unsigned i = 0; i < 4; ++i) {
      logic_[4 * n + i].targets = static_cast<std::uint8_t>(icdiptr >> (8 * i));
    }
    update_outputs();
  });
}

void Gic::wire_sensitivities(unsigned n) {
  vp::Register& icdicfr = distributor[gic::ICDICFR(n)];
  icdicfr.after_write([this, &icdicfr, n](std::uint32_t) {
    for (unsigned i = 0; i < 16; ++i) {
      const std::uint32_t sense = icdicfr >> (2 * i) & 3;
      logic_[16 * n + i].edge = sense == gic::icdicfr::rising_edge;
    }
    update_outputs();
  });
}

void Gic::raise_software_interrupt(std::uint32_t word) {
  const std::uint32_t filter =
      (word & gic::icdsgir::TargetListFilter) >> gic::icdsgir::TargetListFilter_shift;
  const std::uint32_t list =
      (word & gic::icdsgir::CPUTargetList) >> gic::icdsgir::CPUTargetList_shift;
  const bool here = filter == gic::icdsgir::filter_self ||
                    (filter == gic::icdsgir::filter_list && (list & this_cpu) != 0);
  if (here) logic_[word & gic::icdsgir::SGIINTID].latched = true;
  update_outputs();
}

}  // namespace ps

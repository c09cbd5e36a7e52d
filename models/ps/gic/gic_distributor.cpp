#include <gic_registers.h>

#include <ps/gic/gic.h>

namespace ps {

namespace {

constexpr std::uint32_t this_cpu = 1;

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
    update_outputs();
  });
}

void Gic::wire_targets(unsigned n) {
  vp::Register& icdiptr = distributor[gic::ICDIPTR(n)];
  icdiptr.after_write([this, &icdiptr, n](std::uint32_t) {
    for (unsigned i = 0; i < 4; ++i) {
      logic_.targeted.set(4 * n + i, (icdiptr >> (8 * i) & this_cpu) != 0);
    }
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
  if (here) logic_.latched.set(word & gic::icdsgir::SGIINTID, true);
  update_outputs();
}

}  // namespace ps

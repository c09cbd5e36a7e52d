#pragma once

#include <gic_registers.h>

#include <ps/gic/gic.h>

#include "bench.h"

namespace bench::gic_at_bus {

constexpr std::uint32_t icc = gic::cpu_interface_base;
constexpr std::uint32_t icd = gic::distributor_base;

struct GicBench : Bench {
  GicBench() {
    bus.map("gic_cpu_interface", icc, 0x100).bind(gic.cpu_interface.socket);
    bus.map("gic_distributor", icd, 0x1000).bind(gic.distributor.socket);
    gic.irq_f2p(irq_f2p);
    gic.connect(gic::global_timer_id, timer);
  }
  vp::Signal<std::uint32_t> irq_f2p{"irq_f2p", 16};
  vp::Signal<bool> timer{"timer"};
  ps::Gic gic{"gic", scheduler};

  bool irq() const { return !gic.n_irq.get(); }
};

inline void change(std::uint32_t address, std::uint32_t mask, std::uint32_t bits) {
  hal_write32(address, (hal_read32(address) & ~mask) | bits);
}

/// What the driver does, for one interrupt of this CPU. Private interrupts have their target and
/// sensitivity by nature.
inline void set_up(std::uint32_t id, std::uint32_t priority = 0xA0, bool edge = false) {
  hal_write32(icd + gic::ICDDCR, 1);
  hal_write32(icc + gic::ICCPMR, 0xF0);
  hal_write32(icc + gic::ICCICR, 7);
  const unsigned byte = 8 * (id % 4);
  change(icd + gic::ICDIPR(id / 4), 0xFFu << byte, priority << byte);
  if (id >= gic::first_spi) {
    change(icd + gic::ICDIPTR(id / 4), 0xFFu << byte, 1u << byte);
    const unsigned pair = 2 * (id % 16);
    const std::uint32_t sense = edge ? gic::icdicfr::rising_edge : gic::icdicfr::level_high;
    change(icd + gic::ICDICFR(id / 16), 3u << pair, sense << pair);
  }
  hal_write32(icd + gic::ICDISER(id / 32), 1u << (id % 32));
}

inline std::uint32_t acknowledge() {
  return hal_read32(icc + gic::ICCIAR);
}
inline void end(std::uint32_t id) {
  hal_write32(icc + gic::ICCEOIR, id);
}

}  // namespace bench::gic_at_bus

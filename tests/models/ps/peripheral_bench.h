#pragma once

#include <vp/report.h>

#include <cstdint>
#include <sstream>

#include "bench.h"

/// What the tests of single peripherals share.
namespace bench {

constexpr std::uint64_t clock_ps = 10'000;  // 100 MHz

/// A device of the processing system alone, at its address; its clock has 100 MHz.
template <class Device>
struct Alone : Bench {
  Alone(const char* name, std::uint32_t base) : dut(name, clock) {
    reports.redirect(text);
    bus.map(name, base, 0x1000).bind(dut.registers.socket);
  }
  vp::Clock clock{"clock", scheduler, 100'000'000};
  Device dut;
  std::ostringstream text;
  vp::ReportRouter reports;
};

/// One without a clock of its own.
template <class Device>
struct Unclocked : Bench {
  Unclocked(const char* name, std::uint32_t base) : dut(name, scheduler) {
    reports.redirect(text);
    bus.map(name, base, 0x1000).bind(dut.registers.socket);
  }
  Device dut;
  std::ostringstream text;
  vp::ReportRouter reports;
};

inline void let_pass(std::uint64_t ps) {
  hal_work(step, ps / 1000);  // the CPU has 1 GHz
}
inline std::uint32_t look(std::uint32_t address) {
  return hal_read32(address);
}
inline void put(std::uint32_t address, std::uint32_t value) {
  hal_write32(address, value);
}

}  // namespace bench

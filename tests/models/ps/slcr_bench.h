#pragma once

#include <slcr_registers.h>

#include <ps/slcr/slcr.h>
#include <vp/report.h>
#include <memory>
#include <sstream>

#include "bench.h"

namespace bench {

constexpr std::uint32_t slcr_at = slcr::base;

/// The SLCR at a bus without time, with two PL clocks, a UART's and (if asked for) the CPU's.
struct SlcrBench : Bench {
  explicit SlcrBench(const Settings& settings = {}, std::uint64_t pixel_hertz = 50'000'000)
      : scope_(configure(settings)),
        fclk0("fclk0", scheduler, 100'000'000),
        fclk1("fclk1", scheduler, pixel_hertz),
        uart_ref("uart_ref", scheduler, 50'000'000),
        slcr("slcr", scheduler) {
    reports.redirect(text);
    bus.map("slcr", slcr_at, 0x1000).bind(slcr.registers.socket);
    slcr.drive_fclk(0, fclk0);
    slcr.drive_fclk(1, fclk1);
    slcr.drive_uart_ref(1, uart_ref);
    configuration_.check_unused();
  }

 private:
  vp::Configuration& configure(const Settings& settings) {
    for (const std::string& setting : settings) configuration_.set(setting);
    return configuration_;
  }
  vp::Configuration configuration_;
  vp::Configuration::Scope scope_;

 public:
  vp::Clock fclk0, fclk1, uart_ref;
  ps::Slcr slcr;
  std::ostringstream text;
  vp::ReportRouter reports{sc_core::SC_MEDIUM};

  std::uint64_t warnings(const std::string& id) const { return reports.count(id); }
};

/// The SLCR with other boot code, and a UART's clock.
struct BootedSlcr : Bench {
  explicit BootedSlcr(const ps::Slcr::BootClocks& clocks)
      : uart_ref("uart_ref", scheduler, 0), slcr("slcr", scheduler) {
    reports.redirect(text);
    bus.map("slcr", slcr_at, 0x1000).bind(slcr.registers.socket);
    slcr.boot_with(clocks);
    slcr.drive_uart_ref(1, uart_ref);
  }

  vp::Clock uart_ref;
  ps::Slcr slcr;
  std::ostringstream text;
  vp::ReportRouter reports{sc_core::SC_MEDIUM};
};

inline const Settings without_boot_code{"slcr.programmed_by_boot=false"};

inline std::uint32_t get(std::uint32_t offset) {
  return hal_read32(slcr_at + offset);
}
inline void set(std::uint32_t offset, std::uint32_t value) {
  hal_write32(slcr_at + offset, value);
}
inline void unlock() {
  set(slcr::SLCR_UNLOCK, slcr::unlock_key);
}
inline void after(std::uint64_t nanoseconds) {
  hal_work(step, nanoseconds);  // the CPU has 1 GHz
}

}  // namespace bench

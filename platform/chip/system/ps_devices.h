#pragma once

#include <cstdint>
#include <memory>
#include <systemc>
#include <vector>

#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace platform {

/// A device of the PS that meets the rest of it at the peripheral bus and the interrupt controller
/// alone: no other part knows its type. ps_devices.cpp lists them.
struct PsDevice {
  const char* title;  ///< what it is, for people
  std::uint64_t base, size;
  std::unique_ptr<sc_core::sc_module> module;
  vp::RegisterBank& registers;
  std::uint32_t interrupt;  ///< its number
  vp::Signal<bool>* irq;    ///< null: it has none
};

/// In the order of the list, below the module under construction. Peripherals run on
/// `cpu_1x_clk`, or without a clock.
std::vector<PsDevice> make_ps_devices(vp::ClockScheduler& scheduler, vp::Clock& cpu_1x_clk);

}  // namespace platform

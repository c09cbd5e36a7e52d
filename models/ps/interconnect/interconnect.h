#pragma once

#include <vp/parameter.h>
#include <vp/router.h>
#include <cstdint>
#include <systemc>

namespace ps {

/// M_AXI_GP0: the CPU's way to the registers of the programmable logic.
///
/// An access takes a time in the PS that does not depend on the PL's clock, plus clocks of the PL:
/// read_time + read_clocks, write_time + write_clocks, as measured for single strongly ordered
/// accesses. Of a request that leaves the CPU at t0, half the PS time and request_clocks pass on
/// the way there; the slave sees it at the first edge of the PL clock from then on, and answers
/// within the rest. A slave that takes longer delays the answer.
class GpPort : public vp::Bridge {
 public:
  GpPort(sc_core::sc_module_name name, const vp::Clock& pl_clock);
  const char* kind() const override { return "ps::GpPort"; }

  vp::Parameter<std::uint64_t> read_time;
  vp::Parameter<double> read_clocks;
  vp::Parameter<std::uint64_t> write_time;
  vp::Parameter<double> write_clocks;
  vp::Parameter<double> request_clocks;

 private:
  Times times(bool read) const override;
};

/// How long accesses on a register bus take by default, in CPU cycles, and why.
struct RegisterBusTimes {
  std::uint32_t read_cycles;
  std::uint32_t write_cycles;
  const char* reason;
};

/// The private bus through the SCU, from `private_bus_base` on: interrupt controller and timers.
inline constexpr RegisterBusTimes private_bus_times{
    32, 24, "a few cycles of the peripheral clock (half the CPU's) each way through the SCU"};
inline constexpr std::uint64_t private_bus_base = 0xF8F0'0000;
inline constexpr std::uint64_t private_bus_size = 0x2000;
/// Through the central interconnect: I/O peripherals and SLCR.
inline constexpr RegisterBusTimes peripheral_bus_times{
    78, 78,
    "the 80 ns that the GP ports need inside the PS, and 4 cycles of CPU_1x (UG585 table 22-4: the "
    "same interconnect)"};

/// The CPU's way to registers of the processing system. An access takes CPU cycles; the device sees
/// it when half of them have passed. Addresses stay those of the bus (absolute).
class RegisterBus : public vp::Bridge {
 public:
  RegisterBus(sc_core::sc_module_name name, const vp::Clock& cpu_clock,
              const RegisterBusTimes& defaults);
  const char* kind() const override { return "ps::RegisterBus"; }

  vp::Router devices{"devices"};  ///< map the devices here

  vp::Parameter<std::uint32_t> read_cycles;
  vp::Parameter<std::uint32_t> write_cycles;

 private:
  Times times(bool read) const override;
};

}  // namespace ps

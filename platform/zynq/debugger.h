#pragma once

#include <cstdint>

#include <zynq/zynq.h>

/// What a debugger calls by name while the PS program stands at a breakpoint (scripts/markervp.gdb
/// makes commands of it). Takes no simulated time and changes nothing: registers show what stands
/// at the time that the simulation has reached. What the program computed since its last HAL call
/// has not passed yet.
extern "C" {
/// The word at a bus address, memory or register. What nothing answers to reads 0xFFFFFFFF.
std::uint32_t markervp_peek(std::uint32_t address);
/// Prints all registers of a device by the name that `markervp map` gives it. Of another name: the
/// names there are.
void markervp_registers(const char* device);
/// Prints the simulation time and the annotated function that runs.
void markervp_time();
}

namespace platform {

/// The platform that the functions above look at, while it lives; one at a time.
class Debugged {
 public:
  explicit Debugged(Zynq& zynq);
  ~Debugged();
  Debugged(const Debugged&) = delete;
  Debugged& operator=(const Debugged&) = delete;
};

}  // namespace platform

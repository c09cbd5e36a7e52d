#pragma once

#include <cstdint>
#include <string>

#include <chip/system/zynq.h>

/// What a debugger calls by name while the PS program is at a breakpoint (scripts/markervp.gdb
/// makes commands of it). Takes no simulated time and changes nothing: registers show what is
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
/// 1 if the PS program's code is at `address`, otherwise 0.
int markervp_is_program(const void* address);
/// Called at each moment that the simulation was to stop for: the place of a breakpoint. The first
/// time it stops the process until a debugger lets it go on.
void markervp_stop();
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

/// Says what the simulation stops for (`markervp debug`), and calls markervp_stop().
void stop_for_debugger(const std::string& what);

}  // namespace platform

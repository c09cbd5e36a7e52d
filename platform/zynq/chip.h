#pragma once

#include <cstdint>
#include <string>
#include <systemc>

#include <device/device.h>
#include <vp/clock.h>
#include <vp/parameter.h>

namespace platform {

enum class ClockMode {
  made,   ///< clocks have the frequencies that PLLs and dividers give
  exact,  ///< clocks have the frequencies that were asked for
};

/// The chip that a platform is built for: parameters of the platform as a whole.
struct Chip {
  /// Throws vp::InputError for a device that nobody knows.
  Chip();

  vp::Parameter<std::string> name;
  vp::Parameter<ClockMode> clocks;
  const device::Device& data;  ///< what is known of it
};

/// A clock that the PS makes. It starts with the frequency that was asked for, or with what the
/// chip makes of it.
class ClockSource : public sc_core::sc_module {
 public:
  ClockSource(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, std::uint64_t default_hz,
              vp::Source source, const std::string& documentation);

  /// Starts with `hz` instead of what was asked for. Before the simulation.
  void make(double hz);
  std::uint64_t start_hz() const { return start_hz_; }

  vp::Parameter<std::uint64_t> frequency;  ///< asked for
  vp::Clock clk;

 private:
  std::uint64_t start_hz_;
};

}  // namespace platform

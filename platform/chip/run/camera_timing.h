#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <systemc>

#include <vp/parameter.h>

namespace platform {

/// A parameter that is a rate, "60 fps", or "none".
class FrameRate : public vp::ParameterBase {
 public:
  /// Throws vp::InputError for a rate that no camera has.
  FrameRate(const char* name, std::string documentation);

  /// In 10^-6 frames a second.
  std::optional<std::uint64_t> micro_fps() const { return micro_fps_; }

 private:
  void read(const vp::Setting& given);

  std::optional<std::uint64_t> micro_fps_;
};

/// When inputs come: whenever one is wanted, or at a fixed rate as of a camera, whether the program
/// is ready for them or not.
///
/// At a rate, input n comes round(n / rate) ps after the first, which comes when the first one is
/// wanted.
class CameraTiming : public sc_core::sc_module {
 public:
  explicit CameraTiming(sc_core::sc_module_name name);

  FrameRate rate;

  bool has_rate() const { return rate.micro_fps().has_value(); }
  // With a rate only.
  double fps() const;
  /// From the first input to input `number`.
  std::uint64_t offset_ps(std::uint64_t number) const;
  /// The first input that comes `offset_ps` or more after the first.
  std::uint64_t first_after(std::uint64_t offset_ps) const;
};

}  // namespace platform

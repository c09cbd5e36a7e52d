#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <chip/run/camera_timing.h>
#include <chip/run/cost_profile.h>
#include <chip/system/design.h>
#include <hal/hal.h>
#include <vp/parameter.h>

namespace platform {

/// How a PS program is compiled, and the options that it declares, as parameters `sw.<name>`.
class SoftwareOptions : public sc_core::sc_module {
 public:
  /// What follows from other parameters: `opt` from the cost profile named `profile`; the option
  /// `cpu_clock`, for which a program on the chip is built, from the clock that it has here; and
  /// `upload`, which a camera of a fixed rate does itself; `overlap`, which such a camera leaves no
  /// time for. Throws vp::InputError for a value out of
  /// its range or that contradicts these, and for a unit that the program's option may not have.
  /// What the logic of `design` decides is no parameter.
  SoftwareOptions(sc_core::sc_module_name name, const hal_program& program,
                  const std::string& profile, std::uint64_t cpu_hz, const CameraTiming& camera,
                  Design& design);

  /// What the user asked for; none: what the profile is for.
  std::optional<profiles::Optimisation> optimisation() const;

  /// It is compiled with -O0, and `opt` could be O2.
  bool is_unoptimised() const { return is_unoptimised_; }

  /// Option number `option` in the unit that the program declared.
  double value(std::uint32_t option) const { return values_.at(option); }
  /// What is in the file that this option names, as OptionFiles has it or else as it is; empty: it
  /// names none.
  const std::string& data(std::uint32_t option) const;
  /// The program brings its inputs to the PL itself.
  bool uploads() const { return uploads_; }

 private:
  /// 1 if the user names a file, else 0.
  double read_file(std::uint32_t option, const hal_option_info& info, Design& design);

  vp::Parameter<profiles::Optimisation> opt_;
  std::deque<vp::Parameter<double>> parameters_;
  std::deque<vp::Parameter<std::string>> names_, files_;
  std::vector<double> values_;
  std::map<std::uint32_t, std::string> data_;  ///< of options that name a file
  bool is_unoptimised_ = false;
  bool uploads_ = false;  ///< a program that does has the option `upload`
};

}  // namespace platform

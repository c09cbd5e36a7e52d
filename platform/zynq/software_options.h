#pragma once

#include <deque>
#include <string>
#include <systemc>
#include <vector>

#include <hal/hal.h>
#include <vp/parameter.h>

namespace platform {

/// The options that a PS program declares, as parameters `sw.<name>`.
class SoftwareOptions : public sc_core::sc_module {
 public:
  /// Throws vp::InputError for a value out of its range, and for a unit that the program's option
  /// may not have.
  SoftwareOptions(sc_core::sc_module_name name, const hal_program& program);

  /// Option number `option` in the unit that the program declared.
  double value(std::uint32_t option) const { return values_.at(option); }
  /// The same by name; `otherwise` if the program has no such option.
  double value(const std::string& option, double otherwise) const;

 private:
  std::deque<vp::Parameter<double>> parameters_;
  std::vector<double> values_;
};

}  // namespace platform

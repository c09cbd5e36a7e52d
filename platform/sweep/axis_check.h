#pragma once

#include <string>
#include <vector>

#include <sweep/axis_values.h>
#include <sweep/parameter_table.h>
#include <sweep/plan.h>

namespace platform::sweep {

/// A PS program, and the parameters of the platform with it.
struct ProgramTable {
  std::string program;
  const ParameterTable& table;
};

/// Builds the platform with values of the axis, so that a wrong one shows before the first point:
/// throws vp::InputError. Returns whether other parameters, or the picture's size, follow from it.
bool check_values(const AxisValues& axis, const Spec& spec,
                  const std::vector<ProgramTable>& programs, const Platform& platform);

}  // namespace platform::sweep

#pragma once

#include <vector>

#include <study/axes.h>
#include <study/plan.h>

namespace platform::study {

/// What all points of a PS program and a design start from, and the parameters of that platform.
struct Base {
  Setup build;
  ParameterTable table;
};

/// Builds the platform with values of the axis, so that a wrong one shows before the first point:
/// throws vp::InputError. Returns whether other parameters, or the picture's size, follow from it.
bool check_values(const AxisValues& axis, const std::vector<Base>& bases, const Platform& platform);

}  // namespace platform::study

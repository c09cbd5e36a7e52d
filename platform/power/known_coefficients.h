#pragma once

#include <vector>

namespace platform::power {

/// A coefficient that the model uses. Zero is the least for all; more than `most` is a slip of the
/// pen: ten times what any 28 nm device was seen to take, or more.
struct KnownCoefficient {
  const char* name;
  const char* unit;
  double most;
};

const std::vector<KnownCoefficient>& known_coefficients();

}  // namespace platform::power

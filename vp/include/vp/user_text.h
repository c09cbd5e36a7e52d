#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Bounds for what people write, and for what a message repeats of it.
namespace vp {

/// For the expressions of traces and of sweeps: both are parsed and evaluated recursively, and
/// neither may use up the stack.
struct ExpressionLimits {
  static constexpr std::size_t most_parts = 1000;  ///< values and operators
  static constexpr std::size_t deepest = 100;      ///< brackets and signs inside each other
};

/// A text of more than 200 characters as its beginning and "...".
std::string excerpt(std::string_view text);

}  // namespace vp

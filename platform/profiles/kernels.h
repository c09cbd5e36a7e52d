#pragma once

#include <string>
#include <vector>

namespace platform::profiles {

/// A function of the PS software and the units of work that make up its time.
struct Kernel {
  std::string name;
  std::vector<std::string> units;  ///< names of marker::Work
};

/// All kernels: each unit of marker::Work belongs to one.
const std::vector<Kernel>& kernels();

/// The kernel of a unit; empty if there is no such unit.
std::string kernel_of(const std::string& unit);

}  // namespace platform::profiles

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <ps/cpu/cpu_time.h>

/// How long the PS software takes: tables of data files, checked when they are read.
///
/// A *cost table* has the cost of each unit of work, found by scripts/calibrate. A *scaled profile*
/// takes cost tables and fits a few named constants to published values.
namespace platform::profiles {

/// How the PS software is compiled.
enum class Optimisation { o0, o2 };

/// One constant of a profile that was fitted to published values.
struct FittedConstant {
  std::string name;                    ///< "scale of corner_detection"
  double value = 0;                    ///< a factor, or ns
  std::vector<std::string> published;  ///< the values it was fitted to, by their ID
};

/// A profile, ready to use.
struct CostProfile {
  ps::CostTable costs;  ///< its profile() is the name for reports: "thesis", "thesis-O2", "a9-O2"
  std::string origin;   ///< one line
  std::string date;     ///< ISO 8601
  std::vector<FittedConstant> fitted;  ///< empty: nothing was
};

/// Most constants that a profile may fit.
inline constexpr std::size_t max_fitted = 8;

/// What profile `name` is for: O0 for one that has both. Throws vp::InputError if it cannot be
/// read.
Optimisation optimisation_of(const std::string& name);

/// The profile holds for software compiled either way, as sw.opt says.
bool holds_for_both(const std::string& name);

/// Reads a profile. `name` is that of an installed one ("thesis", "a9-O0", …) or a file, which ends
/// in .json. `optimisation`: none is optimisation_of(name).
/// Throws vp::InputError that names file and entry: no such profile, another version, a kernel or
/// unit that is missing, unknown, negative or absurd, or an optimisation that it is not for.
CostProfile load_cost_profile(const std::string& name, std::optional<Optimisation> optimisation);

/// Refuses the profiles and optimisations that load_cost_profile() does, but not a table that lacks
/// units or has bad ones: for those who only ask what there is.
void check_cost_profile(const std::string& name, std::optional<Optimisation> optimisation);

}  // namespace platform::profiles
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

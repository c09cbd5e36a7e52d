#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// How fast a synthesised design can be clocked on a 7-series chip of speed grade -1. Cells follow
/// from synthesis. Nets are known only after routing: what represents them was fitted to public
/// timing reports (docs/rtl-library.md, calibration/rtl/fit.py).
namespace platform::synthesis {

/// From the clock of one register to the next one's.
struct Path {
  double cells_ns = 0;   ///< clock to output, and all cells on the way
  double setup_ns = 0;   ///< of the pin where it ends
  unsigned nets = 0;     ///< that leave a slice; those inside take no time
  unsigned fan_out = 1;  ///< the largest of them
  std::string from;      ///< the register's name in the RTL
  std::string to;
  std::vector<std::string> cells;  ///< their types, from the first after the register
};

/// MHz. Nine of ten routed paths that the model never saw lie between `low` and `high`.
struct FmaxRange {
  double low = 0;
  double nominal = 0;
  double high = 0;
};

class PathTiming {
 public:
  /// Reads what is installed as rtl/xc7.json. Throws vp::InputError if it is not there.
  static PathTiming installed();
  /// Throws vp::InputError: missing, malformed, a number missing or out of its range.
  static PathTiming load(const std::filesystem::path& file);

  /// Delay of a cell's arc or set-up time of a pin, ns, by its name in the file. Throws
  /// std::logic_error without one of that name.
  double operator[](const std::string& name) const;

  /// The highest clock of a part of the chip, by its name in the file. Throws std::logic_error if
  /// no such name exists.
  double limit_mhz(const std::string& name) const;

  /// What one net adds where no time is to spare, ns.
  double net_ns() const { return nets_.at("per_net_ns") / (1 - nets_.at("slack_share")); }
  /// What all nets of a path take at its highest clock, ns.
  double nets_ns(unsigned nets, unsigned fan_out) const;
  /// A whole path with its clock's skew and uncertainty, where the clock leaves no time to spare;
  /// the data path `factor` times what the model says.
  double period_ns(const Path& path, double factor = 1) const;
  FmaxRange fmax(const Path& path) const;

 private:
  std::map<std::string, double> nets_;
  std::map<std::string, double> cells_;
  std::map<std::string, double> limits_;
};

}  // namespace platform::synthesis

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// The chips that a design can be built for, as data, and what their clock generators can make.
/// Knows no SystemC and no design.
namespace platform::device {

/// How far a figure can be trusted.
enum class Confidence {
  published,  ///< stated by the vendor, or by a source that names the vendor's document
  derived,    ///< computed from published or measured values
  assumed,    ///< no source states it
};

const char* to_string(Confidence confidence);

struct Figure {
  double value = 0;
  Confidence confidence = Confidence::assumed;
  std::string source;
};

/// Clocks are in MHz in the files, in Hz in calculations.
inline constexpr double hz_per_mhz = 1e6;

/// A chip of one speed grade. Names of the figures are those of the file.
struct Device {
  std::string part;   ///< "xc7z020"
  std::string grade;  ///< "1" is the slowest

  // Of the part.
  Figure lut, ff, bram36, dsp;
  Figure cores;        ///< Cortex-A9
  Figure static_w;     ///< what the whole chip leaks at a junction of 25 C
  Figure device_code;  ///< bits 12 to 16 of IDCODE

  // Highest clocks of the speed grade, MHz.
  Figure cpu_621_mhz;       ///< CPU_6x4x with the ratio 6:2:1
  Figure cpu_421_mhz;       ///< CPU_6x4x with the ratio 4:2:1
  Figure ddr_mhz;           ///< DDR3 and DDR3L; two transfers a clock
  Figure fclk_mhz;          ///< to the PL
  Figure clock_buffer_mhz;  ///< of a clock that comes in at a pin
  Figure vco_max_mhz;       ///< of the PLLs of the processing system
  Figure fmax_factor;       ///< Fmax of logic, over that of grade -1

  // Of the family.
  Figure crystal_min_mhz, crystal_max_mhz;  ///< PS_CLK
  Figure pll_feedback_min, pll_feedback_max;
  Figure vco_min_mhz;
  Figure divisor_max;  ///< of each divider behind a PLL

  /// "xc7z020-1".
  std::string name() const { return part + "-" + grade; }
  /// Value of PSS_IDCODE, revision 0.
  std::uint32_t idcode() const;
};

/// What the program knows of a figure.
struct FigureInfo {
  enum class Owner { part, grade, family };

  const char* name;
  const char* unit;  ///< may be empty
  const char* documentation;
  Owner owner;
  Figure Device::*figure;
  double least, most;  ///< beyond that it is a slip of the pen
  bool whole = false;  ///< no fractions
};

/// All figures, in the order of the struct.
const std::vector<FigureInfo>& figures();

/// The devices of one file, by name. Throws vp::InputError, with the file and the entry, for
/// anything that is unknown, missing, of another type or out of range.
std::vector<Device> read_devices(const std::filesystem::path& file);

/// devices() looks in `folder` first. Before it is called for the first time. Returns true.
bool look_in(const std::filesystem::path& folder);

#ifdef MARKERVP_DEVICES
/// Where the package has them, for an executable that is elsewhere.
inline const bool looks_in_package = look_in(MARKERVP_DEVICES);
#endif

/// All that are installed, by name. Throws vp::InputError as read_devices(), and if there are none.
const std::vector<Device>& devices();

/// "xc7z020-1"; without a grade it is the slowest. Upper and lower case are alike. Throws
/// vp::InputError with the nearest match and all names for any other.
const Device& find_device(const std::string& name);

}  // namespace platform::device

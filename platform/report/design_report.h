#pragma once

#include <map>
#include <string>
#include <vector>

/// What a design costs: power, resources, and whether it meets its clocks.
namespace platform::report {

/// Energy of the modules of a group.
struct GroupEnergy {
  std::string group;  ///< "ps", "feature_extraction", "data_bridge", "image_memory", "static"
  double mj = 0;
};

/// Mean power until the last result of a run, image upload excluded; of a run without results over
/// all frames, without frames over the whole run. Watts are on-chip power: the DDR chips are not in
/// them.
struct PowerReport {
  struct Module {
    std::string name;
    std::string rail;
    std::string kind;  ///< "static", "clock", "state", "event"
    double w = 0;
    double mj = 0;       ///< per frame
    std::string source;  ///< of the coefficient
  };

  std::string mode;      ///< "vivado-default" or "activity"
  std::string table;     ///< name of the coefficients
  double ambient_c = 0;  ///< temperature around the board
  double junction_c = 0;
  double low_w = 0, total_w = 0, high_w = 0;
  double ps_w = 0, pl_w = 0;  ///< without static power
  double static_w = 0;        ///< of the whole device
  std::map<std::string, double> rails;
  std::vector<Module> modules;  ///< their sum is the total
  bool per_frame = true;        ///< false: there were no results
  double energy_per_frame_mj = 0;
};

/// What the programmable logic takes of the device.
struct ResourceReport {
  struct Amount {
    double lut = 0, ff = 0, bram36 = 0, dsp = 0;
  };
  struct Module {
    std::string name;
    Amount amount;
    unsigned uncertainty_percent = 0;
    std::string source;
  };

  std::string device;
  std::vector<Module> modules;
  Amount total;
  Amount available;
  std::vector<std::string> over;  ///< "lut", "ff", "bram36", "dsp": what there is not enough of
};

/// What logic is built of.
struct Primitive {
  const char* key;   ///< in result.json
  const char* text;  ///< for people
  double ResourceReport::Amount::*amount;
};
inline constexpr Primitive primitives[] = {{"lut", "LUT", &ResourceReport::Amount::lut},
                                           {"ff", "FF", &ResourceReport::Amount::ff},
                                           {"bram36", "BRAM36", &ResourceReport::Amount::bram36},
                                           {"dsp", "DSP", &ResourceReport::Amount::dsp}};

/// Whether each module is fast enough for its clock.
struct TimingReport {
  struct Module {
    std::string name;
    std::string clock;
    double frequency_mhz = 0;  ///< the highest that the clock had
    double fmax_mhz = 0;
    bool lower_bound = false;  ///< it is known to work up to fmax, nobody says that it ends there
    bool met = true;
    double margin_percent = 0;  ///< by how much the clock could rise; negative: must fall
    std::string source;
    double reachable_mhz = 0;  ///< the highest clock up to fmax that the chip makes; 0: not known

    /// Clocked above what it is known to reach: it may work or not.
    bool unknown() const { return !met && lower_bound; }
    /// Clocked above what it can do.
    bool missed() const { return !met && !lower_bound; }
  };

  bool met = true;
  std::vector<Module> modules;
};

/// Whether the chip can have each clock.
struct ClockReport {
  struct Clock {
    std::string name;
    double wish_mhz = 0;       ///< asked for
    double frequency_mhz = 0;  ///< the highest that it had
    // What the vendor's tool makes of the wish, and with what.
    double made_mhz = 0;
    std::string pll;
    double vco_mhz = 0;
    unsigned feedback = 0;
    unsigned divisor0 = 1, divisor1 = 1;
    bool is_made = true;  ///< nearly the wish
    // The nearest that can be had instead; 0: none.
    double below_mhz = 0, above_mhz = 0;
    // Of the frequency that it had.
    double limit_mhz = 0;
    std::string limit_confidence;
    double margin_percent = 0;  ///< by how much it could rise up to the limit; negative: must fall
    bool within = true;         ///< of the speed grade
    bool makeable = true;       ///< PLLs and dividers give it
  };

  std::string device;
  std::string mode;  ///< "made" or "exact"
  bool legal = true;
  std::vector<Clock> clocks;
};

/// One line a clock beyond the speed grade.
std::vector<std::string> clock_warnings(const ClockReport& clocks);
/// One line a clock that is not what was asked for, or that no chip makes.
std::string clock_text(const ClockReport& clocks);

/// One line a module that misses timing: "pl.blob_detection misses timing: …".
std::vector<std::string> timing_warnings(const TimingReport& timing);
/// One line for each kind of primitive that is short.
std::vector<std::string> resource_warnings(const ResourceReport& resources);
/// A junction above what the device is specified for.
std::vector<std::string> power_warnings(const PowerReport& power);

/// "power", "timing" and "fits" for the console, a line each.
std::string design_text(const PowerReport& power, const ResourceReport& resources,
                        const TimingReport& timing);

}  // namespace platform::report

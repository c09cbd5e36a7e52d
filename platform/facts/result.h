#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <facts/unit.h>
#include <vp/power_meter.h>

/// What a run found, as plain values: filled by the simulation, read by
/// result.json, the console and the page. No simulation inside.

namespace platform::facts {

/// Energy of the modules of a group.
struct GroupEnergy {
  std::string group;  ///< "ps", "static", or a group of the design's
  double mj = 0;
};

/// Mean power until the last result of a run, upload of inputs excluded; of a run without results
/// over all frames, without frames over the whole run. Watts are on-chip power: the DDR chips are
/// not in them.
struct PowerReport {
  struct Module {
    std::string name;
    std::string rail;
    std::string kind;  ///< "static", "clock", "state", "event"
    double w = 0;
    double mj = 0;       ///< per frame
    std::string source;  ///< of the coefficient
  };
  /// RTL whose signals were counted.
  struct Activity {
    std::string name;
    double toggle_rate = 0;  ///< changes of a bit in a clock; the vendor's default is 0.125
    std::uint64_t bits = 0;  ///< of its signals
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
  std::vector<Activity> activity;
  bool per_frame = true;  ///< false: there were no results
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
    bool known = true;  ///< false: `source` says why, and `total` lacks it
  };

  std::string device;
  std::vector<Module> modules;
  Amount total;
  Amount available;
  std::vector<std::string> over;     ///< "lut", "ff", "bram36", "dsp": what there is not enough of
  std::vector<std::string> unknown;  ///< modules of which it is not known what they take
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
    double frequency_mhz = 0;   ///< the highest that the clock had
    double fmax_mhz = 0;        ///< up to this clock it works
    double fmax_high_mhz = 0;   ///< above this it does not; between them it is unknown
    bool met = true;            ///< its clock is one at which it works
    double margin_percent = 0;  ///< by how much the clock may rise up to fmax; negative: must fall
    std::string origin;         ///< of the range: "published", "derived", …, "configuration"
    std::string source;
    double reachable_mhz = 0;  ///< the highest clock up to fmax that the chip makes; 0: not known
    bool known = true;         ///< false: there is no fmax, and so no margin; `source` says why

    /// Clocked above what it can do.
    bool missed() const { return !met && known && frequency_mhz > fmax_high_mhz; }
    /// Clocked above what it is known to reach: it may work or not.
    bool unknown() const { return !met && !missed(); }
    /// By how much the clock could rise at most.
    double most_margin_percent() const { return 100 * (fmax_high_mhz / frequency_mhz - 1); }
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
    double legal_mhz = 0;  ///< of a clock beyond its limit: the nearest that can be had; 0: none
    // Of the frequency that it had.
    double limit_mhz = 0;
    std::string limit_confidence;
    double margin_percent = 0;  ///< by how much it could rise up to the limit; negative: must fall
    bool within = true;         ///< of the speed grade
    bool makeable = true;       ///< PLLs and dividers give it
    bool external = false;      ///< comes in at a pin: nothing in the chip makes it
    bool used = true;  ///< of the PL: the design has logic for it; else the verdict ignores it
  };

  std::string device;
  std::string mode;  ///< "made" or "exact"
  bool legal = true;
  std::vector<Clock> clocks;
};

/// What a design counts of a frame, in the order of reports. Names are keys in `counts` of
/// result.json: "words", "late_packets".
class Counts {
 public:
  struct Count {
    std::string name;
    std::uint64_t value = 0;
    bool lost = false;  ///< found no room, or was damaged by that
  };

  /// Sets what came of the frame.
  void set(const std::string& name, std::uint64_t value) { entry(name, false) = value; }
  /// Sets what was lost of it.
  void lose(const std::string& name, std::uint64_t value) { entry(name, true) = value; }

  const std::vector<Count>& list() const { return list_; }
  /// 0 for what the design does not count.
  std::uint64_t operator[](const std::string& name) const;
  /// All that was lost.
  std::uint64_t lost() const;

 private:
  std::uint64_t& entry(const std::string& name, bool lost);

  std::vector<Count> list_;
};

/// Simulated time that one stage took, ps. The name is the key in `time_us`.
struct StageTime {
  std::string name;
  std::uint64_t ps = 0;
  std::uint64_t start_ps = 0;  ///< when it began; not part of result.json
  std::string part_of = {};    ///< the stage whose time contains this one's; empty: none
  std::string clock = {};      ///< "ps.fclk_clk1": it lasts so many cycles of it; empty: none alone
  std::string why = {};        ///< why it takes its time, for who asks what limits a frame
  std::vector<std::string> levers = {};  ///< settings with which it takes less: "sw.second_core=1"
  bool waits = false;  ///< it only waits for other stages, and so never limits the frame rate
};

/// True if other stages of the list are parts of `stage`: what is shown as parts of a whole leaves
/// it out.
bool has_parts(const std::vector<StageTime>& stages, const std::string& stage);

/// One unit of work and what came of it.
struct UnitReport {
  std::string input;        ///< name of the input, no path; empty: the design takes none
  SharedInput given = {};   ///< the input; null: the design takes none
  std::uint32_t index = 0;  ///< 0, 1, 2 … in the order of the run
  Counts counts;
  std::vector<UnitFigure> figures = {};
  std::vector<StageTime> times;  ///< in the order of the flow; "frame" and "upload" among them
  std::uint64_t start_ps = 0;    ///< simulated time at which work on the unit began, upload done
  std::uint64_t end_ps = 0;      ///< simulated time of its last result
  /// From its input to the next one that the program took, where inputs come at a fixed rate.
  std::optional<vp::Interval> camera_period = {};
  /// Inputs that came in it while the program was busy; 0: the program waited for the next one.
  /// None: no next input came.
  std::optional<std::uint64_t> camera_missed = {};
  /// How often the input was given before, so that what the logic learns from it is its own, and
  /// when the last of these results came: the period of this unit begins there.
  std::uint32_t settling_showings = 0;
  std::uint64_t settled_ps = 0;
  std::uint64_t upload_ps = 0;  ///< time before `start_ps` in which the input was only uploaded
  std::string gave_up = {};     ///< why the software gave the unit up; empty: it has a result
  /// Why the unit does not do the design's job, by the design's own rule: "with an echo". A unit
  /// that was given up, or lost something, fails it in any case.
  std::vector<std::string> failures = {};
  std::vector<std::string> tallies = {};  ///< names of Work::tallies that hold for it
  std::vector<GroupEnergy> energy;        ///< its period's, upload excluded; empty: not known
  std::vector<std::string> warnings;
  std::shared_ptr<UnitExtra> extra = {};  ///< of the application; may be null

  /// Whether a result was delivered: only such units make rates, latency and energy.
  bool delivered() const { return gave_up.empty(); }
  /// Whether it did its job.
  bool fulfilled() const { return delivered() && failures.empty() && counts.lost() == 0; }
};

/// Inputs that come at a fixed rate, as of a camera, and how the program kept up with it.
///
/// One comes every 1 / rate. One that comes while the program is busy is dropped as a whole.
struct CameraReport {
  double rate_fps = 0;
  std::uint64_t offered = 0;  ///< inputs that came until the program was ready for one more
  std::uint64_t dropped = 0;  ///< of these
  // Of each input that was taken.
  double busy_ps = 0;  ///< mean, from the input until the program was ready for the next
  double most_busy_ps = 0;

  double period_ps() const { return 1e12 / rate_fps; }
  /// Share of the period in which the program was busy, %; above 100 inputs are lost.
  double utilisation_percent() const { return 100 * busy_ps / period_ps(); }
};

/// How the PS program ended.
struct ProgramEnd {
  int exit_code = 0;     ///< what it returned; 0: all went well
  std::uint64_t ps = 0;  ///< when, in simulated time
  /// It did not end by itself, but was in an endless loop when its time was up (ps.cpu.timeout).
  bool reached_limit = false;
  /// When its main() returned, if interrupts or the other core had work after that.
  std::optional<std::uint64_t> main_ps;
};

/// A fault that the configuration asked for (`inject`), and what came of it.
struct Injected {
  std::string fault;           ///< as it was written
  std::uint64_t times = 0;     ///< how often it happened; 0: never in this run
  std::uint64_t first_ps = 0;  ///< when it did first
};

/// The design point that ran.
struct RunFacts {
  std::string fidelity;                                  ///< "tlm" or "clocked"
  std::string system;                                    ///< the PS program
  std::string design;                                    ///< what is in the PL
  Work work = {};                                        ///< what the design does
  std::string profile;                                   ///< cost table of the software
  std::map<std::string, std::string> configuration;      ///< path -> "value unit"
  std::optional<ProgramEnd> end = std::nullopt;          ///< of the program; none: it was stopped
  std::optional<std::string> incomplete = std::nullopt;  ///< why the run ended early, if it did
  std::uint64_t unpublished = 0;  ///< inputs of which the program that ended published nothing
  std::optional<CameraReport> camera = std::nullopt;  ///< none: inputs came when they were wanted
  // What the design costs; none: not known.
  std::optional<PowerReport> power = std::nullopt;
  std::optional<ResourceReport> resources = std::nullopt;
  std::optional<TimingReport> timing = std::nullopt;
  std::optional<ClockReport> clocks = std::nullopt;
  /// Parts of the design in whose place a stub answered the program: what came of it rests on them.
  std::vector<std::string> stubs = {};
  std::vector<Injected> injected = {};
  std::vector<std::string> warnings = {};  ///< that belong to no frame
  std::vector<std::string> notes = {};     ///< what was assumed of the inputs, or done to them
};

/// Everything that may differ between two runs of the same design point on the same inputs.
struct Provenance {
  std::string program;             ///< "markervp"
  std::string version;             ///< of the program
  std::string revision;            ///< of its sources, as git describes it; may be empty
  std::string configuration_hash;  ///< 16 hexadecimal digits
  std::vector<std::string> command_line;
  std::string host;
  std::string date;        ///< start of the run, UTC, ISO 8601
  double wall_time_s = 0;  ///< of the whole run
  /// Further facts by name, in order: "output", "trace", "camera" …
  std::vector<std::pair<std::string, std::string>> details;
};

/// What software sees of the platform: addresses, registers, interrupts, clocks.
struct HardwareMap {
  /// Some bits of a register.
  struct Field {
    std::string name;
    std::uint32_t mask = 0;
    std::string access;
    std::uint32_t reset = 0;  ///< of this build, shifted down
    std::string documentation;
  };
  struct Register {
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t declared_reset = 0;  ///< of the full build
    std::uint32_t reset = 0;           ///< of this build
    bool built = true;                 ///< false: reads 0, ignores writes
    std::uint32_t at_start = 0;        ///< when the program starts: boot code has run
    std::string access;                ///< "rw", "ro", "wo", "w1c", "w1s", "w1t"
    std::uint32_t writable = 0;        ///< bits that a write can change
    std::string documentation;
    std::vector<Field> fields = {};        ///< from the lowest bit on; none: all bits are alike
    const void* fields_of_kind = nullptr;  ///< the same for registers with the same fields
  };
  /// A range of addresses of the processor.
  struct Device {
    std::string name;  ///< "axi_gpio_0"
    std::string what;  ///< "AXI GPIO (PG144)"
    std::string path;  ///< of its registers or memory in the platform: "pl.axi_gpio_0.s_axi"
    std::uint64_t base = 0;
    std::uint64_t size = 0;
    std::string way;                    ///< through what the processor reaches it: "m_axi_gp0"
    std::vector<Register> registers;    ///< none: memory
    const void* description = nullptr;  ///< the same for devices of one kind
  };
  struct Interrupt {
    std::uint32_t id = 0;
    std::string source;
  };
  struct Clock {
    std::string name;
    std::uint64_t hertz = 0;       ///< at the start
    std::string set_by;            ///< register; empty: not software
    std::uint64_t programmed = 0;  ///< what that register gives, Hz
  };

  std::vector<Device> devices;  ///< by address
  std::vector<Interrupt> interrupts;
  std::vector<Clock> clocks;
  std::string xparameters = {};  ///< the text of xparameters.h
};

}  // namespace platform::facts

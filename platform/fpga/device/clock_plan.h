#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <fpga/device/device.h>

/// The frequencies that PLLs and dividers of the processing system make, and which of them the
/// vendor's configurator picks for a wish. Its rules were derived from what it printed for public
/// designs (docs/devices.md).
namespace platform::device {

/// A crystal is off by so much (50 ppm) anyway: nearer frequencies count as the same.
constexpr double crystal_tolerance = 50e-6;
/// The crystal of a ZedBoard, Hz.
constexpr double zedboard_crystal_hz = 100e6 / 3;

bool same_frequency(double hz, double wish_hz);

enum class Pll { arm, ddr, io };
const char* to_string(Pll pll);

/// What the dividers behind a PLL divide by.
enum class Divider {
  cpu,     ///< one divider, without 1 and 3 (UG585)
  ddr,     ///< one divider, even numbers only
  single,  ///< one divider: peripherals
  pair,    ///< two dividers, one after the other: FCLK, Ethernet
};

/// A frequency and what makes it: crystal x feedback / (divisor0 x divisor1).
struct MadeClock {
  Pll pll = Pll::io;
  unsigned feedback = 0;
  unsigned divisor0 = 1, divisor1 = 1;
  double vco_hz = 0;
  double hz = 0;
};

/// A clock that the I/O PLL feeds.
struct IoClient {
  double wish_hz = 0;
  Divider divider = Divider::single;
  bool exact = false;  ///< must be met: Ethernet
};

/// What the I/O PLL of a ZedBoard feeds beside the PL: PCAP, QSPI, SD card, UART and, with
/// `ethernet`, 125 MHz for Ethernet.
std::vector<IoClient> board_clients(bool ethernet);
/// The wish of the UARTs among them.
constexpr double uart_wish_hz = 50e6;

/// A clock with a limit of its own.
enum class ClockKind {
  cpu_621,  ///< CPU_6x4x, ratio 6:2:1
  cpu_421,  ///< CPU_6x4x, ratio 4:2:1
  ddr,
  fclk,
  external,  ///< comes in at a pin: no PLL makes it
};
const Figure& limit_of(const Device& device, ClockKind kind);  ///< MHz
Divider divider_of(ClockKind kind);

/// What the clocks of a chip shall be. The defaults are those of a ZedBoard.
struct ClockWishes {
  double cpu_hz = 2e9 / 3;
  bool ratio_621 = true;  ///< 6:2:1, or 4:2:1
  double ddr_hz = 1.6e9 / 3;
  std::vector<double> fclk_hz;  ///< from the I/O PLL
  bool ethernet = true;         ///< the I/O PLL feeds Ethernet
};

/// What the vendor's tool makes of it.
struct ClockPlan {
  MadeClock cpu, ddr, uart;
  std::vector<MadeClock> fclk;
  unsigned io_feedback = 0;
};

/// What it takes to have a clock beside the others of a plan.
enum class Effort {
  planned,         ///< nothing: the vendor's tool makes it
  other_source,    ///< an FCLK from the ARM or DDR PLL
  other_feedback,  ///< the I/O PLL set by hand; other I/O clocks move
  no_ethernet,     ///< the same, and there are no 125 MHz any more
};
const char* to_string(Effort effort);

struct NearClock {
  MadeClock clock;
  Effort effort = Effort::planned;
};

class ClockPlanner {
 public:
  /// `device` must outlive it. Throws vp::InputError for a crystal that the device does not take.
  ClockPlanner(const Device& device, double crystal_hz);

  const Device& device() const { return device_; }

  /// All clocks of a chip, as the vendor's tool makes them.
  ClockPlan plan(const ClockWishes& wishes) const;

  /// Behind a PLL whose feedback is given: the nearest to `wish_hz`, above or below. With `most_hz`
  /// only frequencies up to there, if there are any.
  MadeClock nearest(unsigned feedback, double wish_hz, Divider divider,
                    std::optional<double> most_hz = {}) const;

  /// The feedback of the I/O PLL: the least sum of deviations over all clients, of equal ones the
  /// highest. Clients that are `exact` are met, if any feedback does.
  unsigned io_feedback(const std::vector<IoClient>& clients) const;

  /// A clock with a PLL of its own (not fclk): the nearest to the wish, of equally near ones that
  /// with the highest PLL. Not above the limit unless the wish is. `beside`: what else the PLL
  /// feeds, and must be exact.
  MadeClock own_pll(double wish_hz, ClockKind kind, const std::vector<IoClient>& beside = {}) const;

  /// The nearest that the vendor's tool makes at or below the wish, and above it: an FCLK behind
  /// the I/O PLL of `plan`, others with any feedback. None above the limit unless the wish is.
  struct Neighbours {
    std::optional<MadeClock> below, above;
  };
  Neighbours neighbours(double wish_hz, ClockKind kind, const ClockPlan& plan) const;

  /// What any feedback and divisor give near the wish, each frequency once: the nearest first, each
  /// with the least effort beside `plan`. None above the limit unless the wish is. `ethernet`:
  /// whether there is something to lose.
  std::vector<NearClock> near(double wish_hz, ClockKind kind, const ClockPlan& plan, bool ethernet,
                              std::size_t count) const;

  /// Whether some feedback and divisor give `hz`, within crystal_tolerance.
  bool makes(double hz, ClockKind kind) const;

 private:
  const std::vector<unsigned>& divisors(Divider divider) const;
  MadeClock made(unsigned feedback, double wish_hz, Divider divider, unsigned divisor) const;
  bool meets(unsigned feedback, const std::vector<IoClient>& clients) const;
  std::optional<double> most(double wish_hz, ClockKind kind) const;
  NearClock with_effort(MadeClock clock, const ClockPlan& plan, bool ethernet) const;

  const Device& device_;
  double crystal_hz_;
  unsigned least_feedback_, most_feedback_;  ///< of outputs in range
  unsigned largest_divisor_;
  std::vector<unsigned> cpu_, ddr_, single_, pair_;  ///< products, ascending
};

/// Whether a clock can be on a chip.
struct ClockVerdict {
  double limit_hz = 0;
  Confidence confidence = Confidence::assumed;  ///< of the limit
  double margin_percent = 0;  ///< by how much it could rise up to the limit; negative: must fall
  bool within = true;         ///< of the speed grade
  bool makeable = true;       ///< PLLs and dividers give it, by some plan

  bool legal() const { return within && makeable; }
};

/// Judges a clock for itself. A stopped one (0 Hz) is legal.
ClockVerdict judge(const ClockPlanner& planner, ClockKind kind, double hz);

}  // namespace platform::device

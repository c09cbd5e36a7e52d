#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <facts/result.h>

namespace platform::facts {

/// What sets the frame rate of a run, and what raises it.
struct Limit {
  enum class Kind {
    /// The stages follow one another: each adds to the period, the longest one the most.
    sequence,
    /// Stages that work while the software is at the frame before are still busy when it is ready.
    ahead,
    /// The stages that follow those take longer.
    behind,
    /// The next input comes later than the program wants it.
    camera,
  };

  Kind kind = Kind::sequence;
  std::vector<std::string> stages;  ///< that set the period, in the order of the flow
  double stages_us = 0;             ///< they take so long together, mean; the camera: its period
  double period_us = 0;             ///< mean of the periods that they set
  /// How much of the run's time each stage sets the period; "camera" comes last.
  std::vector<std::pair<std::string, double>> percent;
  // Of the longest of `stages`, as in StageTime.
  std::string clock, why;
  std::vector<std::string> levers;

  /// "capture sets the frame rate: 3072.0 of 3080.1 us, other stages overlap".
  std::string text(const Work& work) const;
  /// "pl.pixels_per_clock=2, or a higher ps.fclk_clk0.frequency"; empty: no lever is known.
  std::string levers_text() const;
};

/// As result.json has it.
const char* to_string(Limit::Kind kind);

/// Finds the limit from the frames of a run, in order. Frames may differ: what sets the period for
/// most of the run's time is the limit.
class LimitFinder {
 public:
  /// `period_ps`: the frame's own (FramePeriods).
  void add(const UnitReport& frame, std::uint64_t period_ps);
  /// None: no result has stages that are parts of its frame.
  std::optional<Limit> limit() const;

 private:
  /// Frames with the same limit.
  struct Group {
    Limit limit;
    std::uint64_t period_ps = 0;
    std::uint64_t stages_ps = 0;
    std::uint64_t frames = 0;

    void add(const Group& other);
    bool has_same_stages(const Group& other) const;
  };

  void note_stages(const UnitReport& frame);
  std::optional<Group> judge(const UnitReport& frame, std::uint64_t period_ps) const;
  void keep(Group group);

  std::optional<std::uint64_t> last_end_ps_;
  std::vector<std::string> names_;  ///< of stages that could set the period
  std::vector<Group> groups_;
  /// Of a frame that says little, with nothing before it or nothing after it: it counts only if
  /// there is no other.
  std::optional<Group> incomplete_;
};

}  // namespace platform::facts

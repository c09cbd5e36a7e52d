#pragma once

#include <optional>
#include <string>
#include <vector>

#include <facts/result.h>
#include <facts/summary.h>

/// The verdict on a design point: the one rule of what is feasible. Console and page show it,
/// sweeps and their analyses read it from result.json.
namespace platform::result {

enum class Holds { no, unknown, yes };  // the worse, the less

/// "no", "unknown", "yes".
const char* to_string(Holds holds);

/// The names of its parts, in order.
inline constexpr const char* verdict_parts[] = {"ran", "job", "fits", "clocks", "timing"};

struct Verdict {
  struct Part {
    const char* name;
    Holds holds = Holds::yes;
    /// How far from the limit, in % of what is used; negative: beyond. None: there is no limit.
    std::optional<double> margin_percent = std::nullopt;
    std::string by = {};   ///< what is nearest to the limit, or furthest beyond
    std::string why = {};  ///< why it does not hold, or is unknown
  };

  /// "ran": the program ended by itself, with 0.
  /// "job": each unit of work has a result, nothing was lost in buffers, and the design's own rule
  ///        holds (facts::Work, UnitReport::failures); of inputs at a fixed rate none was lost. The
  ///        margin is the share of such units, less 100 %. Of a design that delivers nothing it is
  ///        done when the program ends well, which "ran" says.
  /// "fits": LUT, flip-flops, block memories and DSP of the device; unknown where those of a part
  ///         are, unless the others alone are too many.
  /// "clocks": CPU and DDR, and those FCLK that the design uses, are within the speed grade, and
  ///           PLLs and dividers make them. A clock that nothing uses fails nothing: the console
  ///           notes it.
  /// "timing": no IP is clocked above its Fmax; unknown inside the range where that lies.
  std::vector<Part> parts;

  /// The worst of all parts.
  Holds feasible() const;
  /// Why it is not feasible: of each part that is not `yes`.
  std::vector<std::string> reasons() const;
};

/// What is not known of the facts is `unknown`. Without a PL there is nothing that must fit or be
/// fast enough.
Verdict verdict_of(const facts::RunFacts& facts, const facts::Summary& summary);

/// Its part "job".
Verdict::Part job_of(const facts::RunFacts& facts, const facts::Summary& summary);

/// The module that says most about the clocks: the one with the least margin, up to the clock at
/// which it surely works; of those that miss theirs if there are any, else of those of which it is
/// not knows. Verdict, console and page name it. `timing` has modules.
const facts::TimingReport::Module& critical_module(const facts::TimingReport& timing);

}  // namespace platform::result

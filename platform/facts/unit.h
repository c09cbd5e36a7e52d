#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <facts/figure.h>
#include <nlohmann/json_fwd.hpp>

/// A unit of work: what a design delivers again and again (a frame, a packet, a block of samples),
/// what it is given for one, and when it has done its job.

namespace platform::facts {

/// What a program is given for one unit of work. Kinds of input derive from it; without one it is
/// a unit that brings nothing.
class UnitInput {
 public:
  UnitInput() = default;
  explicit UnitInput(std::string input_name) : name(std::move(input_name)) {}
  UnitInput(const UnitInput&) = default;
  UnitInput(UnitInput&&) = default;
  UnitInput& operator=(const UnitInput&) = default;
  UnitInput& operator=(UnitInput&&) = default;
  virtual ~UnitInput() = default;

  /// What the program finds in memory: `height` rows of `width` bytes, one after the other.
  virtual const std::vector<std::uint8_t>& bytes() const;
  virtual std::uint32_t width() const { return static_cast<std::uint32_t>(bytes().size()); }
  virtual std::uint32_t height() const { return 1; }
  /// Whether it has nothing to do with the one before it, so that logic which learns from one unit
  /// for the next must be given it again (Design::settling_showings). `before`: null for the first.
  virtual bool settles_after(const UnitInput* /*before*/) const { return false; }

  std::string name;  ///< in reports; no folders
};

using SharedInput = std::shared_ptr<const UnitInput>;

/// Inputs one after the other, in memory that does not grow with their number.
class InputSource {
 public:
  virtual ~InputSource() = default;

  /// The next one; null when there are no more. Throws vp::InputError that names the input.
  virtual SharedInput next() = 0;
  /// How many there are, if that is known.
  virtual std::optional<std::uint64_t> size() const = 0;
  /// What the user should know and is no error, once each, complete after the last one.
  virtual const std::vector<std::string>& warnings() const = 0;
  /// What was assumed, and done to the inputs as the user asked for; the same way.
  virtual const std::vector<std::string>& notes() const = 0;
};

/// What a design takes for each unit.
struct InputNeed {
  std::string kind = "none";  ///< InputKind::name
  std::size_t bytes = 0;      ///< of one
  std::string shape = {};     ///< what else the kind must know, in its own words: "640x480"

  bool operator<(const InputNeed& other) const {
    return std::tie(kind, bytes, shape) < std::tie(other.kind, other.bytes, other.shape);
  }
};

/// Something that holds for a unit or not, and that a run counts.
struct Tally {
  std::string name;                 ///< "echoes"
  std::string with;                 ///< of the units for which it holds: "with an echo"
  std::string without;              ///< of one for which it does not: "no echo"
  bool is_figure = true;            ///< `summary` of result.json has it; else units list it
  Better better = Better::neither;  ///< many of them, or few
};

/// What a design does.
struct Work {
  /// "frame", "packet". Empty: it delivers nothing, and its job is its program's good end.
  std::string unit = {};
  std::string job = {};         ///< what it must do, a phrase: "every packet comes back unchanged"
  std::string plural = {};      ///< empty: `unit` and an s
  std::string given = "input";  ///< what comes for one at a fixed rate: "sample"
  std::vector<Tally> tallies = {};
  /// What report() finds of each unit. The path is one name: "snr".
  std::vector<Figure> figures = {};
  /// Of inputs that were given more than once (UnitReport::settling_showings).
  std::string settled = "were given before, so that what the logic learned from each is its own";

  /// "1 packet", "2 packets". Of a design that delivers nothing it counts runs.
  std::string counted(std::uint64_t count) const;
  std::string many() const { return plural.empty() ? unit + "s" : plural; }
  /// Its tallies and figures by their paths in a run: "summary.echoes", "frames.figures.snr".
  std::vector<Figure> declared() const;
};

/// A number that a design finds of a unit, once in a unit.
struct UnitFigure {
  std::string name;  ///< of Work::figures
  double value = 0;
  std::string unit = {};  ///< the platform takes it from the declaration
};

/// What an application says of a unit of work beside what every design does.
class UnitExtra {
 public:
  using Json = nlohmann::ordered_json;
  using Sample = std::function<void(const std::string& name, double value)>;
  enum class Place { behind_index, before_counts, behind_counts };

  virtual ~UnitExtra() = default;

  /// What came of it, on one line: "an echo at 3 ms".
  virtual std::string heading() const = 0;
  /// Further lines for the console: label and text.
  virtual std::vector<std::pair<std::string, std::string>> lines() const { return {}; }
  /// Behind the counts on the console; may be empty.
  virtual std::string counts_text() const { return {}; }
  /// Adds members to the unit's entry in result.json.
  virtual void add_members(Place /*place*/, Json& /*json*/) const {}
  /// Numbers of which the run's summary keeps mean, least and largest; a name may come repeatedly.
  virtual void add_samples(const Sample& /*sample*/) const {}
  /// Whether settings and inputs belong together: none if that is not known, "" if they do, else
  /// why they do not. A run in which no unit's do ends with exit code 2.
  virtual std::optional<std::string> misfit() const { return std::nullopt; }
};

}  // namespace platform::facts

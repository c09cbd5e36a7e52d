#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <facts/unit.h>
#include <study/spec.h>
#include <vp/configuration.h>
#include <vp/expression.h>
#include <vp/unit.h>
#include <nlohmann/json.hpp>

namespace platform::study {

/// What a parameter takes, as its description tells.
struct ParameterKind {
  enum class Kind { quantity, truth, text };

  Kind kind = Kind::text;
  vp::Unit unit = vp::Unit::none;  ///< of a quantity
};

ParameterKind kind_of(const vp::ParameterDescription& description);

/// The value as in the effective configuration: "50000 kHz" is "50 MHz". Throws
/// vp::InputError, which continues a sentence that began with key and value, if it is malformed.
std::string normalised(const ParameterKind& kind, const std::string& text);

/// The value in the base unit; 1 and 0 for true and false. Throws vp::InputError for a text.
double number_of(const ParameterKind& kind, const std::string& text);

/// What it is in an expression.
vp::ExpressionValue value_of(const ParameterKind& kind, const std::string& text);

/// A platform that was built, and is gone.
struct Elaborated {
  std::vector<vp::ParameterDescription> parameters;
  facts::InputNeed input;  ///< what its design takes
  /// Figures that its design declares (result::own_figures_json).
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
};

/// The parameters of a platform.
class ParameterTable {
 public:
  explicit ParameterTable(const Elaborated& elaborated);

  /// Throws vp::InputError for an unknown path, with the nearest; `where` says who asked.
  const vp::ParameterDescription& find(const std::string& path,
                                       const std::string& where = "") const;
  bool has(const std::string& path) const { return index_.count(path) != 0; }
  ParameterKind kind(const std::string& path) const;
  std::vector<std::string> paths() const;
  /// The effective values by path.
  std::map<std::string, std::string> values() const;
  /// The defaults by path: some follow from other values.
  std::map<std::string, std::string> defaults() const;
  const facts::InputNeed& input() const { return input_; }

 private:
  std::vector<vp::ParameterDescription> parameters_;
  std::map<std::string, std::size_t> index_;
  facts::InputNeed input_;
};

/// The values of an axis, as they stand in the effective configuration: a list, or any value
/// between two.
class AxisValues {
 public:
  /// Throws vp::InputError for a value that is malformed, has a wrong unit, or makes no range.
  AxisValues(const Axis& axis, const ParameterKind& kind);

  const std::string& path() const { return path_; }
  const std::string& where() const { return where_; }
  /// The list; of a range without step and count, its two ends.
  const std::vector<std::string>& values() const { return values_; }
  /// True for a range without step and count: only a sample can take values of it.
  bool continuous() const { return continuous_; }
  /// Whether its values lie on a line: those of a quantity.
  bool ordered() const { return kind_.kind == ParameterKind::Kind::quantity; }

  /// Those one step down and up from a value: the next of a list; of a range without step a
  /// twentieth of it away; of words all others.
  std::vector<std::string> neighbours(const std::string& value) const;

  /// The value for a sample u in 0 … 1, 1 excluded.
  std::string sampled(double u) const;
  /// The value at a level from 0 (first) to 1 (last).
  std::string at_level(double level) const;
  /// What at_level() made of a level: where the value really lies from 0 to 1.
  double level_of(double level) const;

 private:
  void make_list(const std::vector<std::string>& written, const ParameterKind& kind);
  void make_range(const ValueRange& range);
  void add_steps(double step, const std::string& written_step);
  double end(const std::string& text, const char* name) const;
  double between(double u) const;
  std::string written(double value) const;
  [[noreturn]] void fail(const std::string& problem) const;

  std::string path_;
  std::string where_;
  ParameterKind kind_;
  std::vector<std::string> values_;
  bool continuous_ = false;
  bool whole_ = false;
  bool logarithmic_ = false;
  double start_ = 0;
  double stop_ = 0;
};

/// Axes that move together, with their values.
using AxisGroup = std::vector<AxisValues>;

}  // namespace platform::study

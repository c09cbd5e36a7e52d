#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sweep/parameter_table.h>
#include <sweep/spec.h>

namespace platform::sweep {

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

}  // namespace platform::sweep

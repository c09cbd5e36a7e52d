#pragma once

#include <vp/configuration.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>
#include <vector>

namespace vp {

/// Smallest and largest allowed value, in the base unit.
template <class T>
struct Range {
  T min = std::numeric_limits<T>::lowest();
  T max = std::numeric_limits<T>::max();
};

/// The names of an enum's values, as the user writes them.
template <class E>
using Choices = std::vector<std::pair<std::string, E>>;

/// The part of a parameter that does not depend on its type. Its hierarchical name is the
/// configuration key.
class ParameterBase : public sc_core::sc_object {
 public:
  const char* kind() const override { return "vp::Parameter"; }
  Unit unit() const { return unit_; }
  Source source() const { return source_; }
  const std::string& documentation() const { return documentation_; }
  /// True if its value is not the default. Nothing may depend on whether a user wrote the default
  /// down: `markervp config` writes down all values, and a run of that file is the same run.
  bool is_changed() const { return is_changed_; }
  /// Says that the default was computed from `others`, their paths: `markervp config` shows such a
  /// default, but does not write it down as a value.
  void follows(const std::string& others) const;
  /// The value as the effective configuration shows it, with its unit.
  const std::string& text() const { return text_; }

 protected:
  ParameterBase(const char* name, Unit unit, Source source, std::string documentation);

  /// What the user set for this parameter in the current configuration; null if nothing.
  const Setting* any_setting() const;
  /// The same. Throws InputError for a list.
  const Setting* setting() const;
  /// Registers the parameter, once its value is known.
  void publish(std::string value, std::string default_value, std::string allowed);
  /// The value of `setting` as a whole number. Throws InputError if it is not one, or outside
  /// min … max.
  Decimal::Whole whole_value(const Setting& setting, Decimal::Whole min, Decimal::Whole max) const;
  /// The same for real numbers.
  double real_value(const Setting& setting, double min, double max) const;
  bool truth_value(const Setting& setting) const;
  /// Position of the chosen name. Throws InputError with the nearest match if it is not in `names`.
  std::size_t choice(const Setting& setting, const std::vector<std::string>& names) const;
  /// Throws ParameterError for a setting: key, value, where it was set, and `problem`.
  [[noreturn]] void refuse(const Setting& setting, const std::string& problem) const;
  /// Throws std::logic_error: the code declares the parameter wrongly.
  [[noreturn]] void misdeclared(const std::string& problem) const;

  /// "0 to 255"; for documentation without a limit that is only the type's.
  std::string whole_range(Decimal::Whole min, Decimal::Whole max) const;
  template <class T>
  std::string documented_range(const Range<T>& range) const {
    constexpr Range<T> type;
    if (range.max != type.max) return whole_range(range.min, range.max);
    if (range.min == type.min) return "";
    return "at least " + format_quantity(Decimal(range.min, 0), unit_);
  }
  std::string real_range(double min, double max) const;

 private:
  Unit unit_;
  Source source_;
  std::string documentation_;
  std::string text_;
  bool is_changed_ = false;
};

/// A named value that the user can change: a member of the module that uses it, fixed when it is
/// constructed.
///
///   vp::Parameter<std::uint32_t> threshold{
///       "threshold", 30, vp::Unit::none, {0, 255}, vp::Source::decision, "least difference"};
///   vp::Parameter<std::uint64_t> clock{
///       "clock", 50_MHz, vp::Unit::frequency, vp::Source::published, "pixel clock"};
///   vp::Parameter<bool> enabled{"enabled", true, vp::Source::decision, "…"};
///   vp::Parameter<std::string> variant{
///       "variant", "thesis", {"thesis", "merging"}, vp::Source::published, "…"};
///   vp::Parameter<Fidelity> fidelity{
///       "fidelity", Fidelity::tlm,
///       {{"clocked", Fidelity::clocked}, {"tlm", Fidelity::tlm}}, vp::Source::decision, "…"};
///
/// This one is for integers and double; values are in the base unit of `unit` (Hz, ps, B, m, W …).
template <class T, class Enable = void>
class Parameter : public ParameterBase {
  static_assert(std::is_integral_v<T> || std::is_same_v<T, double>,
                "bool, integers, double, std::string or an enum");

 public:
  Parameter(const char* name, T default_value, Unit unit, Source source, std::string documentation)
      : Parameter(name, default_value, unit, Range<T>{}, source, std::move(documentation)) {}

  Parameter(const char* name, T default_value, Unit unit, Range<T> range, Source source,
            std::string documentation)
      : ParameterBase(name, unit, source, std::move(documentation)), value_(default_value) {
    if (!(range.min <= default_value && default_value <= range.max))
      misdeclared("its default is out of range");
    if (const Setting* given = setting()) value_ = read(*given, range);
    if constexpr (std::is_integral_v<T>) {
      publish(written(value_), written(default_value), documented_range(range));
    } else {
      publish(written(value_), written(default_value), real_range(range.min, range.max));
    }
  }

  T get() const { return value_; }
  operator T() const { return value_; }

 private:
  T read(const Setting& given, const Range<T>& range) const {
    if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(whole_value(given, range.min, range.max));
    } else {
      return real_value(given, range.min, range.max);
    }
  }
  std::string written(T value) const {
    if constexpr (std::is_integral_v<T>) {
      return format_quantity(Decimal(value, 0), unit());
    } else {
      return format_quantity(Decimal(value), unit());
    }
  }

  T value_;
};

/// true or false (also yes, no, on, off).
template <>
class Parameter<bool> : public ParameterBase {
 public:
  Parameter(const char* name, bool default_value, Source source, std::string documentation)
      : ParameterBase(name, Unit::none, source, std::move(documentation)), value_(default_value) {
    if (const Setting* given = setting()) value_ = truth_value(*given);
    publish(value_ ? "true" : "false", default_value ? "true" : "false", "true or false");
  }

  bool get() const { return value_; }
  operator bool() const { return value_; }

 private:
  bool value_;
};

/// A text: any, or one of several names.
template <>
class Parameter<std::string> : public ParameterBase {
 public:
  Parameter(const char* name, std::string default_value, Source source, std::string documentation);
  Parameter(const char* name, std::string default_value, std::vector<std::string> choices,
            Source source, std::string documentation);

  const std::string& get() const { return value_; }
  operator const std::string&() const { return value_; }

 private:
  std::string value_;
};

/// A list of maps, which its owner reads: "[{what: flip, bit: 3}]". Empty as default.
class ListParameter : public ParameterBase {
 public:
  ListParameter(const char* name, Source source, std::string documentation);

  /// As YAML in one line.
  const std::string& get() const { return value_; }
  /// Where it was set.
  const std::string& origin() const { return origin_; }

 private:
  std::string value_;
  std::string origin_;
};

/// One of an enum's values, written by name.
template <class E>
class Parameter<E, std::enable_if_t<std::is_enum_v<E>>> : public ParameterBase {
 public:
  Parameter(const char* name, E default_value, const Choices<E>& choices, Source source,
            std::string documentation)
      : ParameterBase(name, Unit::none, source, std::move(documentation)), value_(default_value) {
    std::vector<std::string> names;
    std::string default_name;
    for (const auto& [text, value] : choices) {
      names.push_back(text);
      if (value == default_value) default_name = text;
    }
    if (default_name.empty()) misdeclared("its default is not one of its choices");
    std::string value_name = default_name;
    if (const Setting* given = setting()) {
      const std::size_t chosen = choice(*given, names);
      value_ = choices[chosen].second;
      value_name = names[chosen];
    }
    publish(value_name, default_name, one_of(names));
  }

  E get() const { return value_; }
  operator E() const { return value_; }

 private:
  E value_;
};

}  // namespace vp

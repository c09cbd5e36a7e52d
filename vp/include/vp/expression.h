#pragma once

#include <vp/unit.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// The value of an expression or of a name in it: a number with its dimension, a text, or a number
/// that is unknown.
struct ExpressionValue {
  ExpressionValue() = default;
  /// 64 bits of mantissa hold every vector of a trace and every double exactly.
  ExpressionValue(long double plain) : number(plain), known(plain == plain) {}
  static ExpressionValue unknown() {
    ExpressionValue value;
    value.known = false;
    return value;
  }

  long double number = 0;  ///< in the base unit
  Unit unit = Unit::none;
  bool known = true;
  bool is_text = false;
  std::string text;

  bool holds() const { return known && number != 0; }
};

/// Where an expression finds the values of its names.
class ExpressionValues {
 public:
  virtual ~ExpressionValues() = default;
  /// The present value, and the one before this instant.
  virtual ExpressionValue now(std::uint32_t name) const = 0;
  virtual ExpressionValue before(std::uint32_t name) const = 0;
};

/// A condition or a figure over named values: triggers, checks, constraints, objectives, metrics.
///
///     feature_overflow rises and pixel_y >= 400
///     ps.fclk_clk1.frequency <= 2 * ps.fclk_clk0.frequency and system == 'hybrid'
///
/// docs/expressions.md has the grammar. True is 1. Only values of one dimension are added or
/// compared. What depends on an unknown value, or divides by zero, is unknown, and does not hold.
class Expression {
 public:
  using Lookup = std::function<ExpressionValue(const std::string& name)>;

  Expression() = default;
  /// Throws InputError "where: 'text', column 5: what is wrong".
  explicit Expression(std::string_view text, std::string where = "");

  const std::string& text() const { return text_; }
  /// The names in it, as they are written there, each once.
  const std::vector<std::string>& names() const { return names_; }
  /// True if it has rises, falls or changes in it: it speaks of an instant, not of a state.
  bool is_event() const;

  /// Looks up every name; all of them are plain numbers. Throws InputError that shows the place,
  /// for what `number_of` throws and where units do not go together.
  void bind(const std::function<std::uint32_t(const std::string& name)>& number_of);
  /// Of the names in it, after bind().
  const std::vector<std::uint32_t>& bound() const { return bound_; }
  /// After bind().
  ExpressionValue value(const ExpressionValues& values) const;
  bool holds(const ExpressionValues& values) const { return value(values).holds(); }

  /// Where nothing was before: an event makes no sense. Throws InputError that shows the place, for
  /// what `lookup` throws and where units or texts do not go together.
  ExpressionValue value(const Lookup& lookup) const;
  bool holds(const Lookup& lookup) const { return value(lookup).holds(); }
  /// How far it is from holding, without dimension: 0 if it holds; of a comparison of numbers by
  /// how much they differ, in parts of the greater; of several joined by `and` the sum, by `or` the
  /// least; of what is not known, or no comparison, 1.
  double shortfall(const Lookup& lookup) const;

  /// Throws InputError "where: 'text', column 5: problem" that points to a name in it.
  [[noreturn]] void refuse(const std::string& name, const std::string& problem) const;

 private:
  friend class ExpressionParser;
  enum class Operation : std::uint8_t {
    constant,
    name,
    either,
    both,
    invert,
    negate,
    equal,
    unequal,
    less,
    less_equal,
    greater,
    greater_equal,
    rises,
    falls,
    changes,
    plus,
    minus,
    times,
    over
  };
  struct Node {
    Operation operation = Operation::constant;
    std::uint32_t left = 0, right = 0;  ///< nodes; the place in constants_ or names_
    std::uint32_t column = 0;           ///< from 1
    bool sliced = false;
    unsigned high = 63, low = 0;  ///< bits of a name's number
  };
  /// The value of names_[place]; `past`: as it was before this instant.
  using At = std::function<ExpressionValue(std::uint32_t place, bool past)>;

  [[noreturn]] void fail(std::uint32_t column, const std::string& problem) const;
  std::vector<ExpressionValue> looked_up(const Lookup& lookup) const;
  double shortfall(std::uint32_t place, const At& at) const;
  ExpressionValue evaluate(std::uint32_t place, const At& at, bool past) const;
  ExpressionValue logic(const Node& node, const At& at, bool past) const;
  ExpressionValue named(const Node& node, const At& at, bool past) const;
  ExpressionValue scaled(const Node& node, ExpressionValue left,
                         const ExpressionValue& right) const;
  ExpressionValue compared(const Node& node, const ExpressionValue& left,
                           const ExpressionValue& right) const;
  void check_number(const Node& node, const ExpressionValue& value) const;
  void check_same_unit(const Node& node, const ExpressionValue& left, const ExpressionValue& right,
                       const char* what) const;

  std::string text_;
  std::string where_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> columns_;  ///< of each name's first use
  std::vector<std::uint32_t> bound_;
  std::vector<ExpressionValue> constants_;
  std::vector<Node> nodes_;
  std::uint32_t root_ = 0;
};

}  // namespace vp

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
  /// 64 bits of mantissa hold every double exactly, and every vector of up to 64 bits.
  ExpressionValue(long double plain) : number(plain), known(plain == plain) {}
  static ExpressionValue unknown() {
    ExpressionValue value;
    value.known = false;
    return value;
  }

  long double number = 0;  ///< in the base unit; with `digits` no more than near it
  Unit unit = Unit::none;
  bool known = true;
  bool is_text = false;
  bool may_be_text = false;  ///< of a trace: compared with the other type it is unknown
  std::string text;          ///< of a number the name of its value, if it has one

  bool is_wide = false;  ///< of a signal of more than 64 bits
  std::string digits;    ///< of a number above 64 bits: its bits from the first 1 on

  bool holds() const { return known && number != 0; }
  /// Below 0, 0 or above 0 for less, equal or greater. Both are numbers, or both are texts.
  int order(const ExpressionValue& other) const;
};

/// Where an expression finds the values of its names.
class ExpressionValues {
 public:
  virtual ~ExpressionValues() = default;
  /// The present value, and the one before this instant.
  virtual ExpressionValue now(std::uint32_t name) const = 0;
  virtual ExpressionValue before(std::uint32_t name) const = 0;
  /// The value so many instants, or clocks, ago. Without a history nothing is older than before().
  virtual ExpressionValue past(std::uint32_t name, unsigned ago) const {
    return ago == 0 ? now(name) : before(name);
  }
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
  /// True if it has rises, falls, changes, rose or fell in it: it speaks of an instant, not of a
  /// state.
  bool is_event() const;
  /// How many instants, or clocks, it looks back: 1 for rises, 3 for past(x, 3).
  unsigned history() const { return history_; }

  /// Looks up every name. Throws InputError that shows the place, for what `number_of` throws and
  /// where units do not go together. All names are plain numbers, unless `is_text` tells which are
  /// texts: then the others may have names for their values.
  /// Refuses one that looks back further than `history`.
  void bind(const std::function<std::uint32_t(const std::string& name)>& number_of,
            const std::function<bool(std::uint32_t)>& is_text = {}, unsigned history = 1);
  /// Names that are compared with a text in quotes.
  std::vector<std::string> names_beside_texts() const;
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
    over,
    past,
    rose,
    fell,
    stable,
    within,
    count
  };
  struct Node {
    Operation operation = Operation::constant;
    std::uint32_t left = 0, right = 0;  ///< nodes; the place in constants_ or names_; clocks
    std::uint32_t column = 0;           ///< from 1
    bool sliced = false;
    unsigned high = 63, low = 0;  ///< bits of a name's number
  };
  /// The value of names_[place], so many instants ago.
  using At = std::function<ExpressionValue(std::uint32_t place, unsigned ago)>;
  /// What evaluate() does and how far it looks back.
  struct Cost {
    std::uint64_t work = 1;
    unsigned history = 0;
  };

  [[noreturn]] void fail(std::uint32_t column, const std::string& problem) const;
  std::vector<ExpressionValue> looked_up(const Lookup& lookup) const;
  double shortfall(std::uint32_t place, const At& at) const;
  void measure();
  ExpressionValue evaluate(std::uint32_t place, const At& at, unsigned ago) const;
  ExpressionValue over_time(const Node& node, const At& at, unsigned ago) const;
  ExpressionValue logic(const Node& node, const At& at, unsigned ago) const;
  ExpressionValue named(const Node& node, const At& at, unsigned ago) const;
  static ExpressionValue sliced(ExpressionValue whole, const Node& node);
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
  unsigned history_ = 0;
  bool has_functions_ = false;  ///< past and its like
};

}  // namespace vp

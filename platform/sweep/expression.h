#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vp/unit.h>

namespace platform::sweep {

/// What a name stands for in an expression: a number with its dimension, or a text.
struct Value {
  double number = 0;
  vp::Unit unit = vp::Unit::none;
  std::string text;
  bool is_text = false;
};

/// A condition or a figure over named values:
///
///   ps.fclk_clk1.frequency <= 2 * ps.fclk_clk0.frequency and system == 'hybrid'
///
/// Numbers may have units (50 MHz); + - * /, < <= == != >= >, and, or, not, brackets, texts in
/// quotes. Only values of the same dimension are added or compared; dividing them gives a plain
/// number.
class Expression {
 public:
  using Lookup = std::function<Value(const std::string& name)>;
  struct Node;

  /// Throws vp::InputError that shows the text and the place; `where` says where it stands.
  Expression(const std::string& text, const std::string& where);

  /// The value; 1 or 0 for a condition. `lookup` may throw for an unknown name.
  Value evaluate(const Lookup& lookup) const;
  bool holds(const Lookup& lookup) const { return evaluate(lookup).number != 0; }
  /// The names in it, in order, each once.
  const std::vector<std::string>& names() const { return names_; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::string where_;
  std::vector<std::string> names_;
  std::shared_ptr<const Node> root_;
};

}  // namespace platform::sweep

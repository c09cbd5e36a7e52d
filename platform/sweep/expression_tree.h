#pragma once

#include <memory>
#include <string>
#include <vector>

#include <sweep/expression.h>

namespace platform::sweep {

/// A part of an expression: a constant, a name, or an operator and what it works on.
struct Expression::Node {
  enum class Kind { value, name, negate, invert, binary };

  Kind kind = Kind::value;
  Value value;        ///< of a constant
  std::string token;  ///< a name, or an operator
  std::shared_ptr<const Node> left;
  std::shared_ptr<const Node> right;
};

/// The tree of `text`. Adds the names in it to `names`, each once. Throws vp::InputError that shows
/// the text and the place; `where` says where it stands.
std::shared_ptr<const Expression::Node> parse_expression(const std::string& text,
                                                         const std::string& where,
                                                         std::vector<std::string>& names);

}  // namespace platform::sweep

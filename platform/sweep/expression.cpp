#include <algorithm>
#include <utility>

#include <sweep/expression_tree.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

using Node = Expression::Node;

Value truth(bool value) {
  Value result;
  result.number = value ? 1 : 0;
  return result;
}

std::string unit_text(vp::Unit unit) {
  const std::string base = vp::base_unit(unit);
  return base.empty() ? "a plain number" : base;
}

/// Throws vp::InputError that continues "'text' ".
class Evaluation {
 public:
  explicit Evaluation(const Expression::Lookup& lookup) : lookup_(lookup) {}

  Value value(const Node& node) const {
    switch (node.kind) {
      case Node::Kind::value:
        return node.value;
      case Node::Kind::name:
        return lookup_(node.token);
      case Node::Kind::invert:
        return truth(value(*node.left).number == 0);
      case Node::Kind::negate: {
        Value result = number(*node.left);
        result.number = -result.number;
        return result;
      }
      case Node::Kind::binary:
        break;
    }
    if (node.token == "and") return truth(holds(*node.left) && holds(*node.right));
    if (node.token == "or") return truth(holds(*node.left) || holds(*node.right));
    if (node.token == "*" || node.token == "/") return scaled(node);
    if (node.token == "+" || node.token == "-") return sum(node);
    return compared(node);
  }

 private:
  bool holds(const Node& node) const { return value(node).number != 0; }

  Value number(const Node& node) const {
    Value result = value(node);
    if (result.is_text) throw vp::InputError("calculates with the text '" + result.text + "'");
    return result;
  }

  /// Addresses are plain numbers.
  static vp::Unit unit(const Value& value) {
    return value.unit == vp::Unit::address ? vp::Unit::none : value.unit;
  }

  static void check_same(const Value& left, const Value& right, const std::string& what) {
    if (unit(left) == unit(right)) return;
    throw vp::InputError(what + " " + unit_text(left.unit) + " and " + unit_text(right.unit));
  }

  Value scaled(const Node& node) const {
    const Value left = number(*node.left);
    const Value right = number(*node.right);
    Value result;
    if (node.token == "*") {
      result.number = left.number * right.number;
      if (unit(left) != vp::Unit::none && unit(right) != vp::Unit::none)
        throw vp::InputError("multiplies " + unit_text(left.unit) + " by " + unit_text(right.unit));
      result.unit = unit(left) != vp::Unit::none ? left.unit : right.unit;
      return result;
    }
    if (right.number == 0) throw vp::InputError("divides by zero");
    result.number = left.number / right.number;
    if (unit(right) != vp::Unit::none) {
      check_same(left, right, "divides");
    } else {
      result.unit = left.unit;
    }
    return result;
  }

  Value sum(const Node& node) const {
    Value left = number(*node.left);
    const Value right = number(*node.right);
    check_same(left, right, "adds");
    left.number += node.token == "+" ? right.number : -right.number;
    return left;
  }

  Value compared(const Node& node) const {
    const Value left = value(*node.left);
    const Value right = value(*node.right);
    if (left.is_text || right.is_text) return compared_texts(node.token, left, right);
    check_same(left, right, "compares");
    const double a = left.number;
    const double b = right.number;
    if (node.token == "<=") return truth(a <= b);
    if (node.token == ">=") return truth(a >= b);
    if (node.token == "==") return truth(a == b);
    if (node.token == "!=") return truth(a != b);
    if (node.token == "<") return truth(a < b);
    return truth(a > b);
  }

  static Value compared_texts(const std::string& token, const Value& left, const Value& right) {
    if (!left.is_text || !right.is_text)
      throw vp::InputError("compares a text with a number: texts stand in quotes");
    if (token == "==") return truth(left.text == right.text);
    if (token == "!=") return truth(left.text != right.text);
    throw vp::InputError("compares texts by '" + token + "': only == and != do that");
  }

  const Expression::Lookup& lookup_;
};

}  // namespace

Expression::Expression(const std::string& text, const std::string& where)
    : text_(vp::trim(text)), where_(where) {
  root_ = parse_expression(text_, where_, names_);
}

Value Expression::evaluate(const Lookup& lookup) const {
  // What lookup() throws has its own words.
  std::vector<std::pair<std::string, Value>> found;
  for (const std::string& name : names_) found.emplace_back(name, lookup(name));
  const Lookup known = [&](const std::string& name) {
    return std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == name; })
        ->second;
  };
  try {
    return Evaluation(known).value(*root_);
  } catch (const vp::InputError& error) {
    throw vp::InputError(where_ + ": '" + vp::excerpt(text_) + "' " + error.what());
  }
}

}  // namespace platform::sweep

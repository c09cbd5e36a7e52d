#include <sweep/expression.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include <vp/decimal.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

struct Expression::Node {
  enum class Kind { value, name, negate, invert, binary };

  Kind kind = Kind::value;
  Value value;        ///< of a constant
  std::string token;  ///< a name, or an operator
  std::shared_ptr<const Node> left;
  std::shared_ptr<const Node> right;
};

namespace {

using Node = Expression::Node;
using NodePointer = std::shared_ptr<const Node>;

constexpr int deepest = 100;

bool is_name_start(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_name_part(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

/// The dimension of a unit; none if it is no unit.
std::optional<vp::Unit> dimension(const std::string& name) {
  using vp::Unit;
  for (const Unit unit :
       {Unit::frequency, Unit::time, Unit::bytes, Unit::pixels, Unit::length, Unit::power,
        Unit::energy, Unit::voltage, Unit::cycles, Unit::percent, Unit::angle, Unit::temperature}) {
    const std::vector<std::string> known = vp::allowed_units(unit);
    if (std::find(known.begin(), known.end(), name) != known.end()) return unit;
  }
  return std::nullopt;
}

class Parser {
 public:
  Parser(const std::string& text, const std::string& where, std::vector<std::string>& names)
      : text_(text), where_(where), names_(names) {}

  NodePointer parse() {
    NodePointer root = parse_or();
    skip();
    if (at_ != text_.size()) fail("is not understood from here on: '" + text_.substr(at_) + "'");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError(where_ + ": '" + text_ + "' " + problem);
  }

  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  bool take(const std::string& token) {
    skip();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    const std::size_t end = at_ + token.size();
    if (is_name_start(token[0]) && end < text_.size() && is_name_part(text_[end])) return false;
    at_ = end;
    return true;
  }

  static NodePointer constant(const Value& value) {
    auto node = std::make_shared<Node>();
    node->value = value;
    return node;
  }

  static NodePointer unary(Node::Kind kind, NodePointer operand) {
    auto node = std::make_shared<Node>();
    node->kind = kind;
    node->left = std::move(operand);
    return node;
  }

  static NodePointer binary(const std::string& token, NodePointer left, NodePointer right) {
    auto node = std::make_shared<Node>();
    node->kind = Node::Kind::binary;
    node->token = token;
    node->left = std::move(left);
    node->right = std::move(right);
    return node;
  }

  NodePointer parse_or() {
    NodePointer left = parse_and();
    while (take("or")) left = binary("or", left, parse_and());
    return left;
  }

  NodePointer parse_and() {
    NodePointer left = parse_not();
    while (take("and")) left = binary("and", left, parse_not());
    return left;
  }

  NodePointer parse_not() {
    if (!take("not")) return parse_comparison();
    return unary(Node::Kind::invert, parse_not());
  }

  NodePointer parse_comparison() {
    const NodePointer left = parse_sum();
    for (const char* token : {"<=", ">=", "==", "!=", "<", ">"}) {
      if (take(token)) return binary(token, left, parse_sum());
    }
    if (take("=")) fail("has '=': write '==' to compare");
    return left;
  }

  NodePointer parse_sum() {
    NodePointer left = parse_product();
    for (;;) {
      if (take("+")) {
        left = binary("+", left, parse_product());
      } else if (take("-")) {
        left = binary("-", left, parse_product());
      } else {
        return left;
      }
    }
  }

  NodePointer parse_product() {
    NodePointer left = parse_factor();
    for (;;) {
      if (take("*")) {
        left = binary("*", left, parse_factor());
      } else if (take("/")) {
        left = binary("/", left, parse_factor());
      } else {
        return left;
      }
    }
  }

  NodePointer parse_factor() {
    if (++depth_ > deepest) fail("is nested too deeply");
    NodePointer result = parse_atom();
    --depth_;
    return result;
  }

  NodePointer parse_atom() {
    if (take("-")) return unary(Node::Kind::negate, parse_factor());
    if (take("(")) {
      NodePointer inside = parse_or();
      if (!take(")")) fail("lacks a ')'");
      return inside;
    }
    skip();
    if (at_ == text_.size()) fail("ends where a value is expected");
    const char c = text_[at_];
    if (c == '\'' || c == '"') return parse_text(c);
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return parse_number();
    if (is_name_start(c)) return parse_name();
    fail("has '" + std::string(1, c) + "' where a value is expected");
  }

  NodePointer parse_text(char quote) {
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string::npos) fail("lacks a closing quote");
    Value value;
    value.is_text = true;
    value.text = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return constant(value);
  }

  std::string word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_name_part(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }

  /// The unit that stands behind a number; moves past it.
  std::string unit_name() {
    skip();
    if (at_ < text_.size() && text_[at_] == '%') return text_.substr(at_++, 1);
    if (at_ == text_.size() || !is_name_start(text_[at_])) return "";
    const std::size_t start = at_;
    const std::string name = word();
    if (dimension(name)) return name;
    if (name != "and" && name != "or") fail("has '" + name + "', which is no unit");
    at_ = start;
    return "";
  }

  NodePointer parse_number() {
    const std::size_t start = at_;
    const auto digit = [&](std::size_t i) {
      return i < text_.size() && std::isdigit(static_cast<unsigned char>(text_[i])) != 0;
    };
    while (digit(at_) || (at_ < text_.size() && text_[at_] == '.')) ++at_;
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      std::size_t exponent = at_ + 1;
      if (exponent < text_.size() && (text_[exponent] == '-' || text_[exponent] == '+')) ++exponent;
      if (digit(exponent)) {
        while (digit(exponent)) ++exponent;
        at_ = exponent;
      }
    }
    const std::string number = text_.substr(start, at_ - start);
    const std::string name = unit_name();
    Value value;
    if (!name.empty()) value.unit = *dimension(name);
    try {
      value.number =
          vp::parse_quantity(name.empty() ? number : number + " " + name, value.unit).to_double();
    } catch (const vp::InputError& error) {
      fail("has '" + number + "', which " + error.what());
    }
    return constant(value);
  }

  NodePointer parse_name() {
    const std::string name = word();
    if (name == "true" || name == "false") {
      Value value;
      value.number = name == "true" ? 1 : 0;
      return constant(value);
    }
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
    auto node = std::make_shared<Node>();
    node->kind = Node::Kind::name;
    node->token = name;
    return node;
  }

  const std::string& text_;
  const std::string& where_;
  std::vector<std::string>& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

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
  root_ = Parser(text_, where_, names_).parse();
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
    throw vp::InputError(where_ + ": '" + text_ + "' " + error.what());
  }
}

}  // namespace platform::sweep

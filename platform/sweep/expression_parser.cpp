#include <algorithm>
#include <cctype>
#include <optional>

#include <sweep/expression_tree.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace {

using Node = Expression::Node;
using NodePointer = std::shared_ptr<const Node>;
using Limits = vp::ExpressionLimits;

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
    if (at_ != text_.size())
      fail("is not understood from here on: '" + vp::excerpt(text_.substr(at_)) + "'");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError(where_ + ": '" + vp::excerpt(text_) + "' " + problem);
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

  std::shared_ptr<Node> node(Node::Kind kind) {
    if (++parts_ > Limits::most_parts) {
      fail("has more than " + std::to_string(Limits::most_parts) +
           " values and operators: write several expressions");
    }
    auto result = std::make_shared<Node>();
    result->kind = kind;
    return result;
  }

  NodePointer constant(const Value& value) {
    const auto result = node(Node::Kind::value);
    result->value = value;
    return result;
  }

  NodePointer unary(Node::Kind kind, NodePointer operand) {
    const auto result = node(kind);
    result->left = std::move(operand);
    return result;
  }

  NodePointer binary(const std::string& token, NodePointer left, NodePointer right) {
    const auto result = node(Node::Kind::binary);
    result->token = token;
    result->left = std::move(left);
    result->right = std::move(right);
    return result;
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
    std::size_t count = 0;
    while (take("not")) ++count;
    NodePointer result = parse_comparison();
    // Two of them, which make a truth of a number, say what any even number of them says.
    for (count = count == 0 ? 0 : 2 - count % 2; count > 0; --count)
      result = unary(Node::Kind::invert, std::move(result));
    return result;
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
    if (++depth_ > Limits::deepest) {
      fail("has more than " + std::to_string(Limits::deepest) +
           " brackets and signs inside each other: write it flatter");
    }
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
    const auto result = node(Node::Kind::name);
    result->token = name;
    return result;
  }

  const std::string& text_;
  const std::string& where_;
  std::vector<std::string>& names_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
  std::size_t parts_ = 0;
};

}  // namespace

NodePointer parse_expression(const std::string& text, const std::string& where,
                             std::vector<std::string>& names) {
  return Parser(text, where, names).parse();
}

}  // namespace platform::sweep

// The text of an expression becomes its nodes.
#include <vp/error.h>
#include <vp/expression.h>
#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

namespace vp {

namespace {

using Limits = ExpressionLimits;
/// Clocks that past() and its like look back at most.
constexpr std::uint32_t furthest = 1000;

bool starts_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '$';
}
bool starts_number(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
}

constexpr std::string_view operators_of_words[] = {"and", "or", "rises", "falls", "changes"};

std::optional<Unit> dimension(const std::string& name) {
  for (const Unit unit :
       {Unit::frequency, Unit::time, Unit::bytes, Unit::pixels, Unit::length, Unit::power,
        Unit::energy, Unit::voltage, Unit::cycles, Unit::percent, Unit::angle, Unit::temperature}) {
    const std::vector<std::string> known = allowed_units(unit);
    if (std::find(known.begin(), known.end(), name) != known.end()) return unit;
  }
  return std::nullopt;
}

}  // namespace

/// Recursive descent; every function takes what it knows off the front.
class ExpressionParser {
 public:
  explicit ExpressionParser(Expression& target) : target_(target), rest_(target.text_) {}

  void parse() {
    target_.root_ = either();
    skip();
    if (!rest_.empty()) fail("an operator is missing, or this is too much");
    target_.measure();
  }

 private:
  using Operation = Expression::Operation;
  using Node = Expression::Node;

  std::uint32_t column() const {
    return static_cast<std::uint32_t>(target_.text_.size() - rest_.size() + 1);
  }
  [[noreturn]] void fail(const std::string& problem) const { target_.fail(column(), problem); }
  void skip() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
      rest_.remove_prefix(1);
    }
  }
  /// Takes `symbol`, a word as a whole.
  bool take(std::string_view symbol) {
    skip();
    if (rest_.substr(0, symbol.size()) != symbol) return false;
    if (starts_name(symbol.front()) && rest_.size() > symbol.size() &&
        continues_name(rest_[symbol.size()])) {
      return false;
    }
    rest_.remove_prefix(symbol.size());
    return true;
  }
  std::string_view take_word() {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), continues_name);
    const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(word.size());
    return word;
  }
  std::uint32_t add(Node node, std::uint32_t column) {
    if (target_.nodes_.size() == Limits::most_parts) {
      fail("more than " + std::to_string(Limits::most_parts) +
           " values and operators: write several expressions");
    }
    node.column = column;
    target_.nodes_.push_back(node);
    return static_cast<std::uint32_t>(target_.nodes_.size() - 1);
  }
  std::uint32_t add(Operation operation, std::uint32_t column, std::uint32_t left,
                    std::uint32_t right = 0) {
    Node node;
    node.operation = operation;
    node.left = left;
    node.right = right;
    return add(node, column);
  }
  std::uint32_t add(ExpressionValue constant, std::uint32_t column) {
    target_.constants_.push_back(std::move(constant));
    return add(Operation::constant, column,
               static_cast<std::uint32_t>(target_.constants_.size() - 1));
  }

  std::uint32_t either() {
    std::uint32_t left = both();
    for (std::uint32_t at = here(); take("or"); at = here())
      left = add(Operation::either, at, left, both());
    return left;
  }
  std::uint32_t both() {
    std::uint32_t left = inverted();
    for (std::uint32_t at = here(); take("and"); at = here())
      left = add(Operation::both, at, left, inverted());
    return left;
  }
  /// Two of them, which make a truth of a number, say what any even number of them says.
  std::uint32_t inverted() {
    const std::uint32_t at = here();
    std::size_t count = 0;
    while (take("not")) ++count;
    std::uint32_t inner = comparison();
    for (count = count == 0 ? 0 : 2 - count % 2; count > 0; --count)
      inner = add(Operation::invert, at, inner);
    return inner;
  }
  std::uint32_t comparison() {
    const std::uint32_t left = sum();
    const std::uint32_t at = here();
    if (take("rises")) return add(Operation::rises, at, left);
    if (take("falls")) return add(Operation::falls, at, left);
    if (take("changes")) return add(Operation::changes, at, left);
    static constexpr std::pair<const char*, Operation> symbols[] = {
        {"==", Operation::equal},         {"!=", Operation::unequal}, {"<=", Operation::less_equal},
        {">=", Operation::greater_equal}, {"<", Operation::less},     {">", Operation::greater}};
    for (const auto& [symbol, operation] : symbols) {
      if (take(symbol)) return add(operation, at, left, sum());
    }
    if (rest_.substr(0, 1) == "=") fail("write '==' to compare");
    return left;
  }
  std::uint32_t sum() {
    std::uint32_t left = product();
    for (;;) {
      const std::uint32_t at = here();
      if (take("+")) {
        left = add(Operation::plus, at, left, product());
      } else if (take("-")) {
        left = add(Operation::minus, at, left, product());
      } else {
        return left;
      }
    }
  }
  std::uint32_t product() {
    std::uint32_t left = factor();
    for (;;) {
      const std::uint32_t at = here();
      if (take("*")) {
        left = add(Operation::times, at, left, factor());
      } else if (take("/")) {
        left = add(Operation::over, at, left, factor());
      } else {
        return left;
      }
    }
  }
  std::uint32_t factor() {
    if (++depth_ > Limits::deepest) {
      fail("more than " + std::to_string(Limits::deepest) +
           " brackets and signs inside each other: write it flatter");
    }
    const std::uint32_t at = here();
    const std::uint32_t result = take("-") ? add(Operation::negate, at, factor()) : value();
    --depth_;
    return result;
  }
  std::uint32_t value() {
    const std::uint32_t at = here();
    if (rest_.empty()) fail("a value is missing");
    if (take("(")) {
      const std::uint32_t inner = either();
      if (!take(")")) fail("a ')' is missing");
      return inner;
    }
    const char c = rest_.front();
    if (c == '\'' || c == '"') {
      ExpressionValue constant;
      constant.is_text = true;
      constant.text = quoted(c);
      return add(std::move(constant), at);
    }
    if (starts_number(c)) return add(number(), at);
    if (c == '`') return name(quoted(c), at);
    if (!starts_name(c)) fail("here should be a value: a number, a name, a text in quotes or '('");
    const std::string word(take_word());
    if (word == "true" || word == "false") return add(ExpressionValue(word == "true"), at);
    if (rest_.substr(0, 1) == "(") return function(word, at);
    return name(word, at);
  }
  /// past(x), past(x, 3) and its like.
  std::uint32_t function(const std::string& word, std::uint32_t at) {
    struct Function {
      const char* name;
      Operation operation;
      bool counts, may_lack;  ///< its second value is a number of clocks; 1 if it is left out
    };
    static constexpr Function functions[] = {
        {"past", Operation::past, true, true},      {"rose", Operation::rose, false, false},
        {"fell", Operation::fell, false, false},    {"stable", Operation::stable, false, false},
        {"within", Operation::within, true, false}, {"count", Operation::count, true, false}};
    for (const Function& known : functions) {
      if (word != known.name) continue;
      take("(");
      const std::uint32_t inner = either();
      std::uint32_t clocks = 1;
      if (known.counts && take(",")) {
        clocks = number_of_clocks();
      } else if (known.counts && !known.may_lack) {
        fail("a number of clocks is missing: write " + word + "(x, 5)");
      }
      if (!take(")")) fail("a ')' is missing");
      target_.has_functions_ = true;
      return add(known.operation, at, inner, clocks);
    }
    fail("'" + word + "' is no function: there are past, rose, fell, stable, within and count");
  }
  std::uint32_t number_of_clocks() {
    skip();
    std::uint32_t clocks = 0;
    const auto result = std::from_chars(rest_.data(), rest_.data() + rest_.size(), clocks);
    if (result.ec != std::errc() || clocks == 0 || clocks > furthest)
      fail("a number of clocks is 1 to " + std::to_string(furthest));
    rest_.remove_prefix(static_cast<std::size_t>(result.ptr - rest_.data()));
    return clocks;
  }
  std::uint32_t here() {
    skip();
    return column();
  }
  std::string quoted(char quote) {
    const std::size_t end = rest_.find(quote, 1);
    if (end == std::string_view::npos) fail(std::string("a closing ") + quote + " is missing");
    std::string text(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return text;
  }
  ExpressionValue number() { return rest_.substr(0, 2) == "0x" ? hexadecimal() : decimal(); }
  ExpressionValue hexadecimal() {
    std::uint64_t bits = 0;
    const auto result = std::from_chars(rest_.data() + 2, rest_.data() + rest_.size(), bits, 16);
    if (result.ec != std::errc()) fail("this is no number of at most 64 bits");
    rest_.remove_prefix(static_cast<std::size_t>(result.ptr - rest_.data()));
    return ExpressionValue(static_cast<long double>(bits));
  }
  ExpressionValue decimal() {
    const char* const end = rest_.data() + rest_.size();
    std::uint64_t whole = 0;
    double real = 0;
    const auto as_whole = std::from_chars(rest_.data(), end, whole);
    const auto as_real = std::from_chars(rest_.data(), end, real);
    const bool is_whole = as_whole.ec == std::errc() && as_whole.ptr == as_real.ptr;
    if (!is_whole && as_real.ec != std::errc()) fail("this is no number");
    const std::string digits(rest_.data(), as_real.ptr);
    const std::string_view start = rest_;
    rest_.remove_prefix(digits.size());
    const std::string unit = unit_name();
    ExpressionValue value(is_whole ? static_cast<long double>(whole)
                                   : static_cast<long double>(real));
    if (unit.empty()) return value;
    value.unit = *dimension(unit);
    try {
      value.number = parse_quantity(digits + " " + unit, value.unit).to_double();
    } catch (const InputError& error) {
      rest_ = start;
      fail("'" + digits + "' " + error.what());
    }
    return value;
  }
  /// The unit after a number, or empty.
  std::string unit_name() {
    if (take("%")) return "%";
    skip();
    if (rest_.empty() || !starts_name(rest_.front())) return "";
    const std::string_view start = rest_;
    std::string word(take_word());
    if (dimension(word)) return word;
    rest_ = start;
    for (const std::string_view other : operators_of_words) {
      if (word == other) return "";
    }
    fail("'" + word + "' is no unit");
  }
  std::uint32_t name(const std::string& text, std::uint32_t at) {
    auto& names = target_.names_;
    auto place = std::find(names.begin(), names.end(), text);
    if (place == names.end()) {
      place = names.insert(names.end(), text);
      target_.columns_.push_back(at);
    }
    Node node;
    node.operation = Operation::name;
    node.left = static_cast<std::uint32_t>(place - names.begin());
    if (take("[")) slice(node);
    return add(node, at);
  }
  void slice(Node& node) {
    node.sliced = true;
    node.high = bit();
    node.low = take(":") ? bit() : node.high;
    if (!take("]")) fail("a ']' is missing");
    if (node.low > node.high) fail("bits are written [high:low]");
    if (node.high - node.low > 63) fail("at most 64 bits are taken together");
  }
  unsigned bit() {
    skip();
    unsigned value = 0;
    const auto result = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    constexpr unsigned last = (1 << 20) - 1;
    if (result.ec != std::errc() || value > last) fail("a bit is a number from 0 to 1048575");
    rest_.remove_prefix(static_cast<std::size_t>(result.ptr - rest_.data()));
    return value;
  }

  Expression& target_;
  std::string_view rest_;
  unsigned depth_ = 0;
};

Expression::Expression(std::string_view text, std::string where)
    : text_(trim(text)), where_(std::move(where)) {
  ExpressionParser(*this).parse();
}

}  // namespace vp

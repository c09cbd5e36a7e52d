#include <vp/error.h>
#include <vp/text.h>
#include <vp/wave_expression.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace vp {

namespace {

bool starts_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '$' ||
         c == '/';
}

}  // namespace

/// Recursive descent; every function takes what it knows off the front.
class ExpressionParser {
 public:
  ExpressionParser(WaveExpression& target) : target_(target), rest_(target.text_) {}

  void parse() {
    target_.root_ = either();
    skip();
    if (!rest_.empty()) fail("something too much");
  }

 private:
  using Operation = WaveExpression::Operation;
  using Node = WaveExpression::Node;
  [[noreturn]] void fail(const std::string& problem) const {
    const std::size_t column = target_.text_.size() - rest_.size() + 1;
    throw InputError("'" + excerpt(target_.text_) + "', column " + std::to_string(column) + ": " +
                     problem);
  }
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
  std::uint32_t add(const Node& node) {
    if (target_.nodes_.size() == ExpressionLimits::most_parts) {
      fail("more than " + std::to_string(ExpressionLimits::most_parts) +
           " values and operators: write several expressions");
    }
    target_.nodes_.push_back(node);
    return static_cast<std::uint32_t>(target_.nodes_.size() - 1);
  }
  std::uint32_t add(Operation operation, std::uint32_t left, std::uint32_t right = 0) {
    Node node;
    node.operation = operation;
    node.left = left;
    node.right = right;
    return add(node);
  }

  std::uint32_t either() {
    if (++depth_ > ExpressionLimits::deepest) {
      fail("more than " + std::to_string(ExpressionLimits::deepest) +
           " brackets inside each other: write it flatter");
    }
    std::uint32_t left = both();
    while (take("or")) left = add(Operation::either, left, both());
    --depth_;
    return left;
  }
  std::uint32_t both() {
    std::uint32_t left = negated();
    while (take("and")) left = add(Operation::both, left, negated());
    return left;
  }
  std::uint32_t negated() {
    bool negate = false;
    while (take("not")) negate = !negate;
    const std::uint32_t inner = comparison();
    return negate ? add(Operation::negate, inner) : inner;
  }
  std::uint32_t comparison() {
    const std::uint32_t left = sum();
    if (take("rises")) return add(Operation::rises, left);
    if (take("falls")) return add(Operation::falls, left);
    if (take("changes")) return add(Operation::changes, left);
    static constexpr std::pair<const char*, Operation> symbols[] = {
        {"==", Operation::equal},         {"!=", Operation::unequal}, {"<=", Operation::less_equal},
        {">=", Operation::greater_equal}, {"<", Operation::less},     {">", Operation::greater}};
    for (const auto& [symbol, operation] : symbols) {
      if (take(symbol)) return add(operation, left, sum());
    }
    return left;
  }
  std::uint32_t sum() {
    std::uint32_t left = product();
    for (;;) {
      if (take("+")) {
        left = add(Operation::plus, left, product());
      } else if (take("-")) {
        left = add(Operation::minus, left, product());
      } else {
        return left;
      }
    }
  }
  std::uint32_t product() {
    std::uint32_t left = value();
    while (take("*")) left = add(Operation::times, left, value());
    return left;
  }
  std::uint32_t value() {
    skip();
    if (rest_.empty()) fail("a value is missing");
    if (take("(")) {
      const std::uint32_t inner = either();
      if (!take(")")) fail("a ')' is missing");
      return inner;
    }
    if (std::isdigit(static_cast<unsigned char>(rest_.front())) != 0) return number();
    if (starts_name(rest_.front())) return signal();
    fail("here should be a number, a signal or '('");
  }
  std::uint32_t number() {
    Node node;
    const char* const end = rest_.data() + rest_.size();
    const char* after = rest_.data();
    if (rest_.substr(0, 2) == "0x") {
      std::uint64_t bits = 0;
      const auto result = std::from_chars(rest_.data() + 2, end, bits, 16);
      if (result.ec != std::errc()) fail("this is no number of at most 64 bits");
      node.number = bits;
      after = result.ptr;
    } else {
      std::uint64_t whole = 0;
      double real = 0;
      const auto as_whole = std::from_chars(rest_.data(), end, whole);
      const auto as_real = std::from_chars(rest_.data(), end, real);
      const bool is_whole = as_whole.ec == std::errc() && as_whole.ptr == as_real.ptr;
      if (!is_whole && as_real.ec != std::errc()) fail("this is no number");
      node.number = is_whole ? WaveNumber(whole) : WaveNumber(real);
      after = as_real.ptr;
    }
    rest_.remove_prefix(static_cast<std::size_t>(after - rest_.data()));
    return add(node);
  }
  std::uint32_t signal() {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), continues_name);
    const std::string name(rest_.begin(), end);
    rest_.remove_prefix(name.size());
    auto& names = target_.names_;
    auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end()) place = names.insert(names.end(), name);
    Node node;
    node.operation = Operation::signal;
    node.left = static_cast<std::uint32_t>(place - names.begin());
    if (take("[")) slice(node);
    return add(node);
  }
  void slice(Node& node) {
    node.sliced = true;
    node.high = bit();
    node.low = take(":") ? bit() : node.high;
    if (!take("]")) fail("a ']' is missing");
    if (node.low > node.high) fail("bits are written [high:low]");
  }
  unsigned bit() {
    skip();
    unsigned value = 0;
    const auto result = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (result.ec != std::errc() || value > 63) fail("a bit is a number from 0 to 63");
    rest_.remove_prefix(static_cast<std::size_t>(result.ptr - rest_.data()));
    return value;
  }

  WaveExpression& target_;
  std::string_view rest_;
  unsigned depth_ = 0;
};

WaveExpression::WaveExpression(std::string_view text) : text_(trim(text)) {
  ExpressionParser(*this).parse();
}

void WaveExpression::bind(const std::function<std::uint32_t(const std::string& name)>& number_of) {
  signals_.clear();
  for (const std::string& name : names_) signals_.push_back(number_of(name));
}

bool WaveExpression::is_event() const {
  return std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) {
    return node.operation >= Operation::rises && node.operation <= Operation::changes;
  });
}

std::optional<WaveNumber> WaveExpression::value(const WaveValues& values) const {
  return evaluate(root_, values, false);
}

// `past`: as it was before this instant.
std::optional<WaveNumber> WaveExpression::evaluate(std::uint32_t place, const WaveValues& values,
                                                   bool past) const {
  const Node& node = nodes_[place];
  if (node.operation == Operation::number) return node.number;
  if (node.operation == Operation::signal) {
    const std::uint32_t signal = signals_[node.left];
    const auto whole = past ? values.before(signal) : values.now(signal);
    if (!whole || !node.sliced) return whole;
    const unsigned width = node.high - node.low + 1;
    const std::uint64_t mask = width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
    return WaveNumber(static_cast<std::uint64_t>(*whole) >> node.low & mask);
  }
  if (node.operation <= Operation::negate) return logic(node, values, past);
  const auto left = evaluate(node.left, values, past);
  const bool edge = node.operation >= Operation::rises && node.operation <= Operation::changes;
  // Before this instant nothing moves: both sides of an edge are one value. To compute it twice
  // would double the work with each edge inside another.
  const auto right =
      edge && past ? left : evaluate(edge ? node.left : node.right, values, past || edge);
  if (!left || !right) return std::nullopt;
  switch (node.operation) {
    case Operation::equal:
      return *left == *right;
    case Operation::changes:
    case Operation::unequal:
      return *left != *right;
    case Operation::falls:
    case Operation::less:
      return *left < *right;
    case Operation::less_equal:
      return *left <= *right;
    case Operation::rises:
    case Operation::greater:
      return *left > *right;
    case Operation::greater_equal:
      return *left >= *right;
    case Operation::plus:
      return *left + *right;
    case Operation::minus:
      return *left - *right;
    default:
      return *left * *right;
  }
}

// One side may decide although the other is not known.
std::optional<WaveNumber> WaveExpression::logic(const Node& node, const WaveValues& values,
                                                bool past) const {
  const auto left = evaluate(node.left, values, past);
  if (node.operation == Operation::negate) {
    return left ? std::optional<WaveNumber>(*left == 0) : std::nullopt;
  }
  const bool decides = node.operation == Operation::either;
  if (left && (*left != 0) == decides) return WaveNumber(decides);
  const auto right = evaluate(node.right, values, past);
  if (right && (*right != 0) == decides) return WaveNumber(decides);
  return left && right ? std::optional<WaveNumber>(!decides) : std::nullopt;
}

std::uint32_t find_path(const std::string& name, const std::vector<std::string>& paths,
                        const std::string& where) {
  std::vector<std::string> fitting;
  std::uint32_t place = 0;
  const std::string ending = "." + name;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i] == name) return static_cast<std::uint32_t>(i);
    if (paths[i].size() <= ending.size() ||
        paths[i].compare(paths[i].size() - ending.size(), ending.size(), ending) != 0) {
      continue;
    }
    place = static_cast<std::uint32_t>(i);
    fitting.push_back(paths[i]);
  }
  if (fitting.size() == 1) return place;
  constexpr std::size_t most = 4;
  if (fitting.size() > most) fitting.resize(most);
  if (!fitting.empty()) {
    throw InputError(where + "'" + name + "' may be " + one_of(fitting) + ": write more of it");
  }
  const std::string nearest = nearest_match(name, paths);
  throw InputError(where + "there is no signal '" + name + "'" +
                   (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

}  // namespace vp

// What an expression comes to.
#include <vp/error.h>
#include <vp/expression.h>
#include <vp/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vp {

namespace {

/// Values in one look.
constexpr std::uint64_t most_work = 1'000'000;

/// Addresses are plain numbers.
Unit plain(Unit unit) {
  return unit == Unit::address ? Unit::none : unit;
}

std::string unit_text(Unit unit) {
  const std::string base = base_unit(unit);
  return base.empty() ? "a plain number" : base;
}

std::string binary(std::uint64_t number) {
  std::string digits;
  for (unsigned bit = 64; bit-- > 0;) digits += (number >> bit & 1) != 0 ? '1' : '0';
  return digits;
}

ExpressionValue truth(bool known, bool value) {
  return known ? ExpressionValue(static_cast<long double>(value)) : ExpressionValue::unknown();
}

}  // namespace

int ExpressionValue::order(const ExpressionValue& other) const {
  if (is_text) return text.compare(other.text);
  if (digits.empty() || other.digits.empty())
    return number < other.number ? -1 : static_cast<int>(number > other.number);
  if (digits.size() != other.digits.size()) return digits.size() < other.digits.size() ? -1 : 1;
  return digits.compare(other.digits);
}

void Expression::fail(std::uint32_t column, const std::string& problem) const {
  throw InputError((where_.empty() ? "" : where_ + ": ") + "'" + excerpt(text_) + "', column " +
                   std::to_string(column) + ": " + problem);
}

void Expression::refuse(const std::string& name, const std::string& problem) const {
  const auto place = std::find(names_.begin(), names_.end(), name);
  fail(place == names_.end() ? 1 : columns_[static_cast<std::size_t>(place - names_.begin())],
       problem);
}

bool Expression::is_event() const {
  return std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) {
    return (node.operation >= Operation::rises && node.operation <= Operation::changes) ||
           node.operation == Operation::rose || node.operation == Operation::fell;
  });
}

void Expression::bind(const std::function<std::uint32_t(const std::string& name)>& number_of,
                      const std::function<bool(std::uint32_t)>& is_text, unsigned history) {
  if (history_ > history) {
    fail(1, "looks " + std::to_string(history_) +
                " clocks back: that needs a clock to count by (trace find --every, trace values "
                "--every)");
  }
  bound_.clear();
  for (const std::string& name : names_) {
    try {
      bound_.push_back(number_of(name));
    } catch (const InputError& error) {
      refuse(name, error.what());
    }
  }
  // Units are compared whether or not the values are known.
  evaluate(
      root_,
      [&](std::uint32_t place, unsigned) {
        ExpressionValue value = ExpressionValue::unknown();
        value.may_be_text = is_text != nullptr;
        value.is_text = is_text && is_text(bound_[place]);
        return value;
      },
      0);
}

std::vector<std::string> Expression::names_beside_texts() const {
  std::vector<std::string> names;
  const auto is_quoted = [&](const Node& node) {
    return node.operation == Operation::constant && constants_[node.left].is_text;
  };
  for (const Node& node : nodes_) {
    if (node.operation != Operation::equal && node.operation != Operation::unequal) continue;
    const Node &left = nodes_[node.left], &right = nodes_[node.right];
    if (is_quoted(right) && left.operation == Operation::name) names.push_back(names_[left.left]);
    if (is_quoted(left) && right.operation == Operation::name) names.push_back(names_[right.left]);
  }
  return names;
}

ExpressionValue Expression::value(const ExpressionValues& values) const {
  return evaluate(
      root_,
      [&](std::uint32_t place, unsigned ago) {
        return ago == 0   ? values.now(bound_[place])
               : ago == 1 ? values.before(bound_[place])
                          : values.past(bound_[place], ago);
      },
      0);
}

std::vector<ExpressionValue> Expression::looked_up(const Lookup& lookup) const {
  for (const Node& node : nodes_) {
    const bool edge = node.operation >= Operation::rises && node.operation <= Operation::changes;
    if (edge || node.operation >= Operation::past) {
      fail(node.column,
           edge ? "'rises', 'falls' and 'changes' are for traces: here nothing was before"
                : "'past' and its like are for traces: here nothing was before");
    }
  }
  std::vector<ExpressionValue> found;
  for (const std::string& name : names_) {
    try {
      found.push_back(lookup(name));
    } catch (const InputError& error) {
      refuse(name, error.what());
    }
  }
  return found;
}

ExpressionValue Expression::value(const Lookup& lookup) const {
  const std::vector<ExpressionValue> found = looked_up(lookup);
  return evaluate(
      root_, [&](std::uint32_t place, unsigned) { return found[place]; }, 0);
}

double Expression::shortfall(const Lookup& lookup) const {
  const std::vector<ExpressionValue> found = looked_up(lookup);
  return shortfall(root_, [&](std::uint32_t place, unsigned) { return found[place]; });
}

double Expression::shortfall(std::uint32_t place, const At& at) const {
  if (evaluate(place, at, 0).holds()) return 0;
  const Node& node = nodes_[place];
  if (node.operation == Operation::both)
    return shortfall(node.left, at) + shortfall(node.right, at);
  if (node.operation == Operation::either)
    return std::min(shortfall(node.left, at), shortfall(node.right, at));
  const bool compares =
      node.operation == Operation::equal ||
      (node.operation >= Operation::less && node.operation <= Operation::greater_equal);
  if (!compares) return 1;
  const ExpressionValue left = evaluate(node.left, at, 0);
  const ExpressionValue right = evaluate(node.right, at, 0);
  const long double scale = std::max(std::fabs(left.number), std::fabs(right.number));
  if (!left.known || !right.known || left.is_text || !(scale > 0)) return 1;
  return static_cast<double>(std::fabs(left.number - right.number) / scale);
}

ExpressionValue Expression::evaluate(std::uint32_t place, const At& at, unsigned ago) const {
  const Node& node = nodes_[place];
  switch (node.operation) {
    case Operation::constant:
      return constants_[node.left];
    case Operation::name:
      return named(node, at, ago);
    case Operation::either:
    case Operation::both:
    case Operation::invert:
      return logic(node, at, ago);
    case Operation::past:
    case Operation::rose:
    case Operation::fell:
    case Operation::stable:
    case Operation::within:
    case Operation::count:
      return over_time(node, at, ago);
    default:
      break;
  }
  ExpressionValue left = evaluate(node.left, at, ago);
  // Arithmetic is exact up to 64 bits, and unknown beyond.
  const auto is_exact = [](const ExpressionValue& value) { return value.digits.empty(); };
  if (node.operation == Operation::negate) {
    check_number(node, left);
    left.known = left.known && is_exact(left);
    left.number = -left.number;
    left.digits.clear();
    return left;
  }
  // Before this instant nothing moves: both sides of an edge are one value. To compute it twice
  // would double the work with each edge inside another.
  const bool edge = node.operation >= Operation::rises && node.operation <= Operation::changes;
  const ExpressionValue right =
      edge && ago > 0 && !has_functions_
          ? left
          : evaluate(edge ? node.left : node.right, at, ago + (edge ? 1 : 0));
  if (node.operation < Operation::plus) return compared(node, left, right);
  check_number(node, left);
  check_number(node, right);
  left.known = left.known && is_exact(left) && is_exact(right);
  left.digits.clear();
  if (node.operation == Operation::times || node.operation == Operation::over)
    return scaled(node, std::move(left), right);
  check_same_unit(node, left, right, "adds");
  left.number += node.operation == Operation::plus ? right.number : -right.number;
  left.known = left.known && right.known;
  return left;
}

/// past(x, n) and its like.
ExpressionValue Expression::over_time(const Node& node, const At& at, unsigned ago) const {
  const std::uint32_t clocks = node.right;
  if (node.operation == Operation::past) return evaluate(node.left, at, ago + clocks);
  if (node.operation == Operation::within || node.operation == Operation::count) {
    const std::uint32_t looks = node.operation == Operation::within ? clocks + 1 : clocks;
    std::uint32_t held = 0;
    bool known = true;
    for (std::uint32_t i = 0; i < looks; ++i) {
      const ExpressionValue value = evaluate(node.left, at, ago + i);
      check_number(node, value);
      held += value.holds() ? 1 : 0;
      known = known && value.known;
    }
    if (node.operation == Operation::count) return static_cast<long double>(held);
    return truth(known || held > 0, held > 0);
  }
  const ExpressionValue now = evaluate(node.left, at, ago);
  const ExpressionValue before = evaluate(node.left, at, ago + 1);
  const bool known = now.known && before.known;
  if (node.operation == Operation::stable) {
    return truth(known, now.is_text == before.is_text && now.order(before) == 0);
  }
  check_number(node, now);
  check_number(node, before);
  const bool rises = node.operation == Operation::rose;
  return truth(known, (now.number != 0) == rises && (before.number != 0) != rises);
}

/// What a look at it costs, and how far back that is.
void Expression::measure() {
  std::vector<Cost> costs;
  for (const Node& node : nodes_) {  // those inside come first
    Cost cost;
    const bool leaf = node.operation == Operation::constant || node.operation == Operation::name;
    const bool single = node.operation == Operation::invert || node.operation == Operation::negate;
    const bool edge = node.operation >= Operation::rises && node.operation <= Operation::changes;
    if (!leaf) {
      const Cost& left = costs[node.left];
      cost = left;
      if (edge || node.operation >= Operation::past) {
        const std::uint64_t looks = node.operation == Operation::past     ? 1
                                    : node.operation == Operation::within ? node.right + 1
                                    : node.operation == Operation::count  ? node.right
                                                                          : 2;
        cost.work = left.work * (edge && !has_functions_ ? 1 : looks) + 1;
        cost.history +=
            node.operation == Operation::past ? node.right : static_cast<unsigned>(looks - 1);
        if (edge && !has_functions_) cost.history = 1;
      } else if (!single) {
        const Cost& right = costs[node.right];
        cost.work = left.work + right.work + 1;
        cost.history = std::max(left.history, right.history);
      }
    }
    if (cost.work > most_work)
      fail(node.column, "looks at too many clocks for each of many clocks: write it flatter");
    costs.push_back(cost);
  }
  history_ = costs[root_].history;
}

ExpressionValue Expression::named(const Node& node, const At& at, unsigned ago) const {
  ExpressionValue whole = at(node.left, ago);
  if (!node.sliced) return whole;
  check_number(node, whole);
  constexpr unsigned most_bits = 64;
  if (node.high >= most_bits && whole.known && !whole.is_wide)
    fail(node.column, "bit " + std::to_string(node.high) + " of a signal of 64 bits at most");
  if (whole.is_wide && whole.known) return sliced(std::move(whole), node);
  const unsigned width = node.high - node.low + 1;
  const std::uint64_t mask = width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
  constexpr auto most = static_cast<long double>(std::numeric_limits<std::uint64_t>::max());
  whole.known = whole.known && whole.number >= 0 && whole.number <= most;
  if (whole.known)
    whole.number =
        static_cast<long double>(static_cast<std::uint64_t>(whole.number) >> node.low & mask);
  return whole;
}

/// The bits of a signal of more than 64.
ExpressionValue Expression::sliced(ExpressionValue whole, const Node& node) {
  const std::string digits = whole.digits.empty() ? binary(static_cast<std::uint64_t>(whole.number))
                                                  : std::exchange(whole.digits, {});
  std::uint64_t bits = 0;
  for (unsigned bit = node.high + 1; bit-- > node.low;)
    bits = bits << 1 |
           static_cast<unsigned>(bit < digits.size() && digits[digits.size() - 1 - bit] == '1');
  whole.number = static_cast<long double>(bits);
  whole.is_wide = false;
  return whole;
}

/// One side may decide although the other is not known.
ExpressionValue Expression::logic(const Node& node, const At& at, unsigned ago) const {
  const ExpressionValue left = evaluate(node.left, at, ago);
  check_number(node, left);
  if (node.operation == Operation::invert) return truth(left.known, left.number == 0);
  const ExpressionValue right = evaluate(node.right, at, ago);
  check_number(node, right);
  const bool decides = node.operation == Operation::either;
  const auto decided = [&](const ExpressionValue& side) {
    return side.known && (side.number != 0) == decides;
  };
  if (decided(left) || decided(right)) return truth(true, decides);
  return truth(left.known && right.known, !decides);
}

ExpressionValue Expression::scaled(const Node& node, ExpressionValue left,
                                   const ExpressionValue& right) const {
  const Unit units[] = {plain(left.unit), plain(right.unit)};
  left.known = left.known && right.known;
  if (node.operation == Operation::times) {
    if (units[0] != Unit::none && units[1] != Unit::none)
      fail(node.column, "multiplies " + unit_text(left.unit) + " by " + unit_text(right.unit));
    left.number *= right.number;
    if (units[0] == Unit::none) left.unit = right.unit;
    return left;
  }
  if (units[1] != Unit::none) {
    check_same_unit(node, left, right, "divides");
    left.unit = Unit::none;
  }
  left.known = left.known && right.number != 0;
  if (left.known) left.number /= right.number;
  return left;
}

ExpressionValue Expression::compared(const Node& node, const ExpressionValue& left,
                                     const ExpressionValue& right) const {
  const bool equality = node.operation == Operation::equal ||
                        node.operation == Operation::unequal ||
                        node.operation == Operation::changes;
  if (left.is_text != right.is_text) {
    if (!left.may_be_text && !right.may_be_text)
      fail(node.column, "compares a text with a number: texts stand in quotes");
    // The value of a signal may have a name.
    const ExpressionValue& number = left.is_text ? right : left;
    const bool named = number.known && !number.text.empty() && left.known && right.known;
    if (!equality) fail(node.column, "compares texts: only == and != do that");
    return truth(named, (left.text == right.text) == (node.operation == Operation::equal));
  }
  if (left.is_text && !equality) fail(node.column, "compares texts: only == and != do that");
  check_same_unit(node, left, right, "compares");
  const auto order = [&] { return left.order(right); };
  const bool known = left.known && right.known;
  switch (node.operation) {
    case Operation::equal:
      return truth(known, order() == 0);
    case Operation::changes:
    case Operation::unequal:
      return truth(known, order() != 0);
    case Operation::falls:
    case Operation::less:
      return truth(known, order() < 0);
    case Operation::less_equal:
      return truth(known, order() <= 0);
    case Operation::rises:
    case Operation::greater:
      return truth(known, order() > 0);
    default:
      return truth(known, order() >= 0);
  }
}

void Expression::check_number(const Node& node, const ExpressionValue& value) const {
  if (!value.is_text) return;
  fail(node.column, value.known ? "calculates with the text '" + excerpt(value.text) + "'"
                                : std::string("calculates with a text"));
}

void Expression::check_same_unit(const Node& node, const ExpressionValue& left,
                                 const ExpressionValue& right, const char* what) const {
  if (plain(left.unit) == plain(right.unit)) return;
  fail(node.column,
       std::string(what) + " " + unit_text(left.unit) + " and " + unit_text(right.unit));
}

}  // namespace vp

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// A number out of a trace: 64 bits of mantissa hold every vector and every double exactly.
using WaveNumber = long double;

/// Where an expression finds its signals.
class WaveValues {
 public:
  virtual ~WaveValues() = default;
  /// The value that stands now, and the one before this instant; nothing if it is not known.
  virtual std::optional<WaveNumber> now(std::uint32_t signal) const = 0;
  virtual std::optional<WaveNumber> before(std::uint32_t signal) const = 0;
};

/// A condition or a number on signals, as triggers and checks write it:
///
///     feature_overflow rises and pixel_y >= 400
///     corner_data[18:10] * 640 + corner_data[9:0]
///
/// From the weakest: `or`; `and`; `not`; `== != < <= > >=`, and behind a value `rises`, `falls`,
/// `changes`; `+ -`; `*`. Values: numbers (12, 0x1F, 2.5), signals, bits of signals (`a[7:4]`,
/// `a[0]`), brackets. True is 1. What depends on an unknown value is unknown, and not true.
class WaveExpression {
 public:
  WaveExpression() = default;
  /// Throws InputError that shows the place.
  explicit WaveExpression(std::string_view text);

  const std::string& text() const { return text_; }
  /// The signals in it, as they are written there.
  const std::vector<std::string>& names() const { return names_; }
  /// Looks up every signal. What `number_of` throws passes.
  void bind(const std::function<std::uint32_t(const std::string& name)>& number_of);
  /// Of the signals in it, after bind().
  const std::vector<std::uint32_t>& signals() const { return signals_; }

  std::optional<WaveNumber> value(const WaveValues& values) const;
  /// True if it has rises, falls or changes in it: it speaks of an instant, not of a state.
  bool is_event() const;
  bool holds(const WaveValues& values) const {
    const auto result = value(values);
    return result && *result != 0;
  }

 private:
  friend class ExpressionParser;
  enum class Operation : std::uint8_t {
    number,
    signal,
    either,
    both,
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
    times
  };
  struct Node {
    Operation operation = Operation::number;
    std::uint32_t left = 0, right = 0;  ///< nodes; of a signal its place in names_
    WaveNumber number = 0;
    bool sliced = false;
    unsigned high = 63, low = 0;  ///< bits of a signal
  };
  std::optional<WaveNumber> evaluate(std::uint32_t node, const WaveValues& values, bool past) const;
  std::optional<WaveNumber> logic(const Node& node, const WaveValues& values, bool past) const;

  std::string text_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> signals_;
  std::vector<Node> nodes_;
  std::uint32_t root_ = 0;
};

/// The place in `paths` of a signal that a user wrote: its whole path, or the end of one path only
/// ("feature_overflow"). Throws InputError that begins with `where` and names what is near.
std::uint32_t find_path(const std::string& name, const std::vector<std::string>& paths,
                        const std::string& where);

}  // namespace vp

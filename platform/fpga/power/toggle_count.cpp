#include <fpga/power/toggle_count.h>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/wave_reader.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace platform::power {

namespace {

using vp::WaveValue;
using vp::WaveVariable;

constexpr double clocks_per_ps_and_mhz = 1e-6;

[[noreturn]] void fail(const ToggleSource& source, const std::string& problem) {
  throw vp::InputError("trace '" + source.trace + "': " + problem);
}

/// The scopes around the signals.
std::vector<std::string> scopes(const vp::WaveReader& reader) {
  std::vector<std::string> found;
  for (const WaveVariable& variable : reader.variables()) {
    for (std::size_t dot = variable.path.find('.'); dot != std::string::npos;
         dot = variable.path.find('.', dot + 1))
      found.push_back(variable.path.substr(0, dot));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = vp::nearest_match(name, names);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

const WaveVariable& clock_of(const vp::WaveReader& reader, const ToggleSource& source) {
  const WaveVariable* clock = reader.find(source.clock);
  if (!clock) {
    std::vector<std::string> names;
    for (const WaveVariable& variable : reader.variables()) names.push_back(variable.path);
    fail(source,
         "no signal '" + vp::excerpt(source.clock) + "'" + did_you_mean(source.clock, names));
  }
  if (clock->kind != WaveVariable::Kind::bits || clock->width != 1)
    fail(source, "the clock '" + source.clock + "' is not one bit");
  return *clock;
}

class Counter final : public vp::WaveHandler {
 public:
  /// `clock`: net, or none.
  explicit Counter(std::optional<std::uint32_t> clock) : clock_(clock) {}

  void watch(const WaveVariable& variable) {
    nets_.emplace(variable.net, Watched{{variable.path, variable.width, 0}, {}});
  }

  bool at(std::uint64_t ps) override {
    if (!first_ps_) first_ps_ = ps;
    return true;
  }

  void change(std::uint32_t net, const WaveValue& value) override {
    if (clock_ && net == *clock_) {
      clocks_ += clock_is_low_ && value.known && value.bits == 1;
      clock_is_low_ = value.known && value.bits == 0;
    }
    const auto found = nets_.find(net);
    if (found == nets_.end()) return;
    Watched& watched = found->second;
    std::string digits = vp::full_digits(value.text, watched.net.width);
    if (digits.size() == watched.digits.size()) {
      for (std::size_t i = 0; i < digits.size(); ++i)
        watched.net.toggles += is_low(watched.digits[i])
                                   ? is_high(digits[i])
                                   : is_high(watched.digits[i]) && is_low(digits[i]);
    }
    watched.digits = std::move(digits);
  }

  std::uint64_t first_ps() const { return first_ps_.value_or(0); }

  ToggleCount take() {
    ToggleCount count;
    count.clocks = clocks_;
    for (auto& [number, watched] : nets_) {
      count.bits += watched.net.width;
      count.toggles += watched.net.toggles;
      count.nets.push_back(std::move(watched.net));
    }
    std::sort(count.nets.begin(), count.nets.end(), [](const auto& a, const auto& b) {
      return a.toggles != b.toggles ? a.toggles > b.toggles : a.path < b.path;
    });
    return count;
  }

 private:
  struct Watched {
    ToggleCount::Net net;
    std::string digits;
  };

  static bool is_low(char digit) { return digit == '0' || digit == 'l'; }
  static bool is_high(char digit) { return digit == '1' || digit == 'h'; }

  std::optional<std::uint32_t> clock_;
  std::optional<std::uint64_t> first_ps_;
  bool clock_is_low_ = false;
  std::uint64_t clocks_ = 0;
  std::map<std::uint32_t, Watched> nets_;
};

}  // namespace

ToggleCount count_toggles(const ToggleSource& source) {
  vp::WaveReader reader(source.trace);
  std::optional<std::uint32_t> clock;
  if (source.clock_mhz <= 0) clock = clock_of(reader, source).net;
  Counter counter(clock);
  if (clock) reader.select(*clock);
  bool any = false;
  for (const WaveVariable& variable : reader.variables()) {
    const bool is_below =
        variable.path.compare(0, source.below.size() + 1, source.below + ".") == 0;
    if (!is_below || (clock && variable.net == *clock) || variable.width == 0 ||
        variable.is_event || variable.kind != WaveVariable::Kind::bits)
      continue;
    counter.watch(variable);
    reader.select(variable.net);
    any = true;
  }
  if (!any) {
    fail(source, "no signal below '" + vp::excerpt(source.below) + "'" +
                     did_you_mean(source.below, scopes(reader)));
  }
  reader.read(counter);
  ToggleCount count = counter.take();
  if (!clock) {
    const auto ps = static_cast<double>(reader.now_ps() - counter.first_ps());
    count.clocks = static_cast<std::uint64_t>(ps * source.clock_mhz * clocks_per_ps_and_mhz);
    if (count.clocks == 0) fail(source, "it is shorter than one clock");
  }
  if (count.clocks == 0) fail(source, "the clock '" + source.clock + "' never rises");
  return count;
}

}  // namespace platform::power

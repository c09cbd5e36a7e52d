#include <fpga/power/saif.h>
#include <fpga/power/toggle_count.h>

#include <vp/error.h>
#include <vp/net_activity.h>
#include <vp/text.h>
#include <vp/wave_reader.h>

#include <algorithm>
#include <filesystem>
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

std::vector<std::string> paths(const vp::WaveReader& reader) {
  return reader.paths().all();
}

std::vector<std::string> paths(const Saif& saif) {
  std::vector<std::string> found;
  for (const Saif::Bit& bit : saif.bits) found.push_back(bit.path);
  return found;
}

/// The scopes around the signals.
std::vector<std::string> scopes(const std::vector<std::string>& signals) {
  std::vector<std::string> found;
  for (const std::string& path : signals) {
    for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1))
      found.push_back(path.substr(0, dot));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = vp::nearest_match(name, names);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

bool is_below(const ToggleSource& source, const std::string& path) {
  return path.compare(0, source.below.size() + 1, source.below + ".") == 0;
}

[[noreturn]] void no_clock(const ToggleSource& source, const std::vector<std::string>& signals) {
  fail(source,
       "no signal '" + vp::excerpt(source.clock) + "'" + did_you_mean(source.clock, signals));
}

[[noreturn]] void nothing_below(const ToggleSource& source,
                                const std::vector<std::string>& signals) {
  fail(source, "no signal below '" + vp::excerpt(source.below) + "'" +
                   did_you_mean(source.below, scopes(signals)));
}

/// How many clocks of the given frequency a time has.
std::uint64_t clocks_in(double ps, const ToggleSource& source) {
  const auto clocks = static_cast<std::uint64_t>(ps * source.clock_mhz * clocks_per_ps_and_mhz);
  if (clocks == 0) fail(source, "it is shorter than one clock");
  return clocks;
}

void sort_by_activity(std::vector<ToggleCount::Net>& nets) {
  std::sort(nets.begin(), nets.end(), [](const auto& a, const auto& b) {
    return a.toggles != b.toggles ? a.toggles > b.toggles : a.path < b.path;
  });
}

const WaveVariable& clock_of(const vp::WaveReader& reader, const ToggleSource& source) {
  const WaveVariable* clock = reader.find(source.clock);
  if (!clock) no_clock(source, paths(reader));
  if (clock->kind != WaveVariable::Kind::bits || clock->width != 1)
    fail(source, "the clock '" + source.clock + "' is not one bit");
  return *clock;
}

class Counter final : public vp::WaveHandler {
 public:
  /// `clock`: net, or none.
  explicit Counter(std::optional<std::uint32_t> clock) : clock_(clock) {}

  void watch(const std::string& path, const WaveVariable& variable) {
    nets_.try_emplace(variable.net, path, variable.width);
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
    found->second.activity.change(value.text, 0);  // how long it has a value is not asked
  }

  std::uint64_t first_ps() const { return first_ps_.value_or(0); }

  ToggleCount take() {
    ToggleCount count;
    count.clocks = clocks_;
    for (const auto& [number, net] : nets_) {
      count.nets.push_back({net.path, net.width, net.activity.toggles()});
      count.bits += net.width;
      count.toggles += count.nets.back().toggles;
    }
    sort_by_activity(count.nets);
    return count;
  }

 private:
  struct Net {
    Net(const std::string& name, unsigned bits) : path(name), width(bits), activity(bits) {}
    std::string path;
    unsigned width;
    vp::NetActivity activity;
  };

  std::optional<std::uint32_t> clock_;
  std::optional<std::uint64_t> first_ps_;
  bool clock_is_low_ = false;
  std::uint64_t clocks_ = 0;
  std::map<std::uint32_t, Net> nets_;
};

ToggleCount count_trace(const ToggleSource& source) {
  vp::WaveReader reader(source.trace);
  std::optional<std::uint32_t> clock;
  if (source.clock_mhz <= 0) clock = clock_of(reader, source).net;
  Counter counter(clock);
  if (clock) reader.select(*clock);
  bool any = false;
  std::size_t place = 0;
  for (const std::string& path : reader.paths()) {
    const WaveVariable& variable = reader.variables()[place++];
    if (!is_below(source, path) || (clock && variable.net == *clock) || variable.width == 0 ||
        variable.is_event || variable.kind != WaveVariable::Kind::bits)
      continue;
    counter.watch(path, variable);
    reader.select(variable.net);
    any = true;
  }
  if (!any) nothing_below(source, paths(reader));
  reader.read(counter);
  ToggleCount count = counter.take();
  if (!clock)
    count.clocks = clocks_in(static_cast<double>(reader.now_ps() - counter.first_ps()), source);
  return count;
}

/// "top.word" of "top.word[3]".
std::string vector_of(const std::string& bit) {
  return bit.empty() || bit.back() != ']' ? bit : bit.substr(0, bit.rfind('['));
}

ToggleCount count_saif(const ToggleSource& source) {
  const Saif saif = read_saif(source.trace);
  const Saif::Bit* clock = nullptr;
  for (const Saif::Bit& bit : saif.bits) {
    if (!clock && bit.path == source.clock) clock = &bit;
  }
  if (!clock && source.clock_mhz <= 0) no_clock(source, paths(saif));
  ToggleCount count;
  count.clocks = clock ? clock->toggles / 2 : clocks_in(saif.duration_ps, source);
  std::map<std::string, ToggleCount::Net> nets;
  for (const Saif::Bit& bit : saif.bits) {
    // SAIF does not say which names are of one net: the clock's is known by what it does.
    const bool is_clock = clock && bit.toggles == clock->toggles && bit.high == clock->high;
    if (!is_below(source, bit.path) || is_clock) continue;
    const std::string path = vector_of(bit.path);
    ToggleCount::Net& net = nets.try_emplace(path, ToggleCount::Net{path}).first->second;
    ++net.width;
    net.toggles += bit.toggles;
    ++count.bits;
    count.toggles += bit.toggles;
  }
  if (nets.empty()) nothing_below(source, paths(saif));
  for (const auto& [path, net] : nets) count.nets.push_back(net);
  sort_by_activity(count.nets);
  return count;
}

}  // namespace

ToggleCount count_toggles(const ToggleSource& source) {
  const bool is_saif = std::filesystem::path(source.trace).extension() == ".saif";
  ToggleCount count = is_saif ? count_saif(source) : count_trace(source);
  if (count.clocks == 0) fail(source, "the clock '" + source.clock + "' never rises");
  return count;
}

}  // namespace platform::power

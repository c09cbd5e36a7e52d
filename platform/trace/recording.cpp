#include <trace/recording.h>

#include <vp/error.h>
#include <vp/unit.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;

/// What a picture has room for.
constexpr std::size_t longest_word = 64;

/// The state of a bit as a recording has it.
std::uint64_t state_of(std::string_view digit) {
  if (digit == "0" || digit == "l") return 0;
  if (digit == "1" || digit == "h") return 1;
  return digit == "z" ? 3 : 2;
}

class Recorder final : public vp::WaveHandler {
 public:
  Recorder(TraceFile& file, const RecordingOptions& options)
      : file_(file), options_(options), nets_(file.reader().nets()) {
    for (const std::string& name : options.signals)
      add(vp::find_path(name, file.paths(), "plot: "));
    if (!options.signals.empty()) return;
    options.filter.check(file.paths(), {});
    for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
      if (options.filter.selects(file.paths()[i])) add(i);
    }
  }

  Recording run() {
    vp::WaveReader& reader = file_.reader();
    if (options_.from_ps > 0) {
      if (const auto entry = reader.entry(options_.from_ps)) reader.enter(*entry);
    }
    reader.read(*this);
    if (!first_) throw vp::InputError("trace '" + file_.name() + "' has no values");
    if (*first_ >= options_.to_ps) {
      throw vp::InputError("trace '" + file_.name() + "' begins at " + vp::format_time(*first_) +
                           ", after the window ends");
    }
    if (now_ps_ < options_.from_ps) {
      throw vp::InputError("trace '" + file_.name() + "' ends at " + vp::format_time(now_ps_) +
                           ", before the window begins");
    }
    begin();
    result_.to_ps = std::max(std::min(now_ps_, options_.to_ps), result_.from_ps + 1);
    finish();
    return std::move(result_);
  }

 private:
  struct Net {
    std::int64_t signal = -1;         ///< place among the signals; -1: not asked for
    bool dropped = false;             ///< there is no room for its changes
    std::optional<std::string> last;  ///< its value
    Kind kind = Kind::bits;           ///< of `last`
    std::uint64_t last_ps = 0;        ///< of its last change that was kept
    std::unordered_map<std::string, std::uint64_t> place_of_word;
  };

  void add(std::uint32_t i) {
    const vp::WaveVariable& variable = file_.variable(i);
    if (variable.width == 0) return;
    if (result_.signals.size() >= options_.most_signals) {
      ++result_.left_out;
      return;
    }
    Net& net = nets_[variable.net];
    Recording::Signal signal;
    signal.path = file_.paths()[i];
    signal.width = variable.width;
    signal.same_as = net.signal;
    signal.form = variable.kind == Kind::real ? Recording::Form::real
                  : variable.kind == Kind::bits && variable.width == 1 && variable.enumeration == 0
                      ? Recording::Form::bit
                      : Recording::Form::words;
    if (net.signal < 0) {
      net.signal = static_cast<std::int64_t>(result_.signals.size());
      file_.reader().select(variable.net);
    }
    variable_of_.push_back(i);
    result_.signals.push_back(std::move(signal));
  }

  bool at(std::uint64_t ps) override {
    if (!first_) first_ = ps;
    if (ps >= options_.to_ps) {
      now_ps_ = options_.to_ps;
      return false;
    }
    if (ps > options_.from_ps) begin();
    now_ps_ = ps;
    return true;
  }
  void change(std::uint32_t number, const vp::WaveValue& value) override {
    Net& net = nets_[number];
    if (net.dropped) return;
    const bool is_event = is_event_of(net);
    if (is_event && now_ps_ < options_.from_ps) return;  // it is over when the window begins
    if (!is_event && net.last && net.kind == value.kind && *net.last == value.text) return;
    net.last = std::string(value.text);
    net.kind = value.kind;
    if (begun_) keep(net, now_ps_);
  }

  bool is_event_of(const Net& net) const {
    return file_.variable(variable_of_[place(net)]).is_event;
  }
  static std::size_t place(const Net& net) { return static_cast<std::size_t>(net.signal); }

  /// The values that are there at the window's start come first.
  void begin() {
    if (begun_) return;
    begun_ = true;
    result_.from_ps = std::max(options_.from_ps, *first_);
    for (Net& net : nets_) {
      net.last_ps = result_.from_ps;
      if (net.signal >= 0 && net.last) keep(net, result_.from_ps);
    }
  }
  void keep(Net& net, std::uint64_t ps) {
    Recording::Signal& signal = result_.signals[place(net)];
    const std::uint64_t delta = ps - std::exchange(net.last_ps, ps);
    if (signal.form == Recording::Form::bit && net.kind == Kind::bits) {
      append_number(signal.changes, delta << 2 | state_of(*net.last));
    } else {
      append_number(signal.changes, signal.form == Recording::Form::bit ? delta << 2 | 2 : delta);
      if (signal.form != Recording::Form::bit) append_number(signal.changes, word(net, signal));
    }
    ++signal.count;
    if (++kept_ > options_.most_changes) drop_one();
  }
  std::uint64_t word(Net& net, Recording::Signal& signal) {
    const vp::WaveVariable& variable = file_.variable(variable_of_[place(net)]);
    std::string text = shown_value(file_, variable, *net.last, net.kind);
    if (text.size() > longest_word) text = text.substr(0, longest_word) + "…";
    const auto [known, is_new] = net.place_of_word.emplace(std::move(text), signal.words.size());
    if (is_new) signal.words.push_back(known->first);
    return known->second;
  }
  /// Leaves out the signal that changes most: a clock, as a rule.
  void drop_one() {
    Net* most = nullptr;
    for (Net& net : nets_) {
      if (net.signal < 0 || net.dropped) continue;
      if (!most || result_.signals[place(net)].count > result_.signals[place(*most)].count)
        most = &net;
    }
    Recording::Signal& signal = result_.signals[place(*most)];
    kept_ -= signal.count;
    most->dropped = true;
    most->place_of_word.clear();
    signal.changes = {};
    signal.words.clear();
  }
  /// Takes out the signals that were dropped, and their other names.
  void finish() {
    std::vector<std::int64_t> place_of(result_.signals.size(), -1);
    std::vector<Recording::Signal> kept;
    for (std::size_t i = 0; i < result_.signals.size(); ++i) {
      Recording::Signal& signal = result_.signals[i];
      if (nets_[file_.variable(variable_of_[i]).net].dropped) {
        ++result_.left_out;
        continue;
      }
      if (signal.same_as >= 0) signal.same_as = place_of[static_cast<std::size_t>(signal.same_as)];
      place_of[i] = static_cast<std::int64_t>(kept.size());
      kept.push_back(std::move(signal));
    }
    result_.signals = std::move(kept);
  }

  TraceFile& file_;
  const RecordingOptions& options_;
  std::vector<Net> nets_;
  std::vector<std::uint32_t> variable_of_;  ///< by signal
  Recording result_;
  std::optional<std::uint64_t> first_;
  std::uint64_t now_ps_ = 0;
  std::size_t kept_ = 0;
  bool begun_ = false;
};

}  // namespace

void append_number(std::string& bytes, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes += static_cast<char>(number | 0x80);
  bytes += static_cast<char>(number);
}

Recording recording(TraceFile& file, const RecordingOptions& options) {
  return Recorder(file, options).run();
}

}  // namespace platform::trace

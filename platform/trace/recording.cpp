#include <trace/recording.h>

#include <vp/frame_gate.h>
#include <vp/varint.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace platform::trace {

namespace {

using Kind = vp::WaveVariable::Kind;

/// What a picture has room for.
constexpr std::size_t longest_word = 64;

/// The state of a bit as a recording has it; a weak one is what it drives to.
std::uint64_t state_of(std::string_view digit) {
  if (digit == "l") return 0;
  if (digit == "h") return 1;
  constexpr std::uint64_t unknown = 2;
  const auto place = Recording::states.find(digit);
  return place == std::string_view::npos ? unknown : place;
}

class Recorder final : private WindowReader {
 public:
  Recorder(TraceFile& file, const RecordingOptions& options)
      : WindowReader(file, options), options_(options), nets_(file.reader().nets()) {
    for (const std::string& name : options.signals)
      add(vp::find_path(name, file.paths(), "plot: "));
    if (!options.signals.empty()) return;
    for (std::uint32_t i = 0; i < file.paths().size(); ++i) add(i);
  }

  Recording run() {
    read();
    result_.to_ps = std::max(now().first, result_.from_ps + 1);
    end_pulses();
    finish();
    return std::move(result_);
  }

 private:
  struct Net {
    std::int64_t signal = -1;  ///< place among the signals; -1: not asked for
    bool is_event = false;
    bool dropped = false;             ///< there is no room for its changes
    std::optional<std::string> last;  ///< its value
    Kind kind = Kind::bits;           ///< of `last`
    std::uint64_t last_ps = 0;        ///< of its last change that was kept
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
      net.is_event = variable.is_event;
      if (net.is_event) net.last = "0";
      net.signal = static_cast<std::int64_t>(result_.signals.size());
      file_.reader().select(variable.net);
    }
    variable_of_.push_back(i);
    result_.signals.push_back(std::move(signal));
  }

  void begin(Moment start) override {
    result_.from_ps = start.first;
    for (Net& net : nets_) {
      net.last_ps = result_.from_ps;
      if (net.signal >= 0 && net.last) keep(net, result_.from_ps);
    }
  }
  void reach(Moment now) override {
    if (now.first > pulse_ps_) end_pulses();
  }
  void change(std::uint32_t number, const vp::WaveValue& value) override {
    Net& net = nets_[number];
    if (net.dropped || (net.is_event && (value.bits == 0 || !is_inside()))) return;
    if (net.last && net.kind == value.kind && *net.last == value.text) return;
    net.last = std::string(value.text);
    net.kind = value.kind;
    if (net.is_event) {
      pulses_.push_back(number);
      pulse_ps_ = now().first;
    }
    if (begun()) keep(net, now().first);
  }
  /// An event keeps no value.
  void end_pulses() {
    for (const std::uint32_t number : std::exchange(pulses_, {})) {
      Net& net = nets_[number];
      if (net.dropped) continue;
      net.last = "0";
      keep(net, pulse_ps_ + 1);
    }
  }
  static std::size_t place(const Net& net) { return static_cast<std::size_t>(net.signal); }

  void keep(Net& net, std::uint64_t ps) {
    Recording::Signal& signal = result_.signals[place(net)];
    const std::uint64_t delta = ps - std::exchange(net.last_ps, ps);
    if (signal.form == Recording::Form::bit) {
      const std::string_view state = net.kind == Kind::bits ? std::string_view(*net.last) : "x";
      vp::put_varint(signal.changes, delta << 3 | state_of(state));
    } else {
      vp::put_varint(signal.changes, delta);
      vp::put_varint(signal.changes, signal.words.place(word(net)));
    }
    ++signal.count;
    if (++kept_ > options_.most_changes) drop_one();
  }
  std::string word(const Net& net) const {
    const vp::WaveVariable& variable = file_.variable(variable_of_[place(net)]);
    const std::string text = shown_value(file_, variable, *net.last, net.kind);
    return text.size() > longest_word ? text.substr(0, longest_word) + "…" : text;
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
    signal.changes = {};
    signal.words = {};
  }
  /// Takes out the signals that were dropped, and their other names.
  void finish() {
    std::vector<std::int64_t> place_of(result_.signals.size(), -1);
    std::vector<Recording::Signal> kept;
    for (std::size_t i = 0; i < result_.signals.size(); ++i) {
      Recording::Signal& signal = result_.signals[i];
      if (nets_[file_.variable(variable_of_[i]).net].dropped) {
        ++result_.dropped;
        continue;
      }
      if (signal.same_as >= 0) signal.same_as = place_of[static_cast<std::size_t>(signal.same_as)];
      place_of[i] = static_cast<std::int64_t>(kept.size());
      kept.push_back(std::move(signal));
    }
    result_.signals = std::move(kept);
  }

  const RecordingOptions& options_;
  std::vector<Net> nets_;
  std::vector<std::uint32_t> variable_of_;  ///< by signal
  Recording result_;
  std::vector<std::uint32_t> pulses_;  ///< nets that are events and occur at `pulse_ps_`
  std::uint64_t pulse_ps_ = 0;
  std::size_t kept_ = 0;
};

}  // namespace

Recording recording(TraceFile& file, const RecordingOptions& options) {
  return Recorder(file, options).run();
}

}  // namespace platform::trace

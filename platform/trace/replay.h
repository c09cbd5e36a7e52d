#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <vp/expression.h>
#include <vp/wave_reader.h>

namespace platform::trace {

/// Other names for signals: a line each, `ours = theirs`, both whole paths; `#` begins a comment.
/// For traces of real hardware, whose tools name everything anew.
struct NameMap {
  struct Entry {
    std::string ours, theirs;
    std::uint64_t line;
  };
  std::string file;  ///< empty: no map
  std::vector<Entry> entries;
};

/// Throws vp::InputError with the line.
NameMap read_name_map(const std::string& file);

/// A trace under our names.
class TraceFile {
 public:
  /// Throws vp::InputError for a trace that cannot be read, and for entries of the map that name no
  /// signal in it, with what is near.
  explicit TraceFile(const std::string& file, const NameMap& map = {},
                     const vp::WaveOptions& options = {});

  vp::WaveReader& reader() { return reader_; }
  const vp::WaveReader& reader() const { return reader_; }
  /// By variable: our name where the map has one.
  const vp::WavePaths& paths() const { return map_ ? *map_ : reader_.paths(); }
  const vp::WaveVariable& variable(std::uint32_t i) const { return reader_.variables()[i]; }
  /// The variable called `path`; -1 if missing.
  std::int64_t find(const std::string& path) const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  vp::WaveReader reader_;
  std::optional<vp::WavePaths> map_;  ///< the paths under our names, if some have other ones
  std::unordered_map<std::string, std::uint32_t> mapped_;
};

/// What is odd about a trace, as "trace 't.vcd' has no $timescale …".
std::vector<std::string> warnings_of(const TraceFile& file);

/// Plays a trace back instant by instant: the values that stand, and those before the instant. A
/// clock edge samples the latter.
class Replay final : public vp::ExpressionValues, private vp::WaveHandler {
 public:
  using Slot = std::uint32_t;

  /// Told when all changes of an instant are there.
  class Listener {
   public:
    virtual ~Listener() = default;
    /// False: enough.
    virtual bool instant(std::uint64_t ps) = 0;
    /// What happens from now on is not in the trace ($dumpoff), or is again.
    virtual void recorded(std::uint64_t /*ps*/, bool /*is_recorded*/) {}
  };

  explicit Replay(TraceFile& file);

  /// Follows the variable; the same net gives the same slot.
  Slot watch(std::uint32_t variable);
  /// Follows the variable called `path`, if the trace has it.
  std::optional<Slot> follow(const std::string& path);
  /// Follows the signal a user wrote: see vp::find_path().
  Slot watch(const std::string& name);

  /// Nothing from then on is played: the trace ends there.
  void end_at(std::uint64_t ps) { to_ps_ = ps; }
  void run(Listener& listener);

  std::uint64_t first_ps() const { return first_ps_; }
  std::uint64_t last_ps() const { return std::min(file_.reader().now_ps(), to_ps_); }
  /// Slots that were written in this instant.
  const std::vector<Slot>& changed() const { return changed_; }

  vp::ExpressionValue now(Slot slot) const override { return number(slots_[slot], false); }
  vp::ExpressionValue before(Slot slot) const override { return number(slots_[slot], true); }
  bool known(Slot slot) const { return slots_[slot].now.known; }
  std::uint64_t bits(Slot slot) const { return slots_[slot].now.bits; }
  bool was_known(Slot slot) const { return slots_[slot].before.known; }
  std::uint64_t bits_before(Slot slot) const { return slots_[slot].before.bits; }
  /// As it is written in the trace; of a text what it says.
  const std::string& text(Slot slot) const { return slots_[slot].now.text; }
  const std::string& text_before(Slot slot) const { return slots_[slot].before.text; }
  vp::WaveVariable::Kind kind(Slot slot) const { return slots_[slot].now.kind; }
  vp::WaveVariable::Kind kind_before(Slot slot) const { return slots_[slot].before.kind; }
  std::uint32_t variable(Slot slot) const { return slots_[slot].variable; }
  unsigned width(Slot slot) const { return file_.variable(slots_[slot].variable).width; }
  /// True for a text, and for a vector of bits that has had a word as its value.
  bool has_words(Slot slot) const { return slots_[slot].has_words; }
  /// Binds the names of an expression to slots. Throws vp::InputError.
  /// `history`: how many instants, or clocks, it may look back.
  void bind(vp::Expression& expression, std::vector<Slot>& slots, unsigned history = 1);
  /// After run(): throws vp::InputError if a signal is compared with a word that never had one.
  void check_words(const vp::Expression& expression) const;
  /// Keeps the texts of all values, for those who show them; otherwise those of texts and of
  /// vectors above 64 bits only.
  void keep_texts() { keep_texts_ = true; }

 private:
  struct Value {
    vp::WaveVariable::Kind kind = vp::WaveVariable::Kind::bits;
    bool known = false;
    std::uint64_t bits = 0;
    double real = 0;
    std::string text;
  };
  struct State {
    std::uint32_t variable;
    bool touched, is_event, has_words, is_wide;
    const vp::WaveEnumeration* words;  ///< null: its values have no names
    Value now, before;
  };
  vp::ExpressionValue number(const State& state, bool past) const;
  bool at(std::uint64_t ps) override;
  void change(std::uint32_t net, const vp::WaveValue& value) override;
  void recorded(bool is_recorded) override;
  bool finish_instant();
  bool keeps_text(const State& state, vp::WaveVariable::Kind kind) const {
    return keep_texts_ || state.is_wide || kind == vp::WaveVariable::Kind::text;
  }

  TraceFile& file_;
  Listener* listener_ = nullptr;
  bool keep_texts_ = false;
  bool started_ = false;
  bool stopped_ = false;
  std::uint64_t first_ps_ = 0;
  std::uint64_t now_ps_ = 0;
  std::uint64_t to_ps_ = std::numeric_limits<std::uint64_t>::max();
  std::vector<int> slot_of_net_;
  std::vector<State> slots_;
  std::vector<Slot> changed_;
  std::vector<Slot> events_;  ///< that occur in this instant
};

/// An interrupt line in a trace. Which number it has, the bit of IRQ_F2P tells that rises with it
/// alone; before that it is the usual one.
class InterruptLine {
 public:
  /// `line` has a slot already; `irq_f2p`: the vector, if the trace has it.
  InterruptLine(Replay& replay, Replay::Slot line, std::optional<Replay::Slot> irq_f2p,
                std::uint64_t usual_id)
      : replay_(&replay), line_(line), irq_f2p_(irq_f2p), id_(usual_id) {}

  std::uint64_t id() const { return id_; }
  /// Looks at an instant: true if the line rises in it.
  bool rises();

 private:
  Replay* replay_;
  Replay::Slot line_;
  std::optional<Replay::Slot> irq_f2p_;
  std::uint64_t id_;
};

/// Digits without those on the left that an extension restores.
inline std::string_view shortest_digits(std::string_view digits) {
  while (digits.size() > 1 && digits[0] == '0' && (digits[1] == '0' || digits[1] == '1'))
    digits.remove_prefix(1);
  while (digits.size() > 1 && digits[0] == digits[1] && digits[0] != '0' && digits[0] != '1')
    digits.remove_prefix(1);
  return digits;
}

/// Reads a trace one instant at a time, for those who read two.
class Stepper final : private vp::WaveHandler {
 public:
  struct Change {
    std::uint32_t net;
    vp::WaveVariable::Kind kind;
    std::string text;  ///< of bits without leading zeros
  };

  explicit Stepper(TraceFile& file) : file_(file) {}

  /// False: the trace is over. Throws vp::InputError.
  bool next() {
    changes_.clear();
    if (over_) return false;
    now_ps_ = next_ps_;
    now_below_ps_ = next_below_ps_;
    stopped_ = false;
    file_.reader().read(*this);
    over_ = !stopped_;
    return started_;
  }
  std::uint64_t now_ps() const { return now_ps_; }
  /// The femtoseconds beyond now_ps().
  unsigned below_ps() const { return now_below_ps_; }
  const std::vector<Change>& changes() const { return changes_; }

 private:
  bool at(std::uint64_t ps) override {
    next_ps_ = ps;
    next_below_ps_ = file_.reader().below_ps();
    if (!started_) {
      started_ = true;
      now_ps_ = ps;
      now_below_ps_ = next_below_ps_;
      return true;
    }
    stopped_ = true;
    return false;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    const bool is_bits = value.kind == vp::WaveVariable::Kind::bits;
    changes_.push_back(
        {net, value.kind, std::string(is_bits ? shortest_digits(value.text) : value.text)});
  }

  TraceFile& file_;
  bool started_ = false, stopped_ = false, over_ = false;
  std::uint64_t now_ps_ = 0, next_ps_ = 0;
  unsigned now_below_ps_ = 0, next_below_ps_ = 0;
  std::vector<Change> changes_;
};

/// A value for people: vectors in hexadecimal, the rest as it is.
std::string readable(const std::string& text, vp::WaveVariable::Kind kind, unsigned width);

/// The same with its type: a name where the values have names, "0x2A" of a vector, "x" of what has
/// no value yet.
std::string shown_value(const TraceFile& file, const vp::WaveVariable& variable,
                        const std::string& text, vp::WaveVariable::Kind kind);

/// An edge of a signal, by which instants are counted: "top.clk", "top.clk falling".
struct ClockEdge {
  std::string signal;
  bool falling = false;
};

/// Throws vp::InputError for another word behind the name.
ClockEdge parse_clock_edge(const std::string& text);

/// Counts the edges of a clock up to now: of its wire, if it is in the trace, else of a frequency:
/// edge n falls at round(n · 10¹² / f) ps, as everywhere in the platform.
class SampleClock {
 public:
  /// `hertz` counts only if the trace has no wire called `path`.
  SampleClock(Replay& replay, const std::string& path, std::uint64_t hertz)
      : replay_(&replay), wire_(replay.follow(path)), hertz_(hertz) {}
  /// A wire that is followed already; its falling edges count if `falling`.
  SampleClock(Replay& replay, Replay::Slot wire, bool falling)
      : replay_(&replay), wire_(wire), falling_(falling) {}
  explicit SampleClock(std::uint64_t hertz) : hertz_(hertz) {}

  bool has_wire() const { return wire_.has_value(); }
  bool is_of(Replay::Slot wire, bool falling) const { return wire_ == wire && falling_ == falling; }
  /// From edge to edge, of a wire on average; 0 if it has not two edges.
  double period_s() const {
    constexpr double ps_in_s = 1e12;
    if (!wire_) return 1.0 / static_cast<double>(hertz_);
    if (edges_ < 2) return 0;
    return static_cast<double>(*last_edge_ps_ - first_edge_ps_) / static_cast<double>(edges_ - 1) /
           ps_in_s;
  }

  /// In every instant, before edges().
  void instant(std::uint64_t ps) {
    if (!wire_) {
      // The last n with n · 10¹² / f < ps + 1/2.
      constexpr unsigned __int128 twice = 2'000'000'000'000;
      const auto scaled = (static_cast<unsigned __int128>(ps) * 2 + 1) * hertz_;
      edges_ = static_cast<std::uint64_t>((scaled + twice - 1) / twice) - (hertz_ != 0 ? 1 : 0);
      return;
    }
    turned_ = edge_ = false;
    if (!replay_->known(*wire_) || !replay_->was_known(*wire_)) return;
    const bool high = replay_->bits(*wire_) != 0, was_high = replay_->bits_before(*wire_) != 0;
    edge_ = high != was_high && was_high == falling_;
    turned_ = high != was_high && !edge_;
    if (!edge_) return;
    if (edges_++ == 0) first_edge_ps_ = ps;
    last_edge_ps_ = ps;
  }
  std::uint64_t edges() const { return edges_; }

  /// True if an edge falls on `ps`, the present instant.
  bool falls_on(std::uint64_t ps) const {
    if (wire_) return edge_ || last_edge_ps_ == ps;
    constexpr unsigned __int128 second = 1'000'000'000'000;
    const auto place = (static_cast<unsigned __int128>(edges_) * second + hertz_ / 2) / hertz_;
    return static_cast<std::uint64_t>(place) == ps;
  }
  /// True if the wire goes back in the present instant.
  bool goes_back() const { return turned_; }
  /// From the wire's last edge to `ps`.
  std::optional<std::uint64_t> since_edge(std::uint64_t ps) const {
    if (!last_edge_ps_) return std::nullopt;
    return ps - *last_edge_ps_;
  }

 private:
  Replay* replay_ = nullptr;
  std::optional<Replay::Slot> wire_;
  bool falling_ = false;
  std::uint64_t hertz_ = 0;
  std::uint64_t edges_ = 0;
  std::uint64_t first_edge_ps_ = 0;
  std::optional<std::uint64_t> last_edge_ps_;
  bool edge_ = false, turned_ = false;
};

}  // namespace platform::trace

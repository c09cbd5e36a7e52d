#include <trace/questions.h>

#include <trace/tools.h>
#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <utility>

// Questions about single moments: when a condition holds, and what the signals are then.

namespace platform::trace {

namespace {

/// The edges of a clock in a replay.
class Edges {
 public:
  Edges(Replay& replay, const ClockEdge& edge)
      : replay_(replay), slot_(replay.watch(edge.signal)), falling_(edge.falling) {}

  /// One is in this instant.
  bool now() const {
    if (!replay_.known(slot_) || !replay_.was_known(slot_)) return false;
    const bool high = replay_.bits(slot_) != 0, was_high = replay_.bits_before(slot_) != 0;
    return high != was_high && was_high == falling_;
  }
  Replay::Slot slot() const { return slot_; }

 private:
  Replay& replay_;
  Replay::Slot slot_;
  bool falling_;
};

/// What an edge samples, and what the edges before it did.
class Samples final : public vp::ExpressionValues {
 public:
  Samples(const Replay& replay, std::vector<Replay::Slot> slots, unsigned history)
      : replay_(replay), slots_(std::move(slots)), rows_(history + 1) {
    for (auto& row : rows_) row.assign(slots_.size(), vp::ExpressionValue::unknown());
    place_of_.resize(slots_.empty() ? 0 : *std::max_element(slots_.begin(), slots_.end()) + 1);
    for (std::size_t i = 0; i < slots_.size(); ++i) place_of_[slots_[i]] = i;
  }

  /// At an edge: takes the values from before it.
  void take() {
    newest_ = (newest_ + 1) % rows_.size();
    for (std::size_t i = 0; i < slots_.size(); ++i) rows_[newest_][i] = replay_.before(slots_[i]);
  }
  vp::ExpressionValue now(std::uint32_t slot) const override { return past(slot, 0); }
  vp::ExpressionValue before(std::uint32_t slot) const override { return past(slot, 1); }
  vp::ExpressionValue past(std::uint32_t slot, unsigned ago) const override {
    if (ago >= rows_.size()) return vp::ExpressionValue::unknown();
    return rows_[(newest_ + rows_.size() - ago) % rows_.size()][place_of_[slot]];
  }

 private:
  const Replay& replay_;
  std::vector<Replay::Slot> slots_;
  std::vector<std::size_t> place_of_;                   ///< by slot
  std::vector<std::vector<vp::ExpressionValue>> rows_;  ///< a ring of edges
  std::size_t newest_ = 0;
};

/// A condition over a replay, on all instants or on the edges of a clock.
class Watch {
 public:
  Watch(Replay& replay, const std::string& text, const std::optional<ClockEdge>& every,
        const std::string& where)
      : replay_(replay) {
    if (every) edges_.emplace(replay, *every);
    constexpr unsigned any_history = 1'000'000;
    if (text.empty()) return;
    condition_ = vp::Expression(text, where);
    replay.bind(condition_, slots_, edges_ ? any_history : 1);
    if (edges_) samples_.emplace(replay, slots_, condition_.history());
  }

  /// There is something to look at in this instant. Call it in each.
  bool due() {
    if (edges_) {
      if (!edges_->now()) return false;
      if (samples_) samples_->take();
      return true;
    }
    const auto& changed = replay_.changed();
    return std::any_of(changed.begin(), changed.end(),
                       [&](Replay::Slot slot) { return uses(slot); });
  }
  /// The condition looks at it.
  bool uses(Replay::Slot slot) const {
    return std::find(slots_.begin(), slots_.end(), slot) != slots_.end();
  }
  vp::ExpressionValue value() const {
    if (condition_.text().empty()) return vp::ExpressionValue(1);
    return samples_ ? condition_.value(*samples_) : condition_.value(replay_);
  }
  bool is_event() const { return !condition_.text().empty() && condition_.is_event(); }
  bool is_clocked() const { return edges_.has_value(); }
  void check_words() const {
    if (!condition_.text().empty()) replay_.check_words(condition_);
  }

 private:
  Replay& replay_;
  vp::Expression condition_;
  std::vector<Replay::Slot> slots_;
  std::optional<Edges> edges_;
  std::optional<Samples> samples_;
};

class Finder final : public Replay::Listener {
 public:
  Finder(TraceFile& file, const FindOptions& options,
         const std::function<bool(const Occurrence&)>& take)
      : file_(file),
        options_(options),
        take_(take),
        replay_(file),
        watch_(replay_, options.condition, options.every, "find") {}

  FindSummary run() {
    replay_.run(*this);
    if (holds_ && !stopped_) {
      now_.open = true;
      end(std::min(replay_.last_ps(), options_.to_ps));
    }
    watch_.check_words();
    return summary_;
  }

 private:
  bool instant(std::uint64_t ps) override {
    if (ps >= options_.to_ps) return false;
    // An event is over when its instant is.
    if (holds_ && !watch_.is_clocked() && watch_.is_event()) end(now_.from_ps);
    if (watch_.due()) {
      const vp::ExpressionValue value = watch_.value();
      summary_.evaluated = summary_.evaluated || value.known;
      if (holds_ && !value.holds()) end(only_events_end() ? before_ps_ : ps);
      if (value.holds()) begin(ps);
    }
    before_ps_ = ps;
    return !stopped_;
  }
  /// Nothing happened but that events are over, which they were with their instant.
  bool only_events_end() const {
    if (watch_.is_clocked()) return false;
    const auto& changed = replay_.changed();
    return std::none_of(changed.begin(), changed.end(), [&](Replay::Slot slot) {
      const bool is_over =
          file_.variable(replay_.variable(slot)).is_event && replay_.bits(slot) == 0;
      return watch_.uses(slot) && !is_over;
    });
  }
  void begin(std::uint64_t ps) {
    if (!holds_) now_ = {std::max(ps, options_.from_ps), 0, 0, false};
    holds_ = true;
    if (ps >= options_.from_ps && watch_.is_clocked()) ++now_.clocks;
  }
  void end(std::uint64_t ps) {
    holds_ = false;
    // It was over before the window.
    if (ps < options_.from_ps || (ps == options_.from_ps && now_.clocks == 0 && ps != now_.from_ps))
      return;
    now_.until_ps = std::max(ps, now_.from_ps);
    const std::uint64_t length = now_.until_ps - now_.from_ps;
    ++summary_.times;
    summary_.clocks += now_.clocks;
    summary_.held_ps += length;
    if (length > summary_.longest_ps) {
      summary_.longest_ps = length;
      summary_.longest_at_ps = now_.from_ps;
    }
    stopped_ = !take_(now_);
  }

  const TraceFile& file_;
  const FindOptions& options_;
  const std::function<bool(const Occurrence&)>& take_;
  Replay replay_;
  Watch watch_;
  FindSummary summary_;
  Occurrence now_;
  std::uint64_t before_ps_ = 0;  ///< the last instant
  bool holds_ = false, stopped_ = false;
};

/// Writes rows at times, on edges or when a condition comes true.
class Reporter final : public Replay::Listener {
 public:
  /// `times_ps`: rising.
  Reporter(TraceFile& file, const ValuesOptions& options, std::vector<std::uint64_t> times_ps,
           const std::function<bool(const ValueRow&)>& take)
      : file_(file),
        options_(options),
        take_(take),
        replay_(file),
        watch_(replay_, options.when, options.every, "values --when"),
        times_(std::move(times_ps)) {
    replay_.keep_texts();
    for (const std::string& name : options.signals)
      slots_.push_back(replay_.watch(vp::find_path(name, file.paths(), "values: ")));
    occurred_ps_.resize(slots_.size());
  }

  /// False: nothing more is asked for.
  bool run() {
    replay_.run(*this);
    if (!times_.empty() && !stopped_) rows_until(replay_.last_ps() + 1, false);
    if (next_ < times_.size() && !stopped_) {
      throw vp::InputError("trace '" + file_.name() + "' ends at " +
                           vp::format_time(replay_.last_ps()) + ", before --at " +
                           vp::format_time(times_[next_]));
    }
    watch_.check_words();
    return !stopped_;
  }

 private:
  bool instant(std::uint64_t ps) override {
    if (!times_.empty()) {
      rows_until(ps, true);
      note_events(ps);
      return next_ < times_.size() && !stopped_;
    }
    if (ps >= options_.to_ps) return false;
    if (!watch_.due()) return true;
    const bool holds = watch_.value().holds();
    const bool comes = holds && (watch_.is_clocked() || !held_ || watch_.is_event());
    held_ = holds;
    if (comes && ps >= options_.from_ps) row(ps, watch_.is_clocked());
    return !stopped_;
  }
  /// Rows for the times before `ps`; the values that stood before this instant.
  void rows_until(std::uint64_t ps, bool before) {
    while (next_ < times_.size() && times_[next_] < ps && !stopped_) row(times_[next_++], before);
  }
  /// An event keeps no value: it is 1 at its own time only.
  void note_events(std::uint64_t ps) {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const bool is_event = file_.variable(replay_.variable(slots_[i])).is_event;
      if (is_event && replay_.bits(slots_[i]) != 0) occurred_ps_[i] = ps;
    }
  }
  void row(std::uint64_t ps, bool before) {
    ValueRow row{ps, {}};
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      const Replay::Slot slot = slots_[i];
      const vp::WaveVariable& variable = file_.variable(replay_.variable(slot));
      if (occurred_ps_[i] == ps) {
        row.values.emplace_back("1");
        continue;
      }
      const std::string& text = before ? replay_.text_before(slot) : replay_.text(slot);
      const auto kind = before ? replay_.kind_before(slot) : replay_.kind(slot);
      row.values.push_back(shown_value(file_, variable, text, kind));
    }
    stopped_ = !take_(row);
  }

  TraceFile& file_;
  const ValuesOptions& options_;
  const std::function<bool(const ValueRow&)>& take_;
  Replay replay_;
  Watch watch_;
  std::vector<Replay::Slot> slots_;
  std::vector<std::optional<std::uint64_t>> occurred_ps_;  ///< of events, by signal
  std::vector<std::uint64_t> times_;
  std::size_t next_ = 0;
  bool held_ = false, stopped_ = false;
};

}  // namespace

FindSummary find(TraceFile& file, const FindOptions& options,
                 const std::function<bool(const Occurrence&)>& take) {
  return Finder(file, options, take).run();
}

std::vector<std::string> value_columns(const TraceFile& file, const ValuesOptions& options) {
  std::vector<std::string> columns;
  for (const std::string& name : options.signals)
    columns.push_back(file.paths()[vp::find_path(name, file.paths(), "values: ")]);
  return columns;
}

void values(TraceFile& file, const ValuesOptions& options,
            const std::function<bool(const ValueRow&)>& take) {
  const int kinds = static_cast<int>(!options.at_ps.empty()) +
                    static_cast<int>(!options.when.empty() || options.every.has_value());
  if (kinds != 1)
    throw vp::InputError("values: say when: --at TIME, or --when CONDITION, or --every CLOCK");
  std::vector<std::uint64_t> times = options.at_ps;
  std::sort(times.begin(), times.end());
  if (times.empty()) Reporter(file, options, times, take).run();
  // Those that lie behind one entry to the file are read in one go.
  for (auto begin = times.begin(); begin != times.end();) {
    const auto entry = file.reader().entry(*begin);
    const auto end = std::find_if(begin, times.end(), [&](std::uint64_t ps) {
      return entry && file.reader().entry(ps) != entry;
    });
    if (entry) file.reader().enter(*entry);
    if (!Reporter(file, options, {begin, end}, take).run()) return;
    begin = end;
  }
}

}  // namespace platform::trace

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <sstream>

#include <trace/replay.h>
#include <trace/tools.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

// Reads a checks file: a check a line.

namespace platform::trace {

namespace {

constexpr std::uint64_t ps_per_second = 1'000'000'000'000;

/// What was read so far: a clock counts for the checks below it.
struct ChecksReader {
  std::string file;
  std::uint64_t line = 0;
  std::uint64_t clock_hz = 100'000'000;
  std::vector<Check> checks;
  std::map<std::string, std::uint64_t> line_of;  ///< of a check's name

  std::string where() const { return "checks '" + file + "', line " + std::to_string(line); }

  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError(where() + ": " + problem);
  }

  vp::Expression expression(std::string_view text) const { return vp::Expression(text, where()); }

  /// The two sides of the word `at`, which is between blanks.
  std::pair<std::string, std::string> split_at(const std::string& text, const std::string& at,
                                               const std::string& shape) const {
    const auto place = text.find(" " + at + " ");
    if (place == std::string::npos) fail("'" + at + "' is missing: write " + shape);
    return {text.substr(0, place), text.substr(place + at.size() + 2)};
  }

  std::uint64_t number(const std::string& text, vp::Unit unit, const std::string& what) const {
    try {
      const auto value = vp::parse_quantity(text, unit).whole();
      if (value && *value > 0 && *value <= std::numeric_limits<std::int64_t>::max()) {
        return static_cast<std::uint64_t>(*value);
      }
    } catch (const vp::InputError& error) {
      fail(what + " '" + text + "' " + error.what());
    }
    fail(what + " '" + text + "' is not a whole number above 0");
  }

  /// "20 cycles" of the clock, or a time.
  std::uint64_t duration(const std::string& text) const {
    if (text.find("cycle") == std::string::npos) return number(text, vp::Unit::time, "the time");
    const std::uint64_t cycles = number(text, vp::Unit::cycles, "the number");
    if (cycles > ps_per_second) fail("so many cycles never pass");
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(cycles) * ps_per_second /
                                      clock_hz);
  }

  void read_clock(const std::string& text) {
    clock_hz = number(text, vp::Unit::frequency, "the clock");
    if (clock_hz > ps_per_second) fail("the clock is too fast");
  }

  void read_check(const std::string& text);
};

void ChecksReader::read_check(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) fail("write 'name: always …' or 'clock 100 MHz'");
  Check check;
  check.name = vp::trim(text.substr(0, colon));
  check.text = vp::trim(text.substr(colon + 1));
  check.line = line;
  check.clock_hz = clock_hz;
  if (check.name.empty()) fail("the check has no name before ':'");
  const auto [other, is_new] = line_of.emplace(check.name, line);
  if (!is_new)
    fail("there is a check '" + check.name + "' in line " + std::to_string(other->second));
  const auto blank = check.text.find(' ');
  const std::string kind = check.text.substr(0, blank);
  const std::string rest =
      blank == std::string::npos ? "" : std::string(vp::trim(check.text.substr(blank)));
  if (kind == "always" || kind == "never") {
    check.kind = kind == "always" ? Check::Kind::always : Check::Kind::never;
    check.first = expression(rest);
  } else if (kind == "at") {
    check.kind = Check::Kind::at;
    const auto [when, what] = split_at(rest, "holds", "at CONDITION holds CONDITION");
    check.first = expression(when);
    check.second = expression(what);
  } else if (kind == "within") {
    check.kind = Check::Kind::within;
    const std::string shape = "within 20 cycles of CONDITION holds CONDITION";
    const auto [time, both] = split_at(rest, "of", shape);
    const auto [when, what] = split_at(both, "holds", shape);
    check.limit_ps = duration(time);
    check.first = expression(when);
    check.second = expression(what);
  } else if (kind == "stable") {
    check.kind = Check::Kind::stable;
    const auto [what, when] = split_at(rest, "while", "stable VALUE while CONDITION");
    check.first = expression(what);
    check.second = expression(when);
  } else if (kind == "increases") {
    check.kind = Check::Kind::increases;
    const auto [what, rest2] =
        split_at(rest, "when", "increases VALUE when CONDITION [restart CONDITION]");
    const auto restart = rest2.find(" restart ");
    check.first = expression(what);
    check.second = expression(rest2.substr(0, restart));
    if (restart != std::string::npos) check.restart = expression(rest2.substr(restart + 9));
  } else if (kind == "bursts") {
    check.kind = Check::Kind::bursts;
    const std::string shape = "bursts of 32 beats CONDITION last CONDITION";
    const auto [count, both] = split_at(" " + rest, "beats", shape);
    const auto [beat, last] = split_at(both, "last", shape);
    const std::string words(vp::trim(count));
    if (words.substr(0, 3) != "of ") fail("'of' is missing: write " + shape);
    check.limit = number(std::string(vp::trim(words.substr(3))), vp::Unit::none, "the length");
    check.second = expression(beat);
    check.first = expression(last);
  } else {
    const std::vector<std::string> kinds = {"always", "never",     "at",    "within",
                                            "stable", "increases", "bursts"};
    fail("'" + kind + "' is no kind of check: there are " + vp::join(kinds, ", "));
  }
  checks.push_back(std::move(check));
}

}  // namespace

std::vector<Check> read_checks(const std::string& file) {
  std::istringstream stream(vp::read_text(file, "checks"));
  ChecksReader reader;
  reader.file = file;
  for (std::string line; std::getline(stream, line);) {
    ++reader.line;
    const std::string text(vp::trim(line.substr(0, line.find('#'))));
    if (text.empty()) continue;
    if (text.rfind("clock ", 0) == 0) {
      reader.read_clock(std::string(vp::trim(text.substr(6))));
    } else {
      reader.read_check(text);
    }
  }
  if (reader.checks.empty()) throw vp::InputError("checks '" + file + "': there is none in it");
  return std::move(reader.checks);
}

namespace {

std::string shown(const vp::ExpressionValue& value) {
  if (!value.known) return "x";
  if (value.is_text) return "'" + value.text + "'";
  if (!value.digits.empty()) {
    constexpr std::size_t most = 40;
    const auto width = static_cast<unsigned>(value.digits.size());
    const std::string text = "0x" + readable(value.digits, vp::WaveVariable::Kind::bits, width);
    return text.size() <= most ? text : text.substr(0, most) + "…";
  }
  const auto whole = static_cast<std::uint64_t>(value.number);
  if (static_cast<long double>(whole) == value.number) return std::to_string(whole);
  return vp::format_fixed(static_cast<double>(value.number), 6);
}

/// A check at work. Conditions are looked at when a signal of theirs was written.
class Judge {
 public:
  Judge(const Check& check, Replay& replay)
      : check_(check), replay_(replay), first_(check.first), second_(check.second) {
    result.check = &check;
    replay.bind(first_, slots);
    if (!second_.text().empty()) replay.bind(second_, slots);
    if (check.restart) {
      restart_ = *check.restart;
      replay.bind(restart_, slots);
    }
    if (check.kind == Check::Kind::bursts) {
      clock_ = std::make_unique<SampleClock>(replay, "ps.fclk_clk0.clk", check.clock_hz);
    }
  }

  /// Something of it was written, or it waits.
  void instant(std::uint64_t ps);
  /// The trace does not say what happens, until it does again: what waits is not judged.
  void lose_sight(std::uint64_t ps) {
    while (!waiting_.empty() && ps > waiting_.front()) miss(waiting_.front());
    result.occasions -= waiting_.size();
    waiting_.clear();
    last_.reset();
    first_stood_ = second_stood_ = restart_stood_ = sampled_ = false;
    beats_ = 0;
    sees_burst_ = false;
  }
  /// In every instant: time passes.
  void pass(std::uint64_t ps) {
    if (clock_) clock_->instant(ps);
    if (!waiting_.empty() && ps > waiting_.front()) miss(waiting_.front());
  }
  void finish(std::uint64_t ps) {
    pass(ps);
    for (const vp::Expression* expression : {&first_, &second_, &restart_})
      replay_.check_words(*expression);
    if (clock_) bursts(ps);
    // A value that stood to the end without a change was looked at.
    if (check_.kind == Check::Kind::stable && second_.holds(replay_) && ps > looked_ps_) {
      ++result.occasions;
    }
    // What the trace's end left open was not judged.
    result.occasions -= static_cast<std::uint64_t>(std::count_if(
        waiting_.begin(), waiting_.end(), [ps](std::uint64_t deadline) { return deadline >= ps; }));
  }

  CheckResult result;
  std::vector<Replay::Slot> slots;

 private:
  void fail(std::uint64_t ps, const std::string& detail) {
    if (result.failures++ != 0) return;
    result.first_ps = ps;
    result.detail = detail;
  }
  void miss(std::uint64_t deadline) {
    fail(deadline, "not until then");
    waiting_.pop_front();
  }
  /// True in the instant in which it becomes true; an edge is true in its instant only.
  bool comes_true(const vp::Expression& condition, bool& stood) const {
    const bool holds = condition.holds(replay_);
    const bool comes = holds && (!stood || condition.is_event());
    stood = holds;
    return comes;
  }
  /// Values as they were before this instant, for those who sample them on a clock edge.
  struct Past final : vp::ExpressionValues {
    explicit Past(const Replay& replay) : replay(replay) {}
    vp::ExpressionValue now(std::uint32_t slot) const override { return replay.before(slot); }
    vp::ExpressionValue before(std::uint32_t slot) const override { return replay.before(slot); }
    const Replay& replay;
  };

  void increases(std::uint64_t ps);
  void bursts(std::uint64_t ps);

  const Check& check_;
  Replay& replay_;
  vp::Expression first_, second_, restart_;
  bool first_stood_ = false, second_stood_ = false, restart_stood_ = false;
  std::deque<std::uint64_t> waiting_;  ///< deadlines
  std::uint64_t looked_ps_ = 0;        ///< of `stable`: when one of its signals was written last
  std::optional<vp::ExpressionValue> last_;
  std::unique_ptr<SampleClock> clock_;
  bool sampled_ = false;
  std::uint64_t edges_ = 0, beats_ = 0;
  bool sees_burst_ = true;  ///< from its first beat
};

void Judge::instant(std::uint64_t ps) {
  switch (check_.kind) {
    case Check::Kind::always:
    case Check::Kind::never: {
      const auto value = first_.value(replay_);
      if (!value.known) return;
      ++result.occasions;
      const bool wrong = value.holds() == (check_.kind == Check::Kind::never);
      if (wrong && !first_stood_)
        fail(ps, check_.kind == Check::Kind::never ? "it holds" : "it does not hold");
      // An edge lasts for its instant: the next one is another.
      first_stood_ = wrong && !first_.is_event();
      return;
    }
    case Check::Kind::at:
      if (!comes_true(first_, first_stood_)) return;
      ++result.occasions;
      if (!second_.holds(replay_)) fail(ps, "it does not hold");
      return;
    case Check::Kind::within:
      if (comes_true(first_, first_stood_)) {
        ++result.occasions;
        // More than anybody asks for at a time: one failure says enough.
        if (waiting_.size() < 1000) waiting_.push_back(ps + check_.limit_ps);
      }
      if (second_.holds(replay_)) waiting_.clear();
      return;
    case Check::Kind::stable: {
      looked_ps_ = ps;
      const Past past(replay_);
      if (!second_.holds(past)) return;
      ++result.occasions;
      const auto now = first_.value(replay_), before = first_.value(past);
      if (now.known && before.known && (now.is_text != before.is_text || now.order(before) != 0))
        fail(ps, shown(now) + " after " + shown(before));
      return;
    }
    case Check::Kind::increases:
      increases(ps);
      return;
    case Check::Kind::bursts:
      bursts(ps);
      return;
  }
}

void Judge::increases(std::uint64_t ps) {
  if (check_.restart && comes_true(restart_, restart_stood_)) last_.reset();
  const bool comes = comes_true(second_, second_stood_);
  if (!second_stood_) return;
  const auto value = first_.value(replay_);
  // While the condition holds, only another value is another one.
  if (!value.known || (!comes && last_ && value.order(*last_) == 0)) return;
  ++result.occasions;
  if (last_ && value.order(*last_) <= 0) fail(ps, shown(value) + " after " + shown(*last_));
  last_ = value;
}

// All edges since the last look saw what stood before this instant.
void Judge::bursts(std::uint64_t ps) {
  const std::uint64_t edges = sampled_ ? clock_->edges() - edges_ : 0;
  sampled_ = true;
  edges_ = clock_->edges();
  const Past past(replay_);
  if (edges == 0 || !second_.holds(past)) return;
  const bool last = first_.holds(past);
  for (std::uint64_t i = 0; i < edges; ++i) {
    ++beats_;
    if (last) {
      if (sees_burst_) {
        ++result.occasions;
        if (beats_ != check_.limit) fail(ps, std::to_string(beats_) + " beats");
      }
      beats_ = 0;
      sees_burst_ = true;
    } else if (sees_burst_ && beats_ == check_.limit) {
      fail(ps, "not the last of " + std::to_string(beats_) + " beats");
    }
  }
}

struct Court : Replay::Listener {
  explicit Court(Replay& replay) : replay(replay) {}
  bool instant(std::uint64_t ps) override {
    ++instants;
    for (Judge& judge : judges) judge.pass(ps);
    for (const Replay::Slot slot : replay.changed()) {
      if (slot >= by_slot.size()) continue;
      for (const std::size_t i : by_slot[slot]) {
        if (seen[i] == instants) continue;
        seen[i] = instants;
        judges[i].instant(ps);
      }
    }
    return true;
  }
  void recorded(std::uint64_t ps, bool is_recorded) override {
    if (is_recorded) return;
    for (Judge& judge : judges) judge.lose_sight(ps);
  }
  void index() {
    for (std::size_t i = 0; i < judges.size(); ++i) {
      for (const Replay::Slot slot : judges[i].slots) {
        if (slot >= by_slot.size()) by_slot.resize(slot + 1);
        by_slot[slot].push_back(i);
      }
    }
    seen.assign(judges.size(), 0);
  }
  Replay& replay;
  std::deque<Judge> judges;
  std::vector<std::vector<std::size_t>> by_slot;
  std::uint64_t instants = 0;
  std::vector<std::uint64_t> seen;  ///< number of the instant of the last look
};

}  // namespace

std::vector<CheckResult> run_checks(TraceFile& trace, const std::vector<Check>& checks,
                                    bool skip_missing) {
  Replay replay(trace);
  Court court(replay);
  std::vector<CheckResult> skipped;
  for (const Check& check : checks) {
    try {
      court.judges.emplace_back(check, replay);
    } catch (const vp::InputError& error) {
      if (!skip_missing) {
        throw vp::InputError(std::string(error.what()) + " (in '" + trace.name() + "')");
      }
      CheckResult result;
      result.check = &check;
      result.skipped = true;
      result.missing = error.what();
      skipped.push_back(std::move(result));
    }
  }
  if (court.judges.empty()) {
    throw vp::InputError("trace '" + trace.name() + "' has the signals of none of the " +
                         std::to_string(checks.size()) + " checks: " + skipped.front().missing);
  }
  court.index();
  replay.run(court);
  std::vector<CheckResult> results = std::move(skipped);
  for (Judge& judge : court.judges) {
    judge.finish(replay.last_ps());
    results.push_back(judge.result);
  }
  std::sort(results.begin(), results.end(),
            [](const auto& a, const auto& b) { return a.check->line < b.check->line; });
  return results;
}

}  // namespace platform::trace

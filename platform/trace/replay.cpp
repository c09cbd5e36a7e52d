#include <trace/replay.h>

#include <gic_registers.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/frame_gate.h>
#include <vp/text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace platform::trace {

NameMap read_name_map(const std::string& file) {
  std::istringstream stream(vp::read_text(file, "map"));
  NameMap map;
  map.file = file;
  std::map<std::string, std::uint64_t> line_of;
  std::string line;
  for (std::uint64_t number = 1; std::getline(stream, line); ++number) {
    const std::string text(vp::trim(line.substr(0, line.find('#'))));
    if (text.empty()) continue;
    const auto sign = text.find('=');
    const auto fail = [&](const std::string& problem) {
      throw vp::InputError("map '" + file + "', line " + std::to_string(number) + ": " + problem);
    };
    if (sign == std::string::npos) fail("'" + text + "' should be 'ours = theirs'");
    NameMap::Entry entry{std::string(vp::trim(text.substr(0, sign))),
                         std::string(vp::trim(text.substr(sign + 1))), number};
    if (entry.ours.empty() || entry.theirs.empty()) fail("a name is missing beside '='");
    const auto [other, is_new] = line_of.emplace(entry.ours, number);
    if (!is_new)
      fail("'" + entry.ours + "' was named in line " + std::to_string(other->second) + " already");
    map.entries.push_back(std::move(entry));
  }
  return map;
}

TraceFile::TraceFile(const std::string& file, const NameMap& map, const vp::WaveOptions& options)
    : name_(file), reader_(file, options) {
  if (map.entries.empty()) return;
  map_ = reader_.paths();
  for (const NameMap::Entry& entry : map.entries) {
    const std::string where =
        "map '" + map.file + "', line " + std::to_string(entry.line) + ": in '" + file + "' ";
    const std::uint32_t place = vp::find_path(entry.theirs, reader_.paths(), where);
    map_->rename(place, entry.ours);
    mapped_[entry.ours] = place;
  }
}

std::vector<std::string> warnings_of(const TraceFile& file) {
  std::vector<std::string> warnings;
  for (const std::string& text : file.reader().warnings())
    warnings.push_back("trace '" + file.name() + "': " + text);
  return warnings;
}

std::int64_t TraceFile::find(const std::string& path) const {
  const auto mapped = mapped_.find(path);
  if (mapped != mapped_.end()) return mapped->second;
  const std::int64_t place = reader_.place_of(path);
  // One that the map names otherwise has its own name no more.
  const bool is_ours = place >= 0 && paths()[static_cast<std::size_t>(place)] == path;
  return is_ours ? place : -1;
}

namespace {

/// The name of a value; empty if it has none.
std::string word_for(const vp::WaveEnumeration& words, std::uint64_t bits) {
  for (const auto& [digits, word] : words.words) {
    std::uint64_t value = 0;
    const char* const end = digits.data() + digits.size();
    const auto parsed = std::from_chars(digits.data(), end, value, 2);
    if (parsed.ec == std::errc() && parsed.ptr == end && value == bits) return word;
  }
  return {};
}

/// Sets the number to that of known digits, which may be above 64 bits.
void widen(vp::ExpressionValue& value, const std::string& text, unsigned width) {
  std::string digits = vp::full_digits(text, width);
  for (char& digit : digits) digit = digit == '1' || digit == 'h' ? '1' : '0';
  digits.erase(0, std::min(digits.find('1'), digits.size()));
  value.is_wide = true;
  if (digits.size() <= 64) return;
  value.number = 0;
  for (const char digit : digits.substr(0, 64)) value.number = value.number * 2 + (digit - '0');
  value.number = std::ldexp(value.number, static_cast<int>(digits.size() - 64));
  value.digits = std::move(digits);
}

}  // namespace

Replay::Replay(TraceFile& file) : file_(file), slot_of_net_(file.reader().nets(), -1) {}

Replay::Slot Replay::watch(std::uint32_t variable) {
  const vp::WaveVariable& v = file_.variable(variable);
  if (slot_of_net_[v.net] < 0) {
    slot_of_net_[v.net] = static_cast<int>(slots_.size());
    file_.reader().select(v.net);
    const vp::WaveEnumeration* words =
        v.enumeration == 0 ? nullptr : &file_.reader().enumerations()[v.enumeration - 1];
    const bool has_words = words || v.kind == vp::WaveVariable::Kind::text;
    State state{variable, false, v.is_event, has_words, v.width > 64, words, {}, {}};
    state.now.kind = state.before.kind = v.kind;
    if (v.is_event) {  // one that has not occurred did not occur
      state.now.known = state.before.known = true;
      state.now.text = state.before.text = "0";
    }
    slots_.push_back(state);
  }
  return static_cast<Slot>(slot_of_net_[v.net]);
}

std::optional<Replay::Slot> Replay::follow(const std::string& path) {
  const std::int64_t variable = file_.find(path);
  if (variable < 0) return std::nullopt;
  return watch(static_cast<std::uint32_t>(variable));
}

Replay::Slot Replay::watch(const std::string& name) {
  return watch(vp::find_path(name, file_.paths()));
}

vp::ExpressionValue Replay::number(const State& state, bool past) const {
  const Value& value = past ? state.before : state.now;
  vp::ExpressionValue result = vp::ExpressionValue::unknown();
  if (value.known && value.kind == vp::WaveVariable::Kind::real) {
    result = value.real;
  } else if (value.known && value.kind == vp::WaveVariable::Kind::bits) {
    result = value.bits;
    if (state.is_wide) widen(result, value.text, file_.variable(state.variable).width);
  } else if (value.kind == vp::WaveVariable::Kind::text) {
    result.is_text = true;
    result.known = value.known;
    result.text = value.text;
  }
  result.may_be_text = true;
  if (state.words && value.known) result.text = word_for(*state.words, value.bits);
  return result;
}

void Replay::run(Listener& listener) {
  listener_ = &listener;
  file_.reader().read(*this);
  if (started_ && !stopped_) finish_instant();
}

bool Replay::at(std::uint64_t ps) {
  if (started_ && !finish_instant()) return false;
  stopped_ = ps >= to_ps_;
  if (stopped_) return false;
  if (!started_) first_ps_ = ps;
  started_ = true;
  now_ps_ = ps;
  return true;
}

bool Replay::finish_instant() {
  stopped_ = !listener_->instant(now_ps_);
  // An event lasts for its instant: the next one is one, too.
  for (const Slot slot : events_) {
    slots_[slot].now.bits = 0;
    slots_[slot].now.text = "0";
  }
  for (const Slot slot : changed_) {
    State& state = slots_[slot];
    state.touched = false;
    state.before.kind = state.now.kind;
    state.before.known = state.now.known;
    state.before.bits = state.now.bits;
    state.before.real = state.now.real;
    if (keeps_text(state, state.now.kind)) {
      state.before.text = state.now.text;
    }
  }
  changed_.clear();
  // In the next instant it is over, which may be news to a condition.
  for (const Slot slot : events_) changed_.push_back(slot);
  for (const Slot slot : events_) slots_[slot].touched = true;
  events_.clear();
  return !stopped_;
}

void Replay::change(std::uint32_t net, const vp::WaveValue& value) {
  const auto slot = static_cast<Slot>(slot_of_net_[net]);
  State& state = slots_[slot];
  if (!state.touched) changed_.push_back(slot);
  state.touched = true;
  if (state.is_event) {
    if (value.bits == 0 || state.now.bits != 0) return;
    events_.push_back(slot);
  }
  state.now.kind = value.kind;
  state.has_words = state.has_words || value.kind == vp::WaveVariable::Kind::text;
  state.now.known = value.known;
  state.now.bits = value.bits;
  state.now.real = value.real;
  if (keeps_text(state, value.kind)) {
    state.now.text.assign(value.text);
  }
}

void Replay::bind(vp::Expression& expression, std::vector<Slot>& slots, unsigned history) {
  expression.bind(
      [&](const std::string& name) {
        slots.push_back(watch(name));
        return slots.back();
      },
      [&](Slot slot) { return kind(slot) == vp::WaveVariable::Kind::text; }, history);
}

void Replay::check_words(const vp::Expression& expression) const {
  const auto& names = expression.names();
  for (const std::string& name : expression.names_beside_texts()) {
    const auto place = std::find(names.begin(), names.end(), name) - names.begin();
    if (!has_words(expression.bound()[static_cast<std::size_t>(place)]))
      expression.refuse(name, "compares a text with '" + name + "', whose values are numbers");
  }
}

void Replay::recorded(bool is_recorded) {
  if (listener_) listener_->recorded(now_ps_, is_recorded);
}

ClockEdge parse_clock_edge(const std::string& text) {
  const std::string trimmed(vp::trim(text));
  const std::size_t blank = trimmed.rfind(' ');
  ClockEdge edge{trimmed, false};
  if (blank != std::string::npos) {
    const std::string word = trimmed.substr(blank + 1);
    if (word != "rising" && word != "falling") {
      throw vp::InputError("clock '" + text + "': behind the name may stand 'rising' or 'falling'");
    }
    edge.falling = word == "falling";
    edge.signal = std::string(vp::trim(trimmed.substr(0, blank)));
  }
  if (edge.signal.empty()) throw vp::InputError("a clock is named: top.clk, or 'top.clk falling'");
  return edge;
}

bool InterruptLine::rises() {
  const bool high = replay_->known(line_) && replay_->bits(line_) != 0;
  if (!high || !replay_->was_known(line_) || replay_->bits_before(line_) != 0) return false;
  if (irq_f2p_ && replay_->known(*irq_f2p_) && replay_->was_known(*irq_f2p_)) {
    const std::uint64_t risen = replay_->bits(*irq_f2p_) & ~replay_->bits_before(*irq_f2p_);
    for (unsigned bit = 0; bit < gic::irq_f2p_bits; ++bit) {
      if (risen == std::uint64_t{1} << bit) id_ = gic::irq_f2p_id(bit);
    }
  }
  return true;
}

}  // namespace platform::trace

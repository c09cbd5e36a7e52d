#include <trace/replay.h>

#include <algorithm>
#include <map>
#include <sstream>

#include <gic_registers.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/frame_gate.h>
#include <vp/text.h>

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

TraceFile::TraceFile(const std::string& file, const NameMap& map) : name_(file), reader_(file) {
  std::vector<std::string> theirs;
  for (const vp::WaveVariable& variable : reader_.variables()) theirs.push_back(variable.path);
  paths_ = theirs;
  for (const NameMap::Entry& entry : map.entries) {
    const std::string where =
        "map '" + map.file + "', line " + std::to_string(entry.line) + ": in '" + file + "' ";
    paths_[vp::find_path(entry.theirs, theirs, where)] = entry.ours;
  }
}

int TraceFile::find(const std::string& path) const {
  const auto found = std::find(paths_.begin(), paths_.end(), path);
  return found == paths_.end() ? -1 : static_cast<int>(found - paths_.begin());
}

Replay::Replay(TraceFile& file) : file_(file), slot_of_net_(file.reader().nets(), -1) {}

Replay::Slot Replay::watch(std::uint32_t variable) {
  const vp::WaveVariable& v = file_.variable(variable);
  if (slot_of_net_[v.net] < 0) {
    slot_of_net_[v.net] = static_cast<int>(slots_.size());
    file_.reader().select(v.net);
    State state{variable, false, {}, {}};
    state.now.kind = state.before.kind = v.kind;
    slots_.push_back(state);
  }
  return static_cast<Slot>(slot_of_net_[v.net]);
}

std::optional<Replay::Slot> Replay::follow(const std::string& path) {
  const int variable = file_.find(path);
  if (variable < 0) return std::nullopt;
  return watch(static_cast<std::uint32_t>(variable));
}

Replay::Slot Replay::watch(const std::string& name) {
  return watch(vp::find_path(name, file_.paths()));
}

vp::ExpressionValue Replay::number(const Value& value) {
  if (!value.known || value.kind == vp::WaveVariable::Kind::text)
    return vp::ExpressionValue::unknown();
  if (value.kind == vp::WaveVariable::Kind::real) return value.real;
  return value.bits;
}

void Replay::run(Listener& listener) {
  listener_ = &listener;
  file_.reader().read(*this);
  if (started_ && !stopped_) finish_instant();
}

bool Replay::at(std::uint64_t ps) {
  if (started_ && !finish_instant()) return false;
  if (!started_) first_ps_ = ps;
  started_ = true;
  now_ps_ = ps;
  return true;
}

bool Replay::finish_instant() {
  stopped_ = !listener_->instant(now_ps_);
  for (const Slot slot : changed_) {
    State& state = slots_[slot];
    state.touched = false;
    state.before.known = state.now.known;
    state.before.bits = state.now.bits;
    state.before.real = state.now.real;
    if (keep_texts_ || state.now.kind == vp::WaveVariable::Kind::text) {
      state.before.text = state.now.text;
    }
  }
  changed_.clear();
  return !stopped_;
}

void Replay::change(std::uint32_t net, const vp::WaveValue& value) {
  const auto slot = static_cast<Slot>(slot_of_net_[net]);
  State& state = slots_[slot];
  if (!state.touched) changed_.push_back(slot);
  state.touched = true;
  state.now.known = value.known;
  state.now.bits = value.bits;
  state.now.real = value.real;
  if (keep_texts_ || value.kind == vp::WaveVariable::Kind::text) {
    state.now.text.assign(value.text);
  }
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

#include <trace/replay.h>

#include <gic_registers.h>
#include <trace/tools.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/frame_gate.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <vp/wave_writer.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

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

namespace {

using Kind = vp::WaveVariable::Kind;
using Writer = vp::WaveWriter;

class Cutter final : public vp::WaveHandler {
 public:
  Cutter(TraceFile& file, const std::string& to, const CutOptions& options)
      : file_(file), options_(options), ids_(file.reader().nets()), last_(file.reader().nets()) {
    options.filter.check(file.paths(), {});
    writer_ = vp::open_wave_writer(to);
    for (std::uint32_t i = 0; i < file.paths().size(); ++i) {
      if (options.filter.selects(file.paths()[i])) add(i);
    }
  }

  bool at(std::uint64_t ps) override {
    if (!first_ps_) first_ps_ = ps;
    if (ps >= options_.to_ps) {
      end_ps_ = options_.to_ps;
      return false;
    }
    if (begun_ || ps > start_ps()) begin();
    if (begun_) writer_->set_time(ps);
    now_ps_ = end_ps_ = ps;
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    if (begun_) {
      write(net, value.kind, value.text);
    } else {
      last_[net] = std::string(value.text);
    }
  }
  void finish() {
    if (!begun_ && now_ps_ < options_.from_ps) {
      throw vp::InputError("trace '" + file_.name() + "' ends at " + vp::format_time(now_ps_) +
                           ", before the window begins");
    }
    if (!begun_ && (!first_ps_ || *first_ps_ >= options_.to_ps)) {
      throw vp::InputError("trace '" + file_.name() + "' has nothing before " +
                           vp::format_time(options_.to_ps) + ", the end of the window");
    }
    begin();
    writer_->close(std::max(end_ps_, start_ps()));
  }

 private:
  void add(std::uint32_t i) {
    const vp::WaveVariable& variable = file_.variable(i);
    file_.reader().select(variable.net);
    const auto kind = variable.kind == Kind::real   ? Writer::Kind::real
                      : variable.kind == Kind::text ? Writer::Kind::text
                                                    : Writer::Kind::wire;
    try {
      ids_[variable.net].push_back(writer_->add(file_.paths()[i], kind, variable.width));
    } catch (const std::invalid_argument& error) {
      throw vp::InputError("trace '" + file_.name() + "': " + error.what());
    }
    net_of_id_.push_back(variable.net);
  }

  /// A trace of a window has nothing before its first instant.
  std::uint64_t start_ps() const { return std::max(options_.from_ps, first_ps_.value_or(0)); }
  /// With the values that stand at the window's start.
  void begin() {
    if (begun_) return;
    begun_ = true;
    Writer::WrittenValues values;
    for (const std::uint32_t net : net_of_id_) values.push_back(last_[net]);
    writer_->begin_written(start_ps(), values);
  }
  void write(std::uint32_t net, Kind kind, std::string_view text) {
    for (const Writer::Id id : ids_[net]) {
      if (kind == Kind::text) {
        writer_->change_text(id, text);
      } else {
        writer_->change_digits(id, text);
      }
    }
  }

  TraceFile& file_;
  CutOptions options_;
  std::unique_ptr<Writer> writer_;
  std::vector<std::vector<Writer::Id>> ids_;  ///< by net: a net may have several names
  std::vector<std::uint32_t> net_of_id_;
  std::vector<std::optional<std::string>> last_;  ///< by net, before the window
  bool begun_ = false;
  std::optional<std::uint64_t> first_ps_;
  std::uint64_t now_ps_ = 0, end_ps_ = 0;
};

}  // namespace

void cut(TraceFile& file, const std::string& to, const CutOptions& options) {
  Cutter cutter(file, to, options);
  file.reader().read(cutter);
  cutter.finish();
}

}  // namespace platform::trace

#include <vp/error.h>
#include <vp/file.h>
#include <vp/wave_reader.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "fst_reader.h"
#include "vcd_index.h"
#include "vcd_reader.h"
#include "wave_declared.h"

namespace vp {

namespace {

constexpr std::uint64_t fs_per_ps = 1000;

/// An FST begins with its header block, type 0, or is packed as a whole, type 254.
bool looks_like_fst(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  InputFile input(file, "trace");
  unsigned char first = 'x';
  const auto deadline = InputFile::HostClock::now() + InputFile::patience;
  return input.read(reinterpret_cast<char*>(&first), 1, deadline) == 1 &&
         (first == 0 || first == 254);
}

}  // namespace

WaveReader::WaveReader(const std::filesystem::path& file, const WaveOptions& options)
    : options_(options), file_(file), notes_(std::make_unique<WaveNotes>()) {
  if (looks_like_fst(file)) {
    fst_ = std::make_unique<FstReader>(file);
    timescale_fs_ = fst_->timescale_fs();
    wanted_.resize(fst_->nets().size());
    enumerations_ = std::move(fst_->enumerations());
    if (!fst_->remark().empty()) {
      if (options.strict)
        throw InputError("trace '" + file.string() + "' " + fst_->remark() + " (--strict)");
      notes_->add(fst_->remark(), 0);
    }
    declare(std::move(fst_->declared()));
  } else {
    vcd_ = std::make_unique<VcdReader>(file, options, *notes_);
    timescale_fs_ = vcd_->timescale_fs();
    wanted_.resize(vcd_->nets().size());
    enumerations_ = std::move(vcd_->enumerations());
    declare(std::move(vcd_->declared()));
  }
  if (variables_.empty()) throw InputError("trace '" + file.string() + "': it declares no signal");
}

WaveReader::~WaveReader() = default;

void WaveReader::declare(WaveDeclarations declared) {
  constexpr auto latest_fs =
      static_cast<unsigned __int128>(std::numeric_limits<std::int64_t>::max()) * fs_per_ps;
  constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  latest_steps_ =
      static_cast<std::uint64_t>(std::min<unsigned __int128>(latest_fs / timescale_fs_, last));
  ps_per_step_ = timescale_fs_ % fs_per_ps == 0 ? timescale_fs_ / fs_per_ps : 0;
  const auto nets = static_cast<std::uint32_t>(wanted_.size());
  WaveNames names = named(std::move(declared), nets, *notes_);
  variables_ = std::move(names.variables);
  paths_ = std::move(names.paths);
  by_name_ = std::make_unique<NameTable>(std::move(names.table));
  selected_.resize(nets + names.joined.size());
  if (!names.joined.empty()) joiner_ = std::make_unique<WaveJoiner>(std::move(names.joined), nets);
}

std::uint64_t WaveReader::bytes() const {
  return fst_ ? fst_->bytes() : vcd_->bytes();
}

std::vector<std::string> WaveReader::warnings() const {
  return notes_->texts();
}

std::int64_t WaveReader::place_of(std::string_view path) const {
  return by_name_->find(path, paths_);
}

const WaveVariable* WaveReader::find(std::string_view path) const {
  const std::int64_t place = place_of(path);
  return place < 0 ? nullptr : &variables_[static_cast<std::size_t>(place)];
}

void WaveReader::select(std::uint32_t net) {
  selected_[net] = true;
  if (net < wanted_.size()) {
    wanted_[net] = true;
  } else {
    for (const WavePart& part : joiner_->parts(net)) wanted_[part.net] = true;
  }
}

void WaveReader::select_all() {
  for (const WaveVariable& variable : variables_) select(variable.net);
}

std::optional<std::uint64_t> WaveReader::entry(std::uint64_t ps) {
  constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  const auto wide = static_cast<unsigned __int128>(ps) * fs_per_ps / timescale_fs_;
  const std::uint64_t steps = wide > last ? last : static_cast<std::uint64_t>(wide);
  if (fst_) return fst_->block_before(steps);
  if (!index_) seek_index(steps);
  return index_ ? index_->place_before(steps) : std::nullopt;
}

/// One that is there is used; another one is made once, for a time that is worth it.
void WaveReader::seek_index(std::uint64_t steps) {
  if (options_.strict || !vcd_->can_enter() || index_ask_ == IndexAsk::refused) return;
  if (std::exchange(index_ask_, IndexAsk::missing) == IndexAsk::unknown)
    index_ = VcdIndex::kept(file_, options_, *notes_);
  if (!index_ && VcdIndex::is_worth_it(file_, options_, steps)) {
    index_ = VcdIndex::made(file_, options_, *notes_);
    if (!index_) index_ask_ = IndexAsk::refused;
  }
  if (index_) notes_->close();
}

void WaveReader::enter(std::uint64_t entry) {
  started_ = false;
  if (joiner_) joiner_->forget();
  if (fst_) {
    fst_->enter(entry);
  } else {
    entry_ = entry;
  }
}

/// Nets of the file that are wanted and keep their values; what occurred before is over.
std::vector<std::uint32_t> WaveReader::standing() const {
  std::vector<std::uint32_t> nets;
  for (std::uint32_t net = 0; net < wanted_.size(); ++net) {
    if (wanted_[net] && !vcd_->nets()[net].is_event) nets.push_back(net);
  }
  return nets;
}

void WaveReader::read(WaveHandler& handler) {
  WaveHandler* next = &handler;
  if (joiner_) {
    joiner_->begin(handler, selected_);
    next = joiner_.get();
  }
  struct Clock final : WaveClock {
    Clock(WaveReader& reader, WaveHandler& handler) : reader(reader), handler(handler) {}
    bool reach(std::uint64_t steps) override {
      stopped = !reader.reach(steps, handler);
      return !stopped;
    }
    WaveReader& reader;
    WaveHandler& handler;
    bool stopped = false;
  } clock(*this, *next);
  if (fst_) {
    fst_->read(wanted_, clock, *next);
  } else {
    if (entry_) {
      const VcdReader::Place& place = index_->place(*std::exchange(entry_, std::nullopt));
      vcd_->enter(place, index_->last_changes(place, standing()), wanted_, clock, *next);
    }
    if (!clock.stopped) vcd_->read(wanted_, clock, *next);
  }
  if (joiner_ && !clock.stopped) joiner_->flush();
}

/// In steps of the file's time. False: the handler has enough.
bool WaveReader::reach(std::uint64_t steps, WaveHandler& handler) {
  if (steps > latest_steps_) {
    const std::string problem =
        "the time " + std::to_string(steps) + " is too late: more than 106 days";
    if (vcd_) vcd_->fail(problem);
    throw InputError("trace '" + file_.string() + "': " + problem);
  }
  std::uint64_t ps = steps * ps_per_step_;
  unsigned below = 0;
  if (ps_per_step_ == 0) {
    const auto fs = static_cast<unsigned __int128>(steps) * timescale_fs_;
    ps = static_cast<std::uint64_t>(fs / fs_per_ps);
    below = static_cast<unsigned>(fs % fs_per_ps);
  }
  if (started_ && ps == now_ps_ && below == below_ps_) return true;
  started_ = true;
  now_ps_ = ps;
  below_ps_ = below;
  return handler.at(ps);
}

}  // namespace vp

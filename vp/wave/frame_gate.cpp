#include <vp/error.h>

#include <vp/frame_gate.h>
#include <vp/text.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

namespace vp {

namespace {

/// A new chunk after so many bytes: what is given up at once when the buffer is full.
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
constexpr const char* where = "--trace-trigger: ";

std::uint64_t take(const unsigned char*& at) {
  std::uint64_t number = 0;
  for (unsigned shift = 0;; shift += 7) {
    const unsigned char byte = *at++;
    number |= std::uint64_t{byte & 0x7Fu} << shift;
    if (byte < 0x80) return number;
  }
}

}  // namespace

/// Values of the gate for the condition.
class FrameGate::Values final : public ExpressionValues {
 public:
  explicit Values(const FrameGate& gate) : gate_(gate) {}
  ExpressionValue now(std::uint32_t id) const override { return number(id, gate_.values_[id]); }
  ExpressionValue before(std::uint32_t id) const override { return number(id, gate_.before_[id]); }

 private:
  ExpressionValue number(std::uint32_t id, std::uint64_t bits) const {
    if (gate_.kinds_[id] != Kind::real) return bits;
    double real = 0;
    std::memcpy(&real, &bits, sizeof real);
    return real;
  }
  const FrameGate& gate_;
};

FrameGate::FrameGate(std::unique_ptr<WaveWriter> target, FrameTrigger trigger)
    : target_(std::move(target)), trigger_(std::move(trigger)) {}

FrameGate::~FrameGate() = default;

std::vector<std::string> FrameGate::needed(const std::vector<std::string>& paths) const {
  std::vector<std::string> names = {paths[find_path(trigger_.frame, paths, where)]};
  for (const std::string& name : trigger_.condition.names()) {
    try {
      names.push_back(paths[find_path(name, paths)]);
    } catch (const InputError& error) {
      trigger_.condition.refuse(name, error.what());
    }
  }
  return names;
}

FrameGate::Id FrameGate::add(std::string_view path, Kind kind, unsigned width) {
  paths_.emplace_back(path);
  kinds_.push_back(kind);
  return target_->add(path, kind, width);
}

void FrameGate::begin(std::uint64_t ps, const std::vector<std::uint64_t>& values) {
  watched_.assign(paths_.size(), 0);
  const auto number_of = [this](const std::string& name) {
    const Id id = find_path(name, paths_);
    if (kinds_[id] == Kind::text)
      throw InputError("'" + name + "' is a text: only numbers trigger");
    watched_[id] = 1;
    return id;
  };
  frame_id_ = find_path(trigger_.frame, paths_, where);
  if (kinds_[frame_id_] == Kind::text)
    throw InputError(where + ("'" + trigger_.frame + "' is a text, no number of frames"));
  watched_[frame_id_] = 1;
  trigger_.condition.bind(number_of);
  begun_ = true;
  time_ps_ = ps;
  before_ = values_ = values;
  texts_.resize(values.size());
  frames_.emplace_back();
  open_chunk(frames_.back());
}

void FrameGate::put(std::uint64_t number) {
  std::vector<unsigned char>& bytes = frames_.back().chunks.back().changes;
  for (; number >= 0x80; number >>= 7) bytes.push_back(static_cast<unsigned char>(number | 0x80));
  bytes.push_back(static_cast<unsigned char>(number));
}

// 0 and the step of time, or an id + 1 and a value.
void FrameGate::put_time() {
  if (time_ps_ == chunk_time_ps_) return;
  put(0);
  put(time_ps_ - chunk_time_ps_);
  chunk_time_ps_ = time_ps_;
}

void FrameGate::set_time(std::uint64_t ps) {
  if (ps == time_ps_) return;
  end_instant();
  time_ps_ = ps;
}

// Judged when all changes of an instant are there.
void FrameGate::end_instant() {
  Chunk& chunk = frames_.back().chunks.back();
  if (watched_changed_) {
    watched_changed_ = false;
    triggered_ = triggered_ || trigger_.condition.holds(Values(*this));
    const bool new_frame = values_[frame_id_] != before_[frame_id_];
    for (Id id = 0; id < watched_.size(); ++id) {
      if (watched_[id]) before_[id] = values_[id];
    }
    if (new_frame) {
      end_frame(time_ps_);
      return;
    }
  }
  if (chunk.changes.size() >= chunk_bytes) {
    held_ += chunk.changes.size();
    open_chunk(frames_.back());
    keep_within_buffer();
  }
}

void FrameGate::open_chunk(Frame& frame) {
  frame.chunks.push_back({time_ps_, values_, texts_, {}});
  chunk_time_ps_ = time_ps_;
}

void FrameGate::keep_within_buffer() {
  while (held_ > trigger_.buffer) {
    Frame& oldest = frames_.front();
    if (oldest.chunks.size() > 1) {
      const std::size_t bytes = oldest.chunks.front().changes.size();
      held_ -= bytes;
      lost_bytes_ += bytes;
      oldest.chunks.pop_front();
    } else if (frames_.size() > 1) {
      held_ -= oldest.chunks.front().changes.size();
      frames_.pop_front();
    } else {
      return;  // the open chunk alone
    }
  }
}

// The instant of the new frame's first change belongs to both: the old one ends with it.
void FrameGate::end_frame(std::uint64_t ps) {
  frames_.back().end_ps = ps;
  held_ += frames_.back().chunks.back().changes.size();
  if (triggered_) {
    for (const Frame& frame : frames_) play(frame);
    frames_.clear();
    held_ = 0;
  }
  triggered_ = false;
  while (frames_.size() > trigger_.frames_before) {
    for (const Chunk& chunk : frames_.front().chunks) held_ -= chunk.changes.size();
    frames_.pop_front();
  }
  frames_.emplace_back();
  open_chunk(frames_.back());
}

void FrameGate::play(const Frame& frame) {
  ++kept_;
  const Chunk& first = frame.chunks.front();
  const auto texts_of = [this](const Chunk& chunk) {
    for (Id id = 0; id < kinds_.size(); ++id) {
      if (kinds_[id] == Kind::text) target_->change_text(id, chunk.texts[id]);
    }
  };
  if (!written_) {
    written_ = true;
    target_->begin(first.start_ps, first.values);
    texts_of(first);
  } else if (target_ps_ < first.start_ps) {
    target_->set_time(target_ps_ + 1);
    target_->pause();
    target_->set_time(first.start_ps);
    target_->resume(first.values);
    texts_of(first);
  }
  for (const Chunk& chunk : frame.chunks) play(chunk);
  target_->set_time(frame.end_ps);
  target_ps_ = frame.end_ps;
}

void FrameGate::play(const Chunk& chunk) {
  std::uint64_t ps = chunk.start_ps;
  const unsigned char* at = chunk.changes.data();
  const unsigned char* const end = at + chunk.changes.size();
  while (at != end) {
    const std::uint64_t what = take(at);
    if (what == 0) {
      ps += take(at);
      target_->set_time(ps);
      continue;
    }
    const Id id = static_cast<Id>(what - 1);
    if (kinds_[id] == Kind::text) {
      const std::uint64_t size = take(at);
      target_->change_text(id, {reinterpret_cast<const char*>(at), size});
      at += size;
    } else {
      target_->change(id, take(at));
    }
  }
}

void FrameGate::change(Id id, std::uint64_t bits) {
  if (values_[id] == bits) return;
  values_[id] = bits;
  if (watched_[id]) watched_changed_ = true;
  put_time();
  put(id + std::uint64_t{1});
  put(bits);
}

void FrameGate::begin_written(std::uint64_t, const WrittenValues&) {
  throw std::logic_error("FrameGate takes numbers, not digits");
}

void FrameGate::change_digits(Id, std::string_view) {
  throw std::logic_error("FrameGate takes numbers, not digits");
}

void FrameGate::change_text(Id id, std::string_view text) {
  texts_[id] = text;
  put_time();
  put(id + std::uint64_t{1});
  put(text.size());
  auto& bytes = frames_.back().chunks.back().changes;
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void FrameGate::pause() {
  throw std::logic_error("FrameGate makes pauses itself");
}

void FrameGate::resume(const std::vector<std::uint64_t>&) {
  pause();
}

void FrameGate::close(std::uint64_t end_ps) {
  if (begun_) {
    end_instant();
    time_ps_ = end_ps;
    end_frame(end_ps);
  }
  target_->close(target_ps_);
}

namespace {

using Levels = std::vector<std::string>;

constexpr std::size_t names_suggested = 6;

/// `*` and `?` inside one level.
bool level_matches(std::string_view pattern, std::string_view level) {
  if (pattern.empty()) return level.empty();
  if (pattern.front() == '*') {
    return level_matches(pattern.substr(1), level) ||
           (!level.empty() && level_matches(pattern, level.substr(1)));
  }
  return !level.empty() && (pattern.front() == '?' || pattern.front() == level.front()) &&
         level_matches(pattern.substr(1), level.substr(1));
}

bool levels_match(const Levels& pattern, std::size_t p, const Levels& path, std::size_t n) {
  if (p == pattern.size()) return n == path.size();
  if (pattern[p] == "**") {
    return levels_match(pattern, p + 1, path, n) ||
           (n < path.size() && levels_match(pattern, p, path, n + 1));
  }
  return n < path.size() && level_matches(pattern[p], path[n]) &&
         levels_match(pattern, p + 1, path, n + 1);
}

/// How many levels of `pattern`, from the left and up to the first `**`, fit the path.
std::size_t levels_in_common(const Levels& pattern, const Levels& path) {
  std::size_t common = 0;
  while (common < pattern.size() && common < path.size() && pattern[common] != "**" &&
         level_matches(pattern[common], path[common])) {
    ++common;
  }
  return common;
}

std::vector<std::string> nearest_first(const std::set<std::string>& names, const std::string& to) {
  std::vector<std::string> sorted(names.begin(), names.end());
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return edit_distance(to, a) < edit_distance(to, b);
  });
  return sorted;
}

}  // namespace

TraceFilter::TraceFilter(const std::vector<std::string>& patterns) {
  for (std::string list : patterns) {
    std::replace(list.begin(), list.end(), ',', ' ');
    for (const std::string& text : split(list, ' ')) {
      if (!text.empty()) patterns_.push_back(parse(text));
    }
  }
}

TraceFilter::Pattern TraceFilter::parse(std::string_view text) {
  Pattern pattern{std::string(text), text.front() != '-', true, {}};
  if (text.front() == '+' || text.front() == '-') text.remove_prefix(1);
  pattern.subtree = text.find_first_of("*?") == std::string_view::npos;
  pattern.levels = split(text, '.');
  for (const std::string& level : pattern.levels) {
    if (level.empty()) {
      throw InputError("trace filter '" + pattern.text +
                       "' has an empty level; write levels of the hierarchy with one '.' between");
    }
    if (level != "**" && level.find("**") != std::string::npos) {
      throw InputError("trace filter '" + pattern.text +
                       "': '**' represents whole levels; write '*' inside a level");
    }
  }
  return pattern;
}

bool TraceFilter::matches(const Pattern& pattern, std::string_view path) {
  const Levels levels = split(path, '.');
  if (!pattern.subtree) return levels_match(pattern.levels, 0, levels, 0);
  return pattern.levels.size() <= levels.size() &&
         std::equal(pattern.levels.begin(), pattern.levels.end(), levels.begin());
}

bool TraceFilter::selects(std::string_view path) const {
  bool selected = patterns_.empty() || !patterns_.front().take;
  for (const Pattern& pattern : patterns_) {
    if (pattern.take != selected && matches(pattern, path)) selected = pattern.take;
  }
  return selected;
}

void TraceFilter::check(const std::vector<std::string>& paths,
                        const std::vector<std::string>& hidden) const {
  if (paths.empty()) {
    throw InputError(hidden.empty()
                         ? "nothing to trace: this platform has no signals; trace a clocked model"
                         : "nothing to trace: there are registers only; choose the trace level "
                           "that shows registers");
  }
  for (const Pattern& pattern : patterns_) {
    const auto fits = [&](const std::string& path) { return matches(pattern, path); };
    if (!pattern.take || std::any_of(paths.begin(), paths.end(), fits)) continue;
    if (std::any_of(hidden.begin(), hidden.end(), fits)) {
      throw InputError("trace filter '" + pattern.text +
                       "' matches registers only; choose the trace level that shows registers");
    }
    throw InputError("trace filter '" + pattern.text + "' matches no signal; " +
                     suggestion(pattern, paths));
  }
  const auto selected = [&](const std::string& path) { return selects(path); };
  if (std::none_of(paths.begin(), paths.end(), selected)) {
    throw InputError("the trace filter leaves out all " + std::to_string(paths.size()) +
                     " signals; remove a '-' pattern, for example '" + patterns_.back().text + "'");
  }
}

void TraceFilter::check(const WavePaths& paths) const {
  std::vector<bool> fits(patterns_.size());
  bool any = false;
  for (const std::string& path : paths) {
    any = any || selects(path);
    for (std::size_t i = 0; i < patterns_.size(); ++i)
      fits[i] = fits[i] || !patterns_[i].take || matches(patterns_[i], path);
  }
  const bool all = std::find(fits.begin(), fits.end(), false) == fits.end();
  if (!any || !all) check(paths.all(), {});
}

std::string TraceFilter::suggestion(const Pattern& pattern, const std::vector<std::string>& paths) {
  std::size_t deepest = 0;
  for (const std::string& path : paths) {
    deepest = std::max(deepest, levels_in_common(pattern.levels, split(path, '.')));
  }
  const Levels parent(pattern.levels.begin(), pattern.levels.begin() + deepest);
  const bool any_depth = deepest < pattern.levels.size() && pattern.levels[deepest] == "**";
  std::set<std::string> names;
  for (const std::string& path : paths) {
    const Levels levels = split(path, '.');
    if (levels_in_common(pattern.levels, levels) != deepest || deepest == levels.size()) continue;
    names.insert(any_depth ? levels.back() : levels[deepest]);
  }
  if (names.empty()) return "'" + join(parent, ".") + "' is a signal, there is nothing below it";
  const std::string where = parent.empty() ? "" : "below '" + join(parent, ".") + "' ";
  const bool to_the_end = any_depth || deepest == pattern.levels.size();
  const std::string& wanted = to_the_end ? pattern.levels.back() : pattern.levels[deepest];
  std::vector<std::string> sorted = nearest_first(names, wanted);
  const bool more = sorted.size() > names_suggested;
  if (more) sorted.resize(names_suggested);
  return where + "there " + (sorted.size() == 1 ? "is " : "are ") + join(sorted, ", ") +
         (more ? " and others" : "");
}

namespace {

template <class Paths>
std::uint32_t find_in(const Paths& paths, const std::string& name, const std::string& where) {
  std::vector<std::string> fitting;
  std::uint32_t place = 0;
  const std::string ending = "." + name;
  constexpr std::size_t most = 4;
  std::size_t fit = 0;
  std::uint32_t i = 0;
  for (const std::string& path : paths) {
    if (path == name) return i;
    if (path.size() > ending.size() &&
        path.compare(path.size() - ending.size(), ending.size(), ending) == 0) {
      place = i;
      if (++fit <= most) fitting.push_back(path);
    }
    ++i;
  }
  if (fit == 1) return place;
  if (!fitting.empty()) {
    throw InputError(where + "'" + name + "' may be " + one_of(fitting) + ": write more of it");
  }
  const std::string nearest = nearest_match(name, {paths.begin(), paths.end()});
  throw InputError(where + "there is no signal '" + name + "'" +
                   (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

}  // namespace

std::uint32_t find_path(const std::string& name, const std::vector<std::string>& paths,
                        const std::string& where) {
  return find_in(paths, name, where);
}

std::uint32_t find_path(const std::string& name, const WavePaths& paths, const std::string& where) {
  return find_in(paths, name, where);
}

}  // namespace vp

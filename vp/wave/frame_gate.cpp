#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/trace_filter.h>

#include <cstring>
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

}  // namespace vp

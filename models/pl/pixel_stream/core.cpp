#include <pl/pixel_stream/core.h>

namespace pl {

void PixelStreamCore::step(const Input& input, bool ready) {
  const bool waits = !fifo_.empty(), room = fifo_.size() < fifo_depth_;
  const bool empty = !waits && !valid_;
  if (!valid_ || ready) {
    valid_ = waits;
    if (waits) {
      out_ = fifo_.front();
      fifo_.pop_front();
    }
  }
  take(input, ready, empty, room);
}

// Room is judged by the state before this clock, as a full flag does.
void PixelStreamCore::take(const Input& input, bool ready, bool empty, bool room) {
  const bool closed = closing_ && room;
  if (closed) {
    fifo_.push_back({0, true});
    closing_ = false;
  }
  if (input.starts) {
    // A frame whose first pixels are a word finds the FIFO taken by that end.
    passing_ = ready && empty && !closing_ && !(closed && input.word);
    words_ = 0;
    if (!passing_) ++dropped_frames_;
  }
  if (input.ends && passing_) cut();
  if (!input.word || !passing_) return;
  if (!room) return cut();
  fifo_.push_back({input.data, ++words_ == frame_words_});
  passing_ = words_ != frame_words_;
}

// A packet of which nothing was sent needs no end.
void PixelStreamCore::cut() {
  passing_ = false;
  closing_ = words_ != 0;
  ++cut_frames_;
}

void PixelStreamCore::take_back() {
  words_ -= held();
  fifo_.clear();
  valid_ = false;
}

void PixelStreamCore::skip(std::uint32_t count) {
  words_ += count;
  passing_ = words_ != frame_words_;
}

void PixelStreamCore::reset() {
  fifo_.clear();
  valid_ = passing_ = closing_ = false;
  words_ = dropped_frames_ = cut_frames_ = 0;
}

}  // namespace pl

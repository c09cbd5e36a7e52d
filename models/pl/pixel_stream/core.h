#pragma once

#include <cstdint>
#include <deque>

namespace pl {

/// FIFO, output register and packets of PixelStream, one clock a call. Plain C++.
class PixelStreamCore {
 public:
  /// What comes on an edge.
  struct Input {
    bool starts = false;  ///< the frame's first pixel
    bool ends = false;    ///< no pixel, but there was one on the edge before
    bool word = false;    ///< the last pixel of a word
    std::uint32_t data = 0;
  };
  struct Beat {
    std::uint32_t data = 0;
    bool last = false;
  };

  PixelStreamCore(std::uint32_t frame_words, std::uint32_t fifo_depth)
      : frame_words_(frame_words), fifo_depth_(fifo_depth) {}

  /// One edge; whether the slave was ready before it.
  void step(const Input& input, bool ready);
  void reset();
  /// What an edge does without input: nothing, unless a beat moves or the packet has to be closed.
  bool rests(bool ready) const { return valid_ ? !ready && !closes() : fifo_.empty() && !closing_; }

  /// A beat is offered.
  bool valid() const { return valid_; }
  const Beat& out() const { return out_; }
  std::uint32_t fifo_count() const { return static_cast<std::uint32_t>(fifo_.size()); }
  /// Words that the packet still waits for.
  std::uint32_t missing() const { return passing_ ? frame_words_ - words_ : 0; }
  /// Words in FIFO and register.
  std::uint32_t held() const { return fifo_count() + (valid_ ? 1 : 0); }
  /// Those held are as if they had not come yet.
  void take_back();
  /// Nothing is held: `count` words passed through, one clock in the FIFO and one in the register;
  /// fewer than missing(), or all.
  void skip(std::uint32_t count);

  std::uint32_t dropped_frames() const { return dropped_frames_; }
  std::uint32_t cut_frames() const { return cut_frames_; }

 private:
  bool closes() const { return closing_ && fifo_.size() < fifo_depth_; }
  void take(const Input& input, bool ready, bool empty, bool room);
  void cut();

  const std::uint32_t frame_words_, fifo_depth_;
  std::deque<Beat> fifo_;
  Beat out_;
  bool valid_ = false;
  bool passing_ = false;     ///< the frame's words are taken
  bool closing_ = false;     ///< its packet lacks its end
  std::uint32_t words_ = 0;  ///< of the packet so far
  std::uint32_t dropped_frames_ = 0, cut_frames_ = 0;
};

}  // namespace pl

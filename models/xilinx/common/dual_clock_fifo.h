#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include <vp/clock.h>

namespace xilinx {

/// Clocks that a pointer takes into the other clock of a FIFO: two registers, and one that compares
/// (assumed of the vendor's asynchronous FIFO).
constexpr std::uint32_t pointer_clocks = 3;

/// The memory of a FIFO between two clocks. Each side sees what the other one did some of its own
/// clocks later, so nothing depends on the order of edges that coincide.
template <class T>
class DualClockFifo {
 public:
  /// `clocks` at least 1.
  DualClockFifo(const vp::Clock& write, const vp::Clock& read, std::uint32_t clocks)
      : write_(write), read_(read), clocks_(clocks) {}

  // In the edge of the writer.
  /// Entries that it holds as far as the writer knows.
  std::size_t writer_level() {
    while (!freed_.empty() && freed_.front() <= write_.cycle()) {
      freed_.pop_front();
      --written_;
    }
    return written_;
  }
  void push(T value) {
    ++written_;
    entries_.push_back({std::move(value), read_.cycle() + clocks_});
  }
  /// The edge of the writer on which an entry becomes free; never: none was taken.
  std::uint64_t next_free() const { return freed_.empty() ? vp::Clock::never : freed_.front(); }

  // In the edge of the reader.
  std::size_t reader_level() {
    while (visible_ < entries_.size() && entries_[visible_].visible <= read_.cycle()) ++visible_;
    return visible_;
  }
  const T& front() const { return entries_.front().value; }
  /// Takes the first one, which is visible.
  void pop() {
    entries_.pop_front();
    visible_ -= std::min<std::size_t>(visible_, 1);
    freed_.push_back(write_.cycle() + clocks_);
  }
  /// The edge of the reader on which the next entry becomes visible; never: there is no other.
  std::uint64_t next_visible() const {
    return visible_ < entries_.size() ? entries_[visible_].visible : vp::Clock::never;
  }

  /// Both sides are reset.
  void clear() {
    entries_.clear();
    freed_.clear();
    visible_ = written_ = 0;
  }

 private:
  struct Entry {
    T value;
    std::uint64_t visible;  ///< edge of the reader
  };

  const vp::Clock& write_;
  const vp::Clock& read_;
  const std::uint32_t clocks_;
  std::deque<Entry> entries_;
  std::deque<std::uint64_t> freed_;  ///< edges of the writer on which it learns of a taken entry
  std::size_t visible_ = 0;          ///< of the entries: those that the reader knows of
  std::size_t written_ = 0;          ///< entries as the writer counts
};

}  // namespace xilinx

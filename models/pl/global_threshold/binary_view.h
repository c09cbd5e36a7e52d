#pragma once

#include <cstdint>
#include <vector>

namespace pl {

/// Told what becomes of a binary image.
class BinaryListener {
 public:
  virtual ~BinaryListener() = default;
  /// A new frame is about to take the place of the one before.
  virtual void binary_begins() {}
  /// Pixels from raster index `first` on changed; none of them had left the threshold.
  virtual void binary_changed(std::uint32_t /*first*/) {}
  /// The pixel side is reset now: no further word leaves, what is under way is lost.
  virtual void binary_cut() {}
};

/// The binary image of a frame, for models that look at all of it at once: what left the threshold
/// as it was then, the rest as it is going to be if nothing else happens.
class BinaryView {
 public:
  /// Bit i of word w is pixel 32w + i, 1 is dark. Valid until the next frame begins.
  const std::uint32_t* words() const { return words_; }
  /// Words of the frame that began last; 0 before the first.
  std::uint32_t size() const { return size_; }
  /// The pixel-clock edge on which word `index` leaves.
  std::uint64_t leaves_at(std::uint32_t index) const { return first_cycle_ + 32u * index + 31u; }

  void add_listener(BinaryListener& listener) { listeners_.push_back(&listener); }

  // For the threshold only.
  /// The words of the frame before are about to be overwritten.
  void prepare() {
    for (BinaryListener* listener : listeners_) listener->binary_begins();
  }
  /// The first pixel is taken on edge `first_cycle`.
  void begin(const std::vector<std::uint32_t>& words, std::uint64_t first_cycle) {
    words_ = words.data();
    size_ = static_cast<std::uint32_t>(words.size());
    first_cycle_ = first_cycle;
  }
  void change(std::uint32_t first) {
    for (BinaryListener* listener : listeners_) listener->binary_changed(first);
  }
  void cut() {
    for (BinaryListener* listener : listeners_) listener->binary_cut();
  }

 private:
  const std::uint32_t* words_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint64_t first_cycle_ = 0;
  std::vector<BinaryListener*> listeners_;
};

}  // namespace pl

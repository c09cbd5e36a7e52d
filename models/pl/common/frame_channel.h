#pragma once

#include <cstdint>
#include <vector>

namespace pl {

/// Told of a frame that passes.
class FrameListener {
 public:
  virtual ~FrameListener() = default;
  /// From the next edge on the memory is read.
  virtual void frame_begins() {}
  /// `count` pixels from raster index `first` on changed; none of them had left the source.
  virtual void pixels_changed(std::uint32_t /*first*/, std::uint32_t /*count*/) {}
};

/// What a source of pixels offers at transaction level in place of its pixel ports: the frame that
/// passes, as a whole. Its enable signal rises and falls as at clocked fidelity.
class FrameChannel {
 public:
  virtual ~FrameChannel() = default;

  /// Of the frame that began last: valid until the one after the next begins. Pixels that did not
  /// leave the source yet may change; listeners are told after they did.
  virtual const std::uint8_t* pixels() const = 0;

  void add_listener(FrameListener& listener) { listeners_.push_back(&listener); }

 protected:
  std::vector<FrameListener*> listeners_;
};

}  // namespace pl

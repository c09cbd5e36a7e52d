#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <systemc>
#include <vector>

#include <pl/common/fidelity.h>
#include <vp/clock.h>
#include <vp/error.h>
#include <vp/ip.h>

namespace pl {

/// Called for the frames that pass a channel.
class FrameListener {
 public:
  virtual ~FrameListener() = default;
  /// A frame is about to take the place of the one before.
  virtual void frame_begins() {}
  /// `count` pixels from raster index `first` on changed; none of them had left the source.
  virtual void pixels_changed(std::uint32_t /*first*/, std::uint32_t /*count*/) {}
  /// The source is in reset: nothing more of the frame leaves it.
  virtual void frame_cut() {}
};

/// What an IP offers at transaction level in place of its pixel ports: the frame that passes, as a
/// whole. Its enable signal rises and falls as at clocked fidelity.
///
/// Pixels that have left the IP keep the value that they had then; the others have the value with
/// which they will leave if nothing else happens, and listeners are called when that changes.
/// `Element`: std::uint8_t for a grey pixel, std::uint32_t for 32 pixels of a binary image (bit i
/// of word w is pixel 32w + i, 1 is dark).
template <class Element>
class FrameChannel : public sc_core::sc_object, public virtual sc_core::sc_interface {
 public:
  /// Edges of `clk` behind its last pixel from which on a frame may be overwritten.
  static constexpr std::uint64_t drain_clocks = 8;

  /// `clk`: on each of its edges leaves a pixel, or as many as begin() says.
  FrameChannel(const char* name, vp::Clock& clk) : sc_object(name), clock_(clk) {}
  const char* kind() const override { return "pl::FrameChannel"; }

  /// Of the frame that began last: valid until the next one begins. Throws vp::ProtocolError if an
  /// enable came before any frame.
  const Element* data() const {
    if (data_ == nullptr) {
      throw vp::ProtocolError(
          std::string(name()) +
          ": pixels are enabled, but no frame was offered: call begin() before");
    }
    return data_;
  }
  /// Its elements; 0 before the first frame.
  std::uint32_t size() const { return size_; }
  /// The edge on which the pixel of this raster index leaves.
  std::uint64_t leaves_at(std::uint32_t pixel) const {
    return first_cycle_ + pixel / pixels_per_clock_;
  }
  vp::Clock& clock() const { return clock_; }
  void add_listener(FrameListener& listener) { listeners_.push_back(&listener); }

  // For a source that can also send single elements: set once every receiver takes frames.
  void take_whole() { taken_whole_ = true; }
  bool taken_whole() const { return taken_whole_; }

  // For the IP that offers it.
  /// The frame before is about to be overwritten.
  void announce() {
    for (FrameListener* listener : listeners_) listener->frame_begins();
  }
  /// The first pixel leaves on edge `first_cycle`.
  void begin(const Element* data, std::uint32_t size, std::uint64_t first_cycle,
             std::uint32_t pixels_per_clock = 1) {
    data_ = data;
    size_ = size;
    first_cycle_ = first_cycle;
    pixels_per_clock_ = pixels_per_clock;
  }
  void change(std::uint32_t first, std::uint32_t count) {
    for (FrameListener* listener : listeners_) listener->pixels_changed(first, count);
  }
  void cut() {
    for (FrameListener* listener : listeners_) listener->frame_cut();
  }

 private:
  vp::Clock& clock_;
  const Element* data_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint64_t first_cycle_ = 0;
  std::uint32_t pixels_per_clock_ = 1;
  bool taken_whole_ = false;
  std::vector<FrameListener*> listeners_;
};

using GreyFrames = FrameChannel<std::uint8_t>;
using BinaryFrames = FrameChannel<std::uint32_t>;

/// The port of an IP that takes frames. It stays open where pixels come one by one.
template <class Channel>
class FrameIn : public sc_core::sc_port<Channel, 1, sc_core::SC_ZERO_OR_MORE_BOUND> {
 public:
  explicit FrameIn(const char* name)
      : sc_core::sc_port<Channel, 1, sc_core::SC_ZERO_OR_MORE_BOUND>(name) {}

  // From end_of_elaboration() on.
  bool open() const { return this->size() == 0; }
  /// Throws vp::InputError if the port is open.
  Channel& channel() {
    if (!open()) return *(*this)[0];
    throw vp::InputError(
        std::string("port '") + this->name() +
        "' is connected to nothing: its module takes whole frames; bind it to what "
        "offers them, or choose a model that takes pixels");
  }
};

/// An IP between sensor input and detectors: takes a frame, gives one of the same size some clocks
/// later. Pixel clock.
class PixelFilter : public vp::Clocked, public vp::Ip {
 public:
  vp::In<bool> rst{"rst", this};
  vp::In<bool> ena{"ena", this};  ///< the sensor's frame_ena
  // Pixel by pixel.
  vp::In<std::uint8_t> pixel{"pixel", this};
  vp::In<std::uint16_t> x{"x", this};
  vp::In<std::uint16_t> y{"y", this};
  vp::Signal<bool> frame_ena{"frame_ena"};
  vp::Signal<std::uint8_t> pixel_out{"pixel_out"};
  vp::Signal<std::uint16_t> pixel_x;
  vp::Signal<std::uint16_t> pixel_y;
  // Whole frames.
  FrameIn<GreyFrames> frames_in{"frames_in"};
  GreyFrames frames{"frames", clock()};

 protected:
  PixelFilter(sc_core::sc_module_name name, const Site& site)
      : Clocked(name, site.clk),
        Ip(&site.clk),
        pixel_x("pixel_x", site.geometry.words().x_bits()),
        pixel_y("pixel_y", site.geometry.words().y_bits()),
        geometry_(site.geometry) {
    wake_on(rst);
    wake_on(ena);
  }

  const Geometry geometry_;
};

}  // namespace pl

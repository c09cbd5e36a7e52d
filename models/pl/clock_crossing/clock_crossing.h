#pragma once

#include <cstdint>
#include <systemc>

#include <pl/common/fidelity.h>
#include <pl/common/frame_channel.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/signal.h>

namespace pl {

class IpPorts;

/// A word on its way from the pixel clock to the system clock: held in a register of the pixel
/// domain beside a toggle that the system side samples on each of its edges. No handshake: a word
/// that the next one overwrites before it was seen is lost, and counted.
class CrossingRegister : public sc_core::sc_module {
 public:
  explicit CrossingRegister(sc_core::sc_module_name name) : sc_module(name) {}

  vp::Signal<bool> toggle{"toggle"};
  vp::Signal<std::uint32_t> word{"word"};
  vp::Signal<std::uint32_t> second_word{
      "second_word"};  ///< a blob's end; unused by the other crossings

  /// The toggle as the system side sampled it last.
  void set_seen(const vp::Signal<bool>& seen) { seen_ = &seen; }
  /// Where edges of both clocks coincide, the system side has sampled already.
  bool seen() const { return seen_->written(); }
  /// Nothing is on its way.
  bool idle() const { return seen() == toggle.written(); }

  /// Puts a word in, on a pixel-clock edge. False: it replaced one that was not seen.
  bool send(std::uint32_t first, std::uint32_t second = 0) {
    const bool was_seen = idle();
    word = first;
    second_word = second;
    if (was_seen) toggle = !toggle.get();
    return was_seen;
  }
  void reset() { toggle = false; }

 private:
  const vp::Signal<bool>* seen_ = nullptr;
};

/// What the crossing offers the system side in place of the binary words: their frames, and a
/// counter for words that the receiver computes to be lost on the way.
class FrameCrossing : public virtual sc_core::sc_interface {
 public:
  /// Null if the words come one by one.
  virtual BinaryFrames* frames() = 0;
  virtual void add_lost(std::uint32_t words) = 0;
  /// The pixel side is in reset, and with it the count.
  virtual void forget_lost() = 0;
};

/// The pixel side of all three crossings: corner, blob and binary words, and the count of those
/// that were lost.
///
/// At coincident edges the system side samples first, so a word that is sampled and replaced at the
/// same edge was seen.
class ClockCrossing : public vp::Clocked, public vp::Ip, public FrameCrossing {
 public:
  static Models<ClockCrossing>& models();
  /// At coincident edges `system_clk` runs first.
  void cross_to(const vp::Clock& system_clk);

  vp::In<bool> rst{"rst", this};
  vp::In<bool> corner_out{"corner_out", this};
  vp::In<std::uint32_t> corner_data{"corner_data", this};
  vp::In<bool> blob_out{"blob_out", this};
  vp::In<std::uint32_t> blob_start{"blob_start", this};
  vp::In<std::uint32_t> blob_end{"blob_end", this};
  vp::In<bool> thresh_out{"thresh_out", this};
  vp::In<std::uint32_t> thresh_data{"thresh_data", this};
  FrameIn<BinaryFrames> thresh_frames{"thresh_frames"};  ///< in place of thresh_out and thresh_data

  CrossingRegister corner{"corner"};
  CrossingRegister blob{"blob"};
  CrossingRegister binary{"binary"};
  /// Words overwritten before the system side saw them, since the last reset.
  vp::Signal<std::uint32_t> crossing_overflow{"crossing_overflow"};

  BinaryFrames* frames() override {
    return word_by_word_ || thresh_frames.open() ? nullptr : thresh_frames[0];
  }
  void add_lost(std::uint32_t words) override {
    if (words != 0) crossing_overflow = crossing_overflow.written() + words;
  }
  void forget_lost() override { crossing_overflow = 0; }

 protected:
  ClockCrossing(sc_core::sc_module_name name, const Site& site);
  /// All pins but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;

  bool word_by_word_ = false;  ///< RTL counts what is lost
};

/// The clock crossing clock by clock.
class ClockCrossingClocked : public ClockCrossing {
 public:
  ClockCrossingClocked(sc_core::sc_module_name name, const Site& site)
      : ClockCrossing(name, site) {}

 private:
  void edge() override;
  void reset();
  void count(bool delivered) {
    if (!delivered) crossing_overflow = crossing_overflow.written() + 1;
  }
};

}  // namespace pl

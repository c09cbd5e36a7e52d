#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace pl {

/// Words on their way from one clock to another: the memory of a StreamCrossing.
class CrossingFifo {
 public:
  struct Word {
    std::uint32_t data = 0;
    bool last = false;
  };

  explicit CrossingFifo(std::uint32_t depth) : words_(depth) {}
  std::uint32_t depth() const { return static_cast<std::uint32_t>(words_.size()); }
  /// Where the word of this number stands; numbers count on from 0.
  Word& at(std::uint32_t number) { return words_[number % words_.size()]; }

 private:
  std::vector<Word> words_;
};

/// What crosses is sampled by two registers on the other side.
template <class T>
class TwoRegisters {
 public:
  /// One edge, with what stood before it.
  void sample(T value) {
    seen_ = first_;
    first_ = value;
  }
  T seen() const { return seen_; }
  /// Further edges with this value change nothing.
  bool rests_at(T value) const { return first_ == value && seen_ == value; }

 private:
  T first_{}, seen_{};
};

/// The side of a StreamCrossing that takes words.
///
/// A packet begins only when the one before has left the crossing and whoever takes it is ready, as
/// seen from here: TREADY says what it says without the crossing, some clocks later.
class CrossingEntry : public vp::Clocked {
 public:
  CrossingEntry(sc_core::sc_module_name name, vp::Clock& clk, CrossingFifo& fifo);

  vp::In<bool> rst{"rst", this};  ///< drops the words that are on their way
  vp::AxiStreamSlave s{"s", *this};
  // From the other side.
  vp::In<std::uint32_t> read_count{"read_count", this};
  vp::In<bool> taker_ready{"taker_ready", this};
  // For the other side.
  vp::Signal<std::uint32_t> write_count{"write_count"};
  vp::Signal<bool> flush{"flush"};

 private:
  void edge() override;

  CrossingFifo& fifo_;
  TwoRegisters<std::uint32_t> read_count_;
  TwoRegisters<bool> taker_ready_;
  bool in_packet_ = false;
};

/// The side that gives them.
class CrossingExit : public vp::Clocked {
 public:
  CrossingExit(sc_core::sc_module_name name, vp::Clock& clk, CrossingFifo& fifo);

  vp::AxiStreamMaster m{"m", *this};
  // From the other side.
  vp::In<std::uint32_t> write_count{"write_count", this};
  vp::In<bool> flush{"flush", this};
  // For the other side.
  vp::Signal<std::uint32_t> read_count{"read_count"};

 private:
  void edge() override;

  CrossingFifo& fifo_;
  TwoRegisters<std::uint32_t> write_count_;
  TwoRegisters<bool> flush_;
};

/// An AXI4-Stream from the pixel clock, which a gate may stop, to the clock of a DMA: a FIFO whose
/// counts cross in Gray code. One model for both fidelities. Throws vp::InputError for a depth that
/// is no power of two.
///
///   crossing.s()(link_from_the_pixels);  crossing.m()(link_to_the_dma);
class StreamCrossing : public sc_core::sc_module, public vp::Ip {
 public:
  StreamCrossing(sc_core::sc_module_name name, vp::Clock& pixel_clk, vp::Clock& clk);

  vp::In<bool>& rst() { return entry.rst; }
  vp::AxiStreamSlave& s() { return entry.s; }
  /// Binds the side of the taker.
  void m(vp::AxiStream& link);

  vp::Parameter<std::uint32_t> depth{
      "depth",
      16,
      vp::Unit::none,
      {8, 256},
      vp::Source::decision,
      "words that may be on their way: what comes until both sides have seen of each other"};

 private:
  CrossingFifo fifo_{depth};

 public:
  CrossingEntry entry;
  CrossingExit exit;

 private:
  vp::IpEstimate own_estimate() const override;
};

}  // namespace pl

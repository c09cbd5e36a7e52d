#pragma once

#include <cstdint>
#include <memory>
#include <systemc>
#include <vector>

#include <pl/common/fidelity.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace pl {

class IpPorts;

/// The side of a StreamCrossing that takes words.
///
/// A packet begins only when the previous one has left the crossing and the receiver is ready, as
/// seen from here: TREADY has the value that it has without the crossing, some clocks later.
class CrossingEntry : public vp::Clocked {
 public:
  vp::In<bool> rst{"rst", this};  ///< drops the words that are on their way
  vp::AxiStreamSlave s{"s", *this};
  vp::In<bool> taker_ready{"taker_ready", this};  ///< TREADY of the other side

 protected:
  CrossingEntry(sc_core::sc_module_name name, vp::Clock& clk);
};

/// The side that gives them.
class CrossingExit : public vp::Clocked {
 public:
  vp::AxiStreamMaster m{"m", *this};

 protected:
  CrossingExit(sc_core::sc_module_name name, vp::Clock& clk);
};

/// An AXI4-Stream from the pixel clock, which a gate may stop, to the clock of a DMA: a FIFO whose
/// counts cross in Gray code. One model for both fidelities, and RTL. Throws vp::InputError for a
/// depth that is no power of two.
///
///   crossing.entry().s(link_from_the_pixels);  crossing.m(link_to_the_dma);
class StreamCrossing : public sc_core::sc_module, public vp::Ip {
 public:
  static Models<StreamCrossing>& models();

  virtual CrossingEntry& entry() = 0;
  virtual CrossingExit& exit() = 0;
  /// Binds the side of the taker.
  void m(vp::AxiStream& link);

  vp::Parameter<std::uint32_t> depth{
      "depth",
      16,
      vp::Unit::none,
      {8, 256},
      vp::Source::decision,
      "words that may be on their way: what comes until both sides have seen of each other"};

 protected:
  /// Between `site.clk`, of the pixels, and `site.m_clk`.
  StreamCrossing(sc_core::sc_module_name name, const Site& site);
  /// All ports, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Words on their way from one clock to another: the memory of a StreamCrossing.
class CrossingFifo {
 public:
  struct Word {
    std::uint32_t data = 0;
    bool last = false;
  };

  explicit CrossingFifo(std::uint32_t depth) : words_(depth) {}
  std::uint32_t depth() const { return static_cast<std::uint32_t>(words_.size()); }
  /// The place of word `number`; words are numbered from 0.
  Word& at(std::uint32_t number) { return words_[number % words_.size()]; }

 private:
  std::vector<Word> words_;
};

/// What crosses is sampled by two registers on the other side.
template <class T>
class TwoRegisters {
 public:
  /// One edge, with the state before it.
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

/// The side that takes words, clock by clock.
class CrossingEntryClocked : public CrossingEntry {
 public:
  CrossingEntryClocked(sc_core::sc_module_name name, vp::Clock& clk, CrossingFifo& fifo);

  vp::In<std::uint32_t> read_count{"read_count", this};  ///< of the other side
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

/// The side that gives them, clock by clock.
class CrossingExitClocked : public CrossingExit {
 public:
  CrossingExitClocked(sc_core::sc_module_name name, vp::Clock& clk, CrossingFifo& fifo);

  // Of the other side.
  vp::In<std::uint32_t> write_count{"write_count", this};
  vp::In<bool> flush{"flush", this};
  vp::Signal<std::uint32_t> read_count{"read_count"};  ///< for the other side

 private:
  void edge() override;

  CrossingFifo& fifo_;
  TwoRegisters<std::uint32_t> write_count_;
  TwoRegisters<bool> flush_;
};

/// The stream crossing clock by clock.
class StreamCrossingClocked : public StreamCrossing {
 public:
  StreamCrossingClocked(sc_core::sc_module_name name, const Site& site);

  CrossingEntry& entry() override { return entry_; }
  CrossingExit& exit() override { return exit_; }

 private:
  CrossingFifo fifo_{depth};
  CrossingEntryClocked entry_;
  CrossingExitClocked exit_;
};

}  // namespace pl

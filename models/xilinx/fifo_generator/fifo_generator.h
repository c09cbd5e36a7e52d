#pragma once

#include <cstdint>
#include <memory>
#include <systemc>

#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/common/dual_clock_fifo.h>

namespace xilinx {

/// Build options of a FIFO with native ports, as Vivado asks for them.
struct FifoGeneratorBuild {
  std::uint32_t width = 8;     ///< bits of din and dout, 1 to 64
  std::uint32_t depth = 1024;  ///< words
  bool common_clock = true;
  bool first_word_fall_through = false;
  std::uint32_t synchroniser_stages = 2;  ///< of pointers between two clocks
};

/// FIFO generator v13.2 with native ports (PG057), equal widths. With one clock it holds `depth`
/// words, with two of them one less; a first word that falls through adds two (assumed). A word is
/// on the reading side a clock after the write (assumed), with two clocks by the pointers'
/// registers later. Its reset empties it, and is looked at on edges.
class FifoGenerator : public vp::Clocked, public vp::Ip {
 public:
  FifoGenerator(sc_core::sc_module_name name, vp::Clock& wr_clk, vp::Clock& rd_clk,
                const FifoGeneratorBuild& build);
  const char* kind() const override { return "xilinx::FifoGenerator"; }

  vp::Parameter<std::uint32_t> depth;

  // May be left open: no reset, no write, no read.
  vp::In<bool> reset{"reset", this}, wr_en{"wr_en", this};
  vp::In<std::uint64_t> din{"din", this};
  vp::Signal<bool> full{"full"}, almost_full{"almost_full"};
  vp::Signal<bool> wr_ack{"wr_ack"}, overflow{"overflow"};

  /// The reading side.
  class Reader : public vp::Clocked {
   public:
    Reader(sc_core::sc_module_name name, vp::Clock& clock, FifoGenerator& fifo, unsigned width);
    const char* kind() const override { return "xilinx::FifoGeneratorReader"; }

    vp::In<bool> rd_en{"rd_en", this};
    vp::Signal<std::uint64_t> dout;
    vp::Signal<bool> empty{"empty", 1, true}, almost_empty{"almost_empty", 1, true};
    vp::Signal<bool> valid{"valid"}, underflow{"underflow"};

   private:
    void edge() override;
    void before_end_of_elaboration() override;
    void end_of_elaboration() override {}  // pins may be left open
    FifoGenerator& owner_;
  };
  Reader& reader() { return *reader_; }

  vp::Counter writes{"writes", "words that it took"};
  vp::Counter lost{"lost", "words for which it had no room"};

 private:
  using Fifo = DualClockFifo<std::uint64_t>;

  void edge() override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // pins may be left open
  vp::IpEstimate own_estimate() const override;
  std::uint32_t capacity() const;
  bool in_reset() const { return reset.bound() && reset.read(); }

  const FifoGeneratorBuild build_;
  Fifo fifo_;
  std::unique_ptr<Reader> reader_;
};

}  // namespace xilinx

#pragma once

#include <vp/axi_stream.h>
#include <vp/clock.h>

#include <cstdint>
#include <vector>

namespace harness {

/// A slave at the end of a stream: notes every beat, and takes beats while told so.
class StreamSink : public vp::Clocked {
 public:
  struct Beat {
    std::uint64_t ps;
    std::uint32_t data;
    bool last;
  };

  StreamSink(sc_core::sc_module_name name, vp::Clock& clk);

  vp::AxiStreamSlave s{"s", *this};
  /// From now on: beats are taken, or the master waits.
  void accept(bool ready) { s.tready = ready; }

  std::vector<Beat> beats;

 private:
  void edge() override;
};

/// A master that sends words, one a clock as long as the slave takes them.
class StreamSource : public vp::Clocked {
 public:
  StreamSource(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {}

  vp::AxiStreamMaster m{"m", *this};
  /// Sends these words from now on; TLAST with each `packet`-th.
  void send(std::vector<std::uint32_t> words, std::uint32_t packet);
  std::size_t sent() const { return accepted_; }

 private:
  void edge() override;

  std::vector<std::uint32_t> words_;
  std::uint32_t packet_ = 32;
  std::size_t offered_ = 0, accepted_ = 0;
};

}  // namespace harness

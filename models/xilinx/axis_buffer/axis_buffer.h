#pragma once

#include <cstdint>
#include <deque>
#include <systemc>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace xilinx {

/// Build options of a stream's buffer.
struct AxisBufferBuild {
  std::uint32_t in_bytes = 4;   ///< of a beat that comes, 1 to 128
  std::uint32_t out_bytes = 4;  ///< of a beat that goes, 1 to 128
  std::uint32_t depth = 16;     ///< beats that it holds
  std::uint32_t latency = 1;    ///< clocks from a beat in to that beat on offer, at least 1
  /// Bits of TSTRB, TUSER, TID and TDEST that it takes along.
  std::uint32_t strobe = 0, user = 0, id = 0, dest = 0;
};

/// A part of an AXI4-Stream between two others of one clock: a FIFO (axis_data_fifo), a
/// register slice, or a width converter (PG085). Of different widths it joins and splits the bytes
/// that TKEEP marks, up to TLAST; of equal widths beats pass as they are, with their TSTRB, TUSER,
/// TID and TDEST. A beat a clock.
class AxisBuffer : public vp::Clocked, public vp::Ip {
 public:
  /// Throws vp::InputError for a width that is not 1 to 128 bytes, and for a converter that is to
  /// take more along than bytes.
  AxisBuffer(sc_core::sc_module_name name, vp::Clock& aclk, const AxisBufferBuild& build);
  const char* kind() const override { return "xilinx::AxisBuffer"; }

  vp::Parameter<std::uint32_t> depth;
  vp::Parameter<std::uint32_t> latency;

  vp::In<bool> aresetn{"aresetn"};  ///< may be left open
  vp::AxiStreamSlave s_axis{"s_axis", *this};
  vp::AxiStreamMaster m_axis{"m_axis", *this};

 private:
  struct Beat {
    vp::StreamBytes bytes;
    std::vector<std::uint32_t> sides;  ///< of aside_
    bool last = false;
    std::uint64_t ready = 0;  ///< edge from which it is on offer
  };

  void edge() override;
  void end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  vp::IpEstimate own_estimate() const override;
  void take(std::uint64_t cycle);
  void convert(const Beat& beat);
  void push(Beat beat, std::uint64_t ready);
  void offer(const Beat& beat);

  /// Wires that pass beside the bytes.
  struct Side {
    vp::Signal<std::uint32_t>*from, *to;
  };
  const std::uint32_t in_bytes_, out_bytes_;
  std::vector<Side> aside_;
  std::deque<Beat> beats_;  ///< the first is the one on offer, if one is
  Beat collected_;          ///< bytes that do not fill a beat yet,
  unsigned count_ = 0;      ///< so many
  bool offering_ = false;
};

}  // namespace xilinx

#pragma once

#include <cstdint>
#include <memory>
#include <systemc>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/common/dual_clock_fifo.h>

namespace xilinx {

/// Build options of a stream's FIFO with two clocks.
struct AxisClockFifoBuild {
  std::uint32_t bytes = 4;   ///< of a beat, 1 to 128
  std::uint32_t depth = 32;  ///< beats that it holds
  /// Bits of TSTRB, TUSER, TID and TDEST that it takes along.
  std::uint32_t strobe = 0, user = 0, id = 0, dest = 0;
};

/// A FIFO of an AXI4-Stream from one clock to another: axis_data_fifo with two clocks, and
/// axis_clock_converter (PG085). A beat a clock on either side.
class AxisClockFifo : public vp::Clocked, public vp::Ip {
 public:
  /// Throws vp::InputError for a width that is not 1 to 128 bytes.
  AxisClockFifo(sc_core::sc_module_name name, vp::Clock& s_axis_aclk, vp::Clock& m_axis_aclk,
                const AxisClockFifoBuild& build);
  const char* kind() const override { return "xilinx::AxisClockFifo"; }

  vp::Parameter<std::uint32_t> depth;
  vp::Parameter<std::uint32_t> pointer_latency;

  vp::In<bool> aresetn{"aresetn"};  ///< may be left open
  vp::AxiStreamSlave s_axis{"s_axis", *this};
  vp::AxiStreamMaster& m_axis() { return out_->m_axis; }

 private:
  struct Beat {
    vp::StreamBytes bytes;
    std::vector<std::uint32_t> sides;  ///< of sides_
    bool last = false;
  };
  using Fifo = DualClockFifo<Beat>;

  /// The other side.
  class Out : public vp::Clocked {
   public:
    Out(sc_core::sc_module_name name, vp::Clock& clock, AxisClockFifo& fifo);
    const char* kind() const override { return "xilinx::AxisClockFifoOut"; }
    vp::AxiStreamMaster m_axis{"m_axis", *this};

   private:
    void edge() override;
    AxisClockFifo& owner_;
  };

  void edge() override;
  void end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  vp::IpEstimate own_estimate() const override;
  bool in_reset() const { return aresetn.bound() && !aresetn; }

  /// Wires that pass beside the bytes.
  struct Side {
    vp::Signal<std::uint32_t>*from, *to;
  };
  const std::uint32_t bytes_;
  std::vector<Side> sides_;
  Fifo fifo_;
  std::unique_ptr<Out> out_;
  bool full_ = false;
};

}  // namespace xilinx

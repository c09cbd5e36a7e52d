#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/signal.h>
#include <xilinx/axis_subset_converter/stream_remap.h>

namespace xilinx {

/// One stream to several (axis_broadcaster, PG085): each beat goes out at all outputs, a beat a
/// clock. It takes a clock, and holds two beats for an output that waits (assumed).
class AxisBroadcaster : public vp::Clocked, public vp::Ip {
 public:
  /// An output has the lowest `out_bytes` of each beat, or the bytes that its remap says, as
  /// "tdata[15:8],tdata[7:0]"; "" for none. Throws vp::InputError for a remap that cannot be
  /// read or is not as wide as the output.
  AxisBroadcaster(sc_core::sc_module_name name, vp::Clock& aclk, std::uint32_t in_bytes,
                  std::uint32_t out_bytes, std::uint32_t user,
                  const std::vector<std::string>& remaps);
  const char* kind() const override { return "xilinx::AxisBroadcaster"; }

  vp::In<bool> aresetn{"aresetn", this};  ///< may be left open
  vp::AxiStreamSlave s_axis{"s_axis", *this};
  vp::AxiStreamMaster& m_axis(std::size_t number) { return outputs_.at(number).port; }

 private:
  struct Beat {
    vp::StreamBytes bytes;
    std::vector<std::uint32_t> users;
    bool last = false;
  };
  struct Output {
    Output(const char* name, vp::Clocked& owner) : port(name, owner) {}
    vp::AxiStreamMaster port;
    std::vector<RemapBit> bits;
    std::deque<Beat> beats;  ///< the first one is on offer
  };

  void edge() override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  Beat copy_for(const Output& output);

  const std::uint32_t in_bytes_, out_bytes_;
  std::deque<Output> outputs_;
};

/// Several streams to one (axis_combiner, PG085): a beat goes out when one has come at each input,
/// with their bytes side by side, the first input's lowest. TLAST and TUSER are those of one input.
/// It takes a clock (assumed).
class AxisCombiner : public vp::Clocked, public vp::Ip {
 public:
  /// `bytes` of each input; `leader` is the input whose TLAST and TUSER go out.
  AxisCombiner(sc_core::sc_module_name name, vp::Clock& aclk, std::uint32_t inputs,
               std::uint32_t bytes, std::uint32_t user, std::uint32_t leader);
  const char* kind() const override { return "xilinx::AxisCombiner"; }

  vp::In<bool> aresetn{"aresetn", this};  ///< may be left open
  vp::AxiStreamSlave& s_axis(std::size_t number) { return inputs_.at(number).port; }
  vp::AxiStreamMaster m_axis{"m_axis", *this};

 private:
  struct Beat {
    vp::StreamBytes bytes;
    std::vector<std::uint32_t> users;
    bool last = false;
  };
  struct Input {
    Input(const char* name, vp::Clocked& owner) : port(name, owner) {}
    vp::AxiStreamSlave port;
    std::deque<Beat> beats;  ///< two at most
  };

  void edge() override;
  void before_end_of_elaboration() override;
  void end_of_elaboration() override {}  // the reset may be left open
  vp::IpEstimate own_estimate() const override;
  bool all_have_one() const;
  void offer();

  const std::uint32_t bytes_, leader_;
  std::deque<Input> inputs_;
};

}  // namespace xilinx

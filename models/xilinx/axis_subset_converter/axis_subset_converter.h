#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <systemc>
#include <vector>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>
#include <xilinx/axis_subset_converter/stream_remap.h>

namespace xilinx {

/// One end of a subset converter: bits of each signal.
struct AxisSubsetEnd {
  std::uint32_t bytes = 4;  ///< of TDATA, 1 to 128
  std::uint32_t user = 0, id = 0, dest = 0;
};

/// Build options, as Vivado asks for them. An empty expression takes the lowest bits of the same
/// signal, and 0 above them.
struct AxisSubsetConverterBuild {
  AxisSubsetEnd in, out;
  std::string data, user, keep, last, id, dest;  ///< remap expressions
  std::uint32_t default_last = 0;  ///< TLAST with each so many beats; 0: as `last` says
};

/// AXI4-Stream subset converter v1.1 (PG085): a beat in is a beat out, with its bits elsewhere. It
/// takes a clock, where the vendor's has none unless it is asked for (assumed).
class AxisSubsetConverter : public vp::Clocked, public vp::Ip {
 public:
  /// Throws vp::InputError for an expression that cannot be read, that asks for bits that do not
  /// come, or that is not as wide as its signal.
  AxisSubsetConverter(sc_core::sc_module_name name, vp::Clock& aclk,
                      const AxisSubsetConverterBuild& build);
  const char* kind() const override { return "xilinx::AxisSubsetConverter"; }

  vp::Parameter<std::uint32_t> default_last;

  vp::In<bool> aresetn{"aresetn"};  ///< may be left open
  vp::AxiStreamSlave s_axis{"s_axis", *this};
  vp::AxiStreamMaster m_axis{"m_axis", *this};

 private:
  using Bits = std::vector<RemapBit>;
  struct Beat {
    vp::StreamBytes bytes;
    std::uint64_t user = 0, id = 0, dest = 0;
    bool last = false;
  };

  void edge() override;
  void end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  vp::IpEstimate own_estimate() const override;
  Bits bits_of(const std::string& expression, RemapBit::From same, unsigned width,
               const char* signal) const;
  unsigned width_in(RemapBit::From from) const;
  Beat convert();
  std::uint64_t side(vp::StreamField field);
  void show(vp::StreamField field, std::uint64_t value);
  bool value(const RemapBit& bit, const Beat& in) const;
  std::uint64_t word(const Bits& bits, const Beat& in) const;

  const AxisSubsetConverterBuild build_;
  Bits data_, user_, keep_, last_, id_, dest_;
  std::deque<Beat> beats_;  ///< two at most: a register slice
  std::uint32_t since_last_ = 0;
};

}  // namespace xilinx

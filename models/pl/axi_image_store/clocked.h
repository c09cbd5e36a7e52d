#pragma once

#include <cstdint>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/signal.h>
#include <xilinx/bram/bram.h>

namespace pl {

/// AXI Image Store, clocked (thesis 4.3.3, ports of table B.8): writes the image that arrives on
/// its stream into port A of the BRAM, from address 0 on after each rise of `ena`. System clock.
class AxiImageStoreClocked : public vp::Clocked, public vp::Ip {
 public:
  AxiImageStoreClocked(sc_core::sc_module_name name, vp::Clock& clk, xilinx::Bram& bram);

  vp::In<bool> ena{"ena", this};  ///< the control packet's wr_en
  vp::In<bool> rst{"rst", this};
  vp::AxiStreamSlave m{"m", *this};

  /// Brings memory and counters up to now.
  virtual void settle() {}

  /// Words stored since the last rise of `ena`.
  vp::Signal<std::uint32_t> address{"address", 17};

 protected:
  void edge() override;

  xilinx::Bram& bram_;

 private:
  vp::IpEstimate own_estimate() const override;

  bool ena_before_ = false;
};

}  // namespace pl

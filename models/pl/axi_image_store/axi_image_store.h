#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/signal.h>
#include <xilinx/bram/bram.h>

namespace pl {

class IpPorts;

/// AXI Image Store (thesis 4.3.3, ports of table B.8): writes the image that arrives on its stream
/// into port A of the BRAM, from address 0 on after each rise of `ena`. System clock.
class AxiImageStore : public vp::Clocked, public vp::Ip {
 public:
  static Models<AxiImageStore>& models();

  vp::In<bool> ena{"ena", this};  ///< the control packet's wr_en
  vp::In<bool> rst{"rst", this};
  vp::AxiStreamSlave m{"m", *this};
  sc_core::sc_port<xilinx::Bram> bram{"bram"};  ///< its port A

  /// Brings memory and counters up to now.
  virtual void settle() {}

  /// Words stored since the last rise of `ena`.
  vp::Signal<std::uint32_t> address;

 protected:
  AxiImageStore(sc_core::sc_module_name name, const Site& site);
  /// One clock edge, with the beat that passes on it.
  void store_beat();
  /// All pins but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;

  bool ena_before_ = false;
  std::uint32_t rtl_word_ = 0;  ///< that RTL shows the memory
};

}  // namespace pl

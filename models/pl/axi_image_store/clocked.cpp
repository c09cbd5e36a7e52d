#include <pl/axi_image_store/clocked.h>

#include <pl/common/estimate.h>

namespace pl {

AxiImageStoreClocked::AxiImageStoreClocked(sc_core::sc_module_name name, vp::Clock& clk,
                                           xilinx::Bram& bram)
    : Clocked(name, clk), Ip(&clk), bram_(bram) {
  wake_on(ena);
  wake_on(rst);
  wake_on(m.tvalid);
}

void AxiImageStoreClocked::edge() {
  const bool enabled = ena && !rst;
  if (m.sample()) {
    bram_.write_a(address, m.tdata);
    address = address + 1;
  }
  if (rst || (enabled && !ena_before_)) address = 0;
  ena_before_ = enabled;
  m.tready = enabled;
  if (!m.tvalid) sleep();
}

// An address counter. Works while an image is uploaded, which is not part of a frame.
vp::IpEstimate AxiImageStoreClocked::own_estimate() const {
  vp::IpEstimate e = small_ip("axi_image_store", 50, 60, 100 * mhz);
  e.active_clocks = [] { return std::uint64_t{0}; };
  return e;
}

}  // namespace pl

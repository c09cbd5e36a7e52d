#include <pl/axi_image_store/tlm.h>

namespace pl {

AxiImageStoreTlm::AxiImageStoreTlm(sc_core::sc_module_name name, vp::Clock& clk, xilinx::Bram& bram,
                                   FrameView& view)
    : AxiImageStoreClocked(name, clk, bram), view_(view) {
  m.set_sink(*this);
  view_.add_listener(*this);
}

// An edge in the middle of a burst: an input changed.
void AxiImageStoreTlm::edge() {
  m.settle(clock().cycle() - 1);
  AxiImageStoreClocked::edge();
}

bool AxiImageStoreTlm::takes_bursts() const {
  return m.tready.get() && ena && !rst && !view_.watched();
}

void AxiImageStoreTlm::take_burst(const std::uint32_t* words, std::uint32_t count) {
  bram_.write_a(address, words, count);
  address = address + count;
}

void AxiImageStoreTlm::settle() {
  m.settle(clock().cycle());
}

void AxiImageStoreTlm::frame_begins() {
  settle();
}

}  // namespace pl

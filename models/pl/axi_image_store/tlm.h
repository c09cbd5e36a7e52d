#pragma once

#include <cstdint>

#include <pl/axi_image_store/clocked.h>
#include <pl/sensor_input/frame_view.h>

namespace pl {

/// AXI Image Store at transaction level: takes whole bursts, but beat by beat while the sensor
/// plays a frame and when `ena` or `rst` changes in the middle of one.
class AxiImageStoreTlm : public AxiImageStoreClocked, private vp::BurstSink, private FrameListener {
 public:
  AxiImageStoreTlm(sc_core::sc_module_name name, vp::Clock& clk, xilinx::Bram& bram,
                   FrameView& view);

  void settle() override;

 private:
  void edge() override;
  bool takes_bursts() const override;
  void take_burst(const std::uint32_t* words, std::uint32_t count) override;
  void frame_begins() override;

  FrameView& view_;
};

}  // namespace pl

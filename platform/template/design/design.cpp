// A design of your own: the thesis' marker detector with a median filter behind the sensor, and a
// device that counts frames beside the GPIO.
#include <designs/marker/marker_design.h>
#include <designs/marker/words.h>
#include <zynq/design_plugin.h>

#include "frame_counter.h"
#include "median.h"

namespace {

platform::LogicBuild build() {
  platform::LogicBuild build;
  build.filter = &median_models();
  build.interrupts = 3;
  return build;
}

class Smooth : public platform::MarkerDesign {
 public:
  Smooth(sc_core::sc_module_name name, platform::PlPorts& ports)
      : MarkerDesign(name, ports, build()), counter_("frame_counter", ports.fclk_clk(0)) {
    axi_interconnect.map("frame_counter", frame_counter::base, 0x1'0000)
        .bind(counter_.s_axi.socket);
    counter_.frame_ena(sensor_input.frame_ena);
    concat.connect(2, counter_.irq);
  }

 private:
  FrameCounter counter_;
};

const platform::DesignInfo& info() {
  static const platform::DesignInfo smooth{
      "smooth",
      "the marker detector behind a 3x3 median filter, and a counter of frames",
      {"counting"},  // its PS program, counting.so beside this file
      true,
      platform::marker_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<Smooth>(name, ports);
      }};
  return smooth;
}

}  // namespace

MARKERVP_DESIGN(info)

// A design of your own: the thesis' marker detector with a median filter behind the sensor, and a
// device that counts frames beside the GPIO.
#include <chip/system/design_plugin.h>
#include <marker/designs/marker/marker_design.h>

#include "frame_counter.h"
#include "median.h"

namespace {

class Smooth : public platform::MarkerDesign {
 public:
  Smooth(sc_core::sc_module_name name, platform::PlPorts& ports)
      : MarkerDesign(name, ports, &median_models()), counter_("frame_counter", ports.fclk_clk(0)) {
    axi_interconnect.connect(counter_.s_axi, frame_counter::base);
    concat.connect_interrupt(counter_.irq, frame_counter::interrupt);
    counter_.frame_ena(sensor_input.frame_ena);
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

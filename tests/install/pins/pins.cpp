// Corner detection as Verilator's SystemC module, and a counter of pixels that knows nothing but
// SystemC: both at the pins of the thesis' design.
#include <systemc.h>

#include "Vcorner.h"

#include <chip/system/design_plugin.h>
#include <marker/designs/marker/marker_design.h>
#include <pl/corner_detection/corner_detection.h>
#include <vp/systemc_pins.h>

#include <iostream>
#include <memory>

namespace {

/// The ports of corner detection, with the Verilated module behind them.
class AtPins : public pl::CornerDetection {
 public:
  AtPins(sc_module_name name, const pl::Site& site) : CornerDetection(name, site) {
    rtl_.clk(clock().pin());
    rtl_.corner_out(corner_out_);
    rtl_.corner_data(corner_data_);
  }

 private:
  void edge() override { sleep(); }
  // Its own inputs are bound by now.
  void before_end_of_elaboration() override {
    rtl_.ena(*ena.signal());
    rtl_.rst(*rst.signal());
    pixel_ = std::make_unique<vp::View<uint32_t>>("pixel_view", *pixel.signal());
    x_ = std::make_unique<vp::View<uint32_t>>("x_view", *x.signal());
    y_ = std::make_unique<vp::View<uint32_t>>("y_view", *y.signal());
    rtl_.pixel(pixel_->signal);
    rtl_.x(x_->signal);
    rtl_.y(y_->signal);
  }

  sc_signal<bool> corner_out_{"corner_out_wire"};
  sc_signal<uint32_t> corner_data_{"corner_data_wire"};
  // The word precedes the signal that tells of it.
  vp::Driver<uint32_t, uint32_t> data_driver_{"data_driver", corner_data_, corner_data};
  vp::Driver<bool, bool> out_driver_{"out_driver", corner_out_, corner_out};
  Vcorner rtl_{"rtl"};
  std::unique_ptr<vp::View<uint32_t>> pixel_, x_, y_;
};

/// Counts the pixels of each frame: clocks with `ena`.
SC_MODULE(PixelCounter) {
  sc_in<bool> clk{"clk"};
  sc_in<bool> ena{"ena"};

  SC_CTOR(PixelCounter) {
    SC_METHOD(count);
    sensitive << clk.pos();
    dont_initialize();
  }
  void count() {
    if (ena.read()) {
      ++pixels;
    } else if (pixels != 0) {
      std::cout << "pixels counted: " << pixels << std::endl;
      pixels = 0;
    }
  }
  unsigned pixels = 0;
};

class Pins : public platform::MarkerDesign {
 public:
  Pins(sc_module_name name, platform::PlPorts& ports) : MarkerDesign(name, ports, {}) {
    counter_.clk(ports.fclk_clk(1).pin());
    counter_.ena(sensor_input.frame_ena);
  }

 private:
  PixelCounter counter_{"counter"};
};

const platform::DesignInfo& info() {
  static const platform::DesignInfo pins = [] {
    pl::CornerDetection::models().add(
        pl::model<pl::CornerDetection, AtPins>("pins", pl::by_pixel, pl::no_image));
    return platform::DesignInfo{
        "pins",
        "the marker detector with Verilated corner detection at SystemC's pins",
        {"hybrid"},
        true,
        platform::marker_words,
        [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
          return std::make_unique<Pins>(name, ports);
        }};
  }();
  return pins;
}

}  // namespace

MARKERVP_DESIGN(info)

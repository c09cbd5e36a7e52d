#include <pl/control_crossing/control_crossing.h>

#include <string>

#include <pl/common/estimate.h>
#include <vp/report.h>

namespace pl {

ControlCrossing::ControlCrossing(sc_core::sc_module_name name, vp::Clock& pixel_clk)
    : Clocked(name, pixel_clk), Ip(&pixel_clk) {}

void ControlCrossing::end_of_elaboration() {
  Clocked::end_of_elaboration();
  std::uint32_t id = 0;
  for (vp::In<bool>* level : {&ena_in, &rst_in, &por_in, &wr_thresh_in})
    level->signal()->attach(*this, id++);
  threshold_in.signal()->attach(*this, id);
}

void ControlCrossing::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id < unsampled_.size()) {
    if (unsampled_[id]) {
      vp::warn(*this, "/markervp/control_crossing/short_level",
               std::string(signal.name()) +
                   " changed twice between two edges of the pixel clock, so the logic does not see "
                   "it: hold it for longer");
    }
    unsampled_[id] = !unsampled_[id];
  }
  wake();
}

void ControlCrossing::edge() {
  ena = first_.ena;
  rst = first_.rst;
  por = first_.por;
  wr_thresh = first_.wr_thresh;
  threshold = first_.threshold;
  const Levels now = inputs();
  if (now == first_) sleep();
  first_ = now;
  unsampled_ = {};
}

vp::IpEstimate ControlCrossing::own_estimate() const {
  constexpr std::uint32_t wires = 12, registers = 2;
  vp::IpEstimate e = small_ip("control_crossing", 0, registers * wires, 464 * mhz);
  e.source = "derived from the model's registers";
  e.fmax_documentation =
      "registers behind registers; what a clock buffer of -1 lets through (2.155 ns)";
  return e;
}

}  // namespace pl

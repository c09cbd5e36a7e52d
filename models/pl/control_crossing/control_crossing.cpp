#include <pl/control_crossing/control_crossing.h>

#include <string>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/report.h>

namespace pl {

Models<ControlCrossing>& ControlCrossing::models() {
  static Models<ControlCrossing> models{
      "control_crossing",
      {model<ControlCrossing, ControlCrossingClocked>("clocked", no_image, no_image)},
      rtl_model<ControlCrossing, ControlCrossingClocked>()};
  return models;
}

ControlCrossing::ControlCrossing(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk), Ip(&site.clk) {}

void ControlCrossing::connect(IpPorts& ports) {
  for (vp::In<bool>* level : {&ena_in, &rst_in, &por_in, &wr_thresh_in}) ports.input(*level);
  ports.input(threshold_in);
  for (vp::Signal<bool>* level : {&ena, &rst, &por, &wr_thresh}) ports.output(*level);
  ports.output(threshold);
  ports.behind_edge = [this] { note_sampled(); };
}

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

void ControlCrossingClocked::edge() {
  ena = first_.ena;
  rst = first_.rst;
  por = first_.por;
  wr_thresh = first_.wr_thresh;
  threshold = first_.threshold;
  const Levels now = inputs();
  if (now == first_) sleep();
  first_ = now;
  note_sampled();
}

vp::IpEstimate ControlCrossing::own_estimate() const {
  vp::IpEstimate e = synthesised_ip("control_crossing");
  e.fmax_hz = e.fmax_high_hz = 464 * mhz;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation =
      "registers behind registers; what a clock buffer of -1 lets through (2.155 ns)";
  return e;
}

}  // namespace pl

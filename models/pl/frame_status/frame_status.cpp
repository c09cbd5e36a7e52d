#include <pl/frame_status/frame_status.h>

#include <pl/common/rtl_model.h>

namespace pl {

Models<FrameStatus>& FrameStatus::models() {
  static Models<FrameStatus> models{
      "frame_status",
      {model<FrameStatus, FrameStatusClocked>("clocked", no_image, no_image)},
      rtl_model<FrameStatus, FrameStatusClocked>()};
  return models;
}

void FrameStatus::connect(IpPorts& ports) {
  ports.input(rst);
  ports.input(frame_ena);
  ports.input(idle);
  ports.input(corner_out);
  ports.input(blob_out);
  ports.output(busy);
  ports.output(done);
  ports.combinational = true;
}

FrameStatus::FrameStatus(sc_core::sc_module_name name, const Site& site) : Clocked(name, site.clk) {
  wake_on(rst);
  wake_on(frame_ena);
  wake_on(idle);
  wake_on(corner_out);
  wake_on(blob_out);
}

void FrameStatusClocked::edge() {
  if (rst) {
    drain_ = drain_clocks;
    started_ = false;
    sleep();
  } else if (frame_ena) {
    drain_ = drain_clocks;
    started_ = true;
    sleep();  // until frame_ena falls
  } else if (started_ && drain_ != 0) {
    --drain_;
  } else {
    sleep();
  }
  combine();
}

// busy and done are logic behind registers: they follow their inputs within the clock.
void FrameStatusClocked::on_change(vp::SignalBase& signal, std::uint32_t id) {
  Clocked::on_change(signal, id);
  combine();
}

void FrameStatusClocked::combine() {
  const bool working = started_ && (drain_ != 0 || !idle || frame_ena);
  busy = working;
  done = started_ && !working && !corner_out && !blob_out;
}

}  // namespace pl

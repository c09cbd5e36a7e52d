#include <pl/frame_status/frame_status.h>

namespace pl {

FrameStatus::FrameStatus(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk) {
  wake_on(rst);
  wake_on(frame_ena);
  wake_on(idle);
  wake_on(corner_out);
  wake_on(blob_out);
}

void FrameStatus::edge() {
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
void FrameStatus::on_change(vp::SignalBase& signal, std::uint32_t id) {
  Clocked::on_change(signal, id);
  combine();
}

void FrameStatus::combine() {
  const bool working = started_ && (drain_ != 0 || !idle || frame_ena);
  busy = working;
  done = started_ && !working && !corner_out && !blob_out;
}

}  // namespace pl

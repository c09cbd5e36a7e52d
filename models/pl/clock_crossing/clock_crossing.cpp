#include <pl/clock_crossing/clock_crossing.h>

#include <pl/common/estimate.h>
#include <vp/clock_scheduler.h>

namespace pl {

ClockCrossing::ClockCrossing(sc_core::sc_module_name name, vp::Clock& pixel_clk,
                             const vp::Clock& system_clk)
    : Clocked(name, pixel_clk), Ip(&pixel_clk) {
  pixel_clk.scheduler().run_before(system_clk, pixel_clk);
  for (CrossingRegister* crossing : {&corner, &blob, &binary}) {
    crossing->toggle.set_writer(*this);
    crossing->word.set_writer(*this);
    crossing->second_word.set_writer(*this);
  }
  wake_on(rst);
  wake_on(corner_out);
  wake_on(blob_out);
  wake_on(thresh_out);
}

// A register and a toggle for corners, blobs (two words) and binary words, and the way back.
vp::IpEstimate ClockCrossing::own_estimate() const {
  return small_ip("clock_crossing", 40, 280, 100 * mhz);
}

void ClockCrossing::edge() {
  if (rst) {
    reset();
    return;
  }
  if (corner_out) count(corner.send(corner_data));
  if (blob_out) count(blob.send(blob_start, blob_end));
  if (thresh_out) count(binary.send(thresh_data));
  if (!corner_out && !blob_out && !thresh_out) sleep();
}

void ClockCrossing::reset() {
  corner.reset();
  blob.reset();
  binary.reset();
  crossing_overflow = 0;
  sleep();
}

}  // namespace pl

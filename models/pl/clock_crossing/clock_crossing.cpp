#include <pl/clock_crossing/clock_crossing.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>
#include <vp/clock_scheduler.h>

namespace pl {

Models<ClockCrossing>& ClockCrossing::models() {
  static Models<ClockCrossing> models{
      "clock_crossing",
      {model<ClockCrossing, ClockCrossingClocked>("clocked", no_image, no_image)},
      rtl_model<ClockCrossing, ClockCrossingClocked>()};
  return models;
}

void ClockCrossing::connect(IpPorts& ports) {
  word_by_word_ = true;
  ports.input(rst);
  ports.input(corner_out);
  ports.input(corner_data);
  ports.input(blob_out);
  ports.input(blob_start);
  ports.input(blob_end);
  ports.input(thresh_out);
  ports.input(thresh_data);
  ports.input("corner_seen", 1, [this] { return corner.seen(); });
  ports.input("blob_seen", 1, [this] { return blob.seen(); });
  ports.input("binary_seen", 1, [this] { return binary.seen(); });
  ports.output("corner_toggle", corner.toggle);
  ports.output("corner_word", corner.word);
  ports.means_nothing_until_written();
  ports.output("blob_toggle", blob.toggle);
  ports.output("blob_word", blob.word);
  ports.means_nothing_until_written();
  ports.output("blob_second_word", blob.second_word);
  ports.means_nothing_until_written();
  ports.output("binary_toggle", binary.toggle);
  ports.output("binary_word", binary.word);
  ports.means_nothing_until_written();
  ports.report(crossing_overflow);
  ports.others_stand_still = [this] { return corner.idle() && blob.idle() && binary.idle(); };
}

void ClockCrossing::cross_to(const vp::Clock& system_clk) {
  clock().scheduler().run_before(system_clk, clock());
}

ClockCrossing::ClockCrossing(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk), Ip(&site.clk) {
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
  return rtl_ip("clock_crossing");
}

void ClockCrossingClocked::edge() {
  if (rst) {
    reset();
    return;
  }
  if (corner_out) count(corner.send(corner_data));
  if (blob_out) count(blob.send(blob_start, blob_end));
  if (thresh_out) count(binary.send(thresh_data));
  if (!corner_out && !blob_out && !thresh_out) sleep();
}

void ClockCrossingClocked::reset() {
  corner.reset();
  blob.reset();
  binary.reset();
  crossing_overflow = 0;
  sleep();
}

}  // namespace pl

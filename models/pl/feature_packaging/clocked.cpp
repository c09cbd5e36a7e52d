#include <pl/feature_packaging/clocked.h>

#include <marker_logic.h>
#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

Models<FeaturePackaging>& FeaturePackaging::models() {
  static Models<FeaturePackaging> models{
      "feature_packaging",
      {model<FeaturePackaging, FeaturePackagingClocked>("clocked", no_image, no_image)},
      rtl_model<FeaturePackaging, FeaturePackagingClocked>()};
  return models;
}

void FeaturePackaging::connect(IpPorts& ports) {
  ports.input(ena);
  ports.input(rst);
  ports.input(ready, 2);
  ports.input(corner_in);
  ports.input(corner_data);
  ports.input(blob_in);
  ports.input(blob_start);
  ports.input(blob_end);
  ports.input(done);
  ports.output(feature);
  ports.output(corner_seen);
  ports.output(blob_seen);
  ports.report(corner_count);
  ports.report(blob_count);
  ports.report(feature_overflow);
  ports.parameter("BUFFER_DEPTH", buffer_depth.name(), buffer_depth);
}

FeaturePackagingClocked::FeaturePackagingClocked(sc_core::sc_module_name name, const Site& site)
    : FeaturePackaging(name, site), corners_(buffer_depth), blobs_(buffer_depth) {}

FeaturePackaging::FeaturePackaging(sc_core::sc_module_name name, const Site& site)
    : Clocked(name, site.clk), Ip(&site.clk) {
  wake_on(ena);
  wake_on(rst);
  wake_on(ready);
  wake_on(corner_in);
  wake_on(blob_in);
  wake_on(done);
}

// Two buffers, and what builds and chooses words.
vp::IpEstimate FeaturePackaging::own_estimate() const {
  vp::IpEstimate e = rtl_ip("feature_packaging", {{"BUFFER_DEPTH", buffer_depth}});
  if (buffer_depth > deepest_in_lut)  // corners, and pairs of words for blobs
    e.bram36 = xilinx::block_ram_36(buffer_depth, 32) + xilinx::block_ram_36(buffer_depth / 2, 64);
  return e;
}

void FeaturePackagingClocked::edge() {
  if (rst) {
    reset();
    return;
  }
  if (!ena) {
    sleep();
    return;
  }
  // What the buffers held before this clock decides what is shown; words that arrive now are shown
  // later.
  const std::uint32_t corners = corners_.count(), blobs = blobs_.count();
  const bool corner_arrived = corner_in != corner_seen, blob_arrived = blob_in != blob_seen;
  store(corner_arrived, blob_arrived);
  const bool asked = ready != ready_before_;
  ready_before_ = ready;
  if (want_) show_next(corners, blobs, !corner_arrived && !blob_arrived);
  if (asked) want_ = true;
  if (!done) ended_ = false;
  corner_count = static_cast<std::uint16_t>(corners_.count());
  blob_count = static_cast<std::uint16_t>(blobs_.count());
  const bool end_due = done && !ended_;
  const bool nothing_to_show = !want_ || (corners_.count() + blobs_.count() == 0 && !end_due);
  if (!corner_arrived && !blob_arrived && !asked && nothing_to_show) sleep();
}

void FeaturePackagingClocked::store(bool corner_arrived, bool blob_arrived) {
  if (corner_arrived) {
    corner_seen = corner_in;
    if (corners_.has_room(1)) {
      corners_.push(corner_data);
    } else {
      feature_overflow = feature_overflow.written() + 1;
    }
  }
  if (blob_arrived) {
    blob_seen = blob_in;
    if (blobs_.has_room(2)) {
      blobs_.push(blob_start);
      blobs_.push(blob_end);
    } else {
      feature_overflow = feature_overflow.written() + 1;
    }
  }
}

void FeaturePackagingClocked::show_next(std::uint32_t corners, std::uint32_t blobs, bool quiet) {
  if (corners != 0) {
    feature = corners_.pop();
  } else if (blobs != 0) {
    feature = blobs_.pop();
  } else if (done && !ended_ && quiet) {
    feature = marker_logic::WordFormat::end_of_frame;
    ended_ = true;
  } else {
    return;
  }
  want_ = false;
}

void FeaturePackagingClocked::reset() {
  corners_.clear();
  blobs_.clear();
  corner_seen = false;
  blob_seen = false;
  ready_before_ = 0;
  want_ = true;
  ended_ = false;
  feature = 0;
  corner_count = 0;
  blob_count = 0;
  feature_overflow = 0;
  sleep();
}

}  // namespace pl

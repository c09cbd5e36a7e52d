#include <pl/otsu_threshold/otsu_threshold.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

Models<GlobalThreshold>& OtsuThreshold::models() {
  static Models<GlobalThreshold> models{
      "otsu_threshold",
      {model<GlobalThreshold, OtsuThresholdClocked>("clocked", by_pixel, by_pixel),
       model<GlobalThreshold, OtsuThresholdTlm>("tlm", by_frame, by_frame)},
      rtl_model<GlobalThreshold, OtsuThresholdClocked, RtlModel<OtsuThreshold>>()};
  return models;
}

void OtsuThresholdClocked::end_frame(std::uint64_t cycle) {
  Histogram histogram;
  for (std::size_t level = 0; level < histogram.size(); ++level)
    histogram[level] = core_.histogram(static_cast<std::uint8_t>(level));
  search_.start(cycle + otsu_search_clocks, find_otsu_threshold(histogram));
  core_.clear_histogram();
}

void OtsuThresholdTlm::end_frame(std::uint64_t cycle) {
  search_.start(cycle + otsu_search_clocks, find_otsu_threshold(frame_.histogram()));
}

namespace {

vp::IpEstimate estimate_otsu(const Geometry& geometry) {
  return synthesised_ip("otsu_threshold", {{"PIXELS_PER_CLOCK", geometry.pixels_per_clock}});
}

}  // namespace

vp::IpEstimate OtsuThreshold::own_estimate() const {
  return estimate_otsu(geometry_);
}

vp::IpEstimate OtsuThresholdClocked::own_estimate() const {
  return estimate_otsu(geometry_);
}

vp::IpEstimate OtsuThresholdTlm::own_estimate() const {
  return estimate_otsu(geometry_);
}

}  // namespace pl

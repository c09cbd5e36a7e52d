#include <pl/otsu_threshold/otsu_threshold.h>

#include <pl/common/estimate.h>
#include <pl/common/rtl_model.h>

namespace pl {

Models<GlobalThreshold>& OtsuThreshold::models() {
  static Models<GlobalThreshold> models{
      "otsu_threshold",
      {model<GlobalThreshold, OtsuThresholdClocked>("clocked", by_pixel, by_pixel),
       model<GlobalThreshold, OtsuThresholdTlm>("tlm", by_frame, by_frame)},
      rtl_model<GlobalThreshold, OtsuThresholdClocked, OtsuThreshold>()};
  return models;
}

void OtsuThresholdClocked::end_frame(std::uint64_t cycle) {
  pass_time(cycle);  // what became due while the frame ran
  Histogram histogram;
  for (std::size_t level = 0; level < histogram.size(); ++level)
    histogram[level] = core_.histogram(static_cast<std::uint8_t>(level));
  search_.start(cycle, histogram);
  core_.clear_histogram();
}

std::uint64_t OtsuThresholdClocked::pass_time(std::uint64_t cycle) {
  if (const auto found = search_.take(cycle)) core_.set_threshold(*found);
  return search_.due();
}

void OtsuThresholdTlm::end_frame(std::uint64_t cycle) {
  pass_time(cycle);  // what became due while the frame ran
  search_.start(cycle, frame_.histogram());
}

std::uint64_t OtsuThresholdTlm::pass_time(std::uint64_t cycle) {
  if (const auto found = search_.take(cycle)) frame_.set_threshold(*found);
  return search_.due();
}

namespace {

// Each pixel of a clock has histograms of its own, one to count and one to search, each in a memory
// of 18 kbit; the search adds them up.
vp::IpEstimate estimate_otsu(const Geometry& geometry) {
  const std::uint32_t more = geometry.pixels_per_clock - 1;
  if (more == 0) return synthesised_ip("otsu_threshold");
  vp::IpEstimate e = grouped_ip("otsu_threshold", 850 + 170 * more, 846 + 150 * more, 100 * mhz,
                                "the histograms' sum has a register of its own");
  e.bram36 = 2.0 + 1.0 * more;
  e.dsp = 7;
  return e;
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

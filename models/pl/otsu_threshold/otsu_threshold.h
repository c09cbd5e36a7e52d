#pragma once

#include <pl/global_threshold/global_threshold.h>
#include <pl/otsu_threshold/core.h>

namespace pl {

/// Otsu Threshold: in the place of Global Threshold, with its ports. A frame is made binary with
/// the threshold that Otsu's method gives for the one before, the first with 127.
///
/// The threshold is loaded otsu_search_clocks behind the frame, or on the edge behind the next one
/// if that began sooner. One that ends sooner starts a new search, and the old one has no result.
class OtsuThreshold : public GlobalThreshold {
 public:
  static Models<GlobalThreshold>& models();

 protected:
  OtsuThreshold(sc_core::sc_module_name name, const Site& site) : GlobalThreshold(name, site) {}

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Otsu Threshold clock by clock.
class OtsuThresholdClocked : public GlobalThresholdClocked {
 public:
  static Models<GlobalThreshold>& models() { return OtsuThreshold::models(); }
  OtsuThresholdClocked(sc_core::sc_module_name name, const Site& site)
      : GlobalThresholdClocked(name, site) {}

 private:
  void end_frame(std::uint64_t cycle) override;
  vp::IpEstimate own_estimate() const override;
};

/// Otsu Threshold at transaction level.
class OtsuThresholdTlm final : public GlobalThresholdTlm {
 public:
  OtsuThresholdTlm(sc_core::sc_module_name name, const Site& site)
      : GlobalThresholdTlm(name, site) {}

 private:
  void end_frame(std::uint64_t cycle) override;
  vp::IpEstimate own_estimate() const override;
};

}  // namespace pl

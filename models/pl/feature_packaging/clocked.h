#pragma once

#include <cstdint>

#include <pl/common/fidelity.h>
#include <pl/feature_packaging/core.h>
#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/probe.h>

namespace pl {

class IpPorts;

/// Feature Packaging (thesis 4.4.3, ports of table B.6, and `done`, decision). System
/// clock.
///
/// Corners and blobs wait in a buffer each; corners go first. Every change of `ready` lets the next
/// word onto `feature` two clocks later, if one waits; the first word comes by itself. A full
/// buffer drops the feature and counts it.
class FeaturePackaging : public vp::Clocked, public vp::Ip {
 public:
  static Models<FeaturePackaging>& models();

  vp::In<bool> ena{"ena", this};
  vp::In<bool> rst{"rst", this};
  vp::In<std::uint8_t> ready{"ready", this};
  vp::In<bool> corner_in{"corner_in", this};  ///< the crossing's toggle
  vp::In<std::uint32_t> corner_data{"corner_data", this};
  vp::In<bool> blob_in{"blob_in", this};  ///< the crossing's toggle
  vp::In<std::uint32_t> blob_start{"blob_start", this};
  vp::In<std::uint32_t> blob_end{"blob_end", this};
  vp::In<bool> done{"done", this};  ///< the frame is finished, nothing is busy
  vp::Signal<std::uint32_t> feature{"feature"};

  // No ports of the IP: for the crossings, traces and reports.
  vp::Signal<bool> corner_seen{"corner_seen"};
  vp::Signal<bool> blob_seen{"blob_seen"};
  vp::Signal<std::uint16_t> corner_count{"corner_count"};  ///< words in the corner buffer
  vp::Signal<std::uint16_t> blob_count{"blob_count"};      ///< words in the blob buffer
  vp::Signal<std::uint32_t> feature_overflow{"feature_overflow"};

  vp::Parameter<std::uint32_t> buffer_depth{
      "buffer_depth",        100,
      vp::Unit::none,        {2, 65536},
      vp::Source::published, "words in each of the two feature buffers (thesis 4.4.3)"};
  vp::Signal<std::uint32_t> depth{"depth", 17, buffer_depth};  ///< for traces: what is full

 protected:
  FeaturePackaging(sc_core::sc_module_name name, const Site& site);
  /// All pins but the clock, as RTL in its place has them.
  void connect(IpPorts& ports);

 private:
  vp::IpEstimate own_estimate() const override;
};

/// Feature Packaging clock by clock.
class FeaturePackagingClocked : public FeaturePackaging {
 public:
  FeaturePackagingClocked(sc_core::sc_module_name name, const Site& site);

 private:
  void edge() override;
  void reset();
  void store(bool corner_arrived, bool blob_arrived);
  void show_next(std::uint32_t corners, std::uint32_t blobs, bool quiet);

  FeatureBuffer corners_;
  FeatureBuffer blobs_;
  std::uint8_t ready_before_ = 0;
  bool want_ = true;
  bool ended_ = false;
  vp::Probe<bool> want_probe_{"want", want_};
  vp::Probe<bool> ended_probe_{"ended", ended_};
};

}  // namespace pl

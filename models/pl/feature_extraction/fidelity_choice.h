#pragma once

#include <systemc>

#include <pl/common/fidelity.h>
#include <vp/parameter.h>

namespace pl {

/// How each IP of the feature extraction is modelled. IP that are not named here work on events at
/// every fidelity.
///
/// A clocked IP needs its input clock by clock: what feeds it is clocked, too, unless configured
/// otherwise.
class FidelityChoice : public sc_core::sc_module {
 public:
  using Choice = vp::Parameter<Fidelity>;

  /// `otherwise`: for IP that are not configured. Throws vp::InputError for a choice that cannot
  /// work.
  FidelityChoice(sc_core::sc_module_name name, Fidelity otherwise);

  Choice axi_image_store;
  Choice axi_threshold_bridge;
  Choice blob_detection;
  Choice global_threshold;
  Choice corner_detection;
  Choice sensor_input;
};

}  // namespace pl

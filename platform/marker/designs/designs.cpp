#include <chip/block_design/own_ip.h>
#include <chip/system/designs.h>
#include <marker/designs/marker/marker_ip.h>
#include <marker/input/image_input.h>
#include <marker/report/marker_metrics.h>
#include <study/inputs.h>

namespace platform {

const DesignInfo& thesis_design();
const DesignInfo& ps_only_design();
const DesignInfo& improved_design();
const DesignInfo& hd_design();
const DesignInfo& eco_design();
const DesignInfo& careful_design();

namespace {

/// The designs of this application, the thesis' being the usual one, and their IP for those of
/// others; what they take and find.
const DesignRegistration registration{thesis_design, ps_only_design, improved_design,
                                      hd_design,     eco_design,     careful_design};
const block_design::IpRegistration ip(marker_ip());
const study::InputKindRegistration images(input::image_input);
const bool has_metrics = register_marker_metrics();

}  // namespace

}  // namespace platform

#include <chip/system/designs.h>

namespace platform {

const DesignInfo& thesis_design();
const DesignInfo& ps_only_design();
const DesignInfo& improved_design();
const DesignInfo& hd_design();
const DesignInfo& eco_design();

namespace {

/// The designs of this application; the thesis' is the usual one.
const DesignRegistration registration{thesis_design, ps_only_design, improved_design, hd_design,
                                      eco_design};

}  // namespace

}  // namespace platform

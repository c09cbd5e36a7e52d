#include <chip/system/designs.h>

#include "fir_design.h"

namespace {

const platform::DesignRegistration designs{fir_design, ramp_design};

}  // namespace

#include <chip/system/designs.h>

#include "mistaken_fir.h"

namespace {

const platform::DesignRegistration designs{fir_design, ramp_design};

}  // namespace

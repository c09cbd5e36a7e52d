#include <chip/system/design_plugin.h>

#include "fir_design.h"

MARKERVP_DESIGN(ramp_design)

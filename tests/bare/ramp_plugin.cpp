#include <chip/system/design_plugin.h>

#include "mistaken_fir.h"

MARKERVP_DESIGN(ramp_design)

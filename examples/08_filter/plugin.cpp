// What makes the shared object a design. It is apart from the design, which tests link, too.
#include <chip/system/design_plugin.h>

#include "fir_design.h"

MARKERVP_DESIGN(fir_design)

/* Of another design, as tools generate it: not built. */
#error "the devices are those of xparameters.h"

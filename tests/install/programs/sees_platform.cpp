// A program must not see the simulator: it could not go onto the chip.
#include <vp/clock.h>

#pragma once

#include "small_handoff.h"

namespace kit {

/// The thesis' block design (figure 4.2, tables 4.2 and 4.3) as Vivado hands it off, with the
/// feature extraction as the packaged IP `markervp:marker:feature_extraction`: the clocks, the
/// addresses and the interrupts of the design `thesis`.
HwhText thesis_handoff();

}  // namespace kit

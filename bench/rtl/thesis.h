#pragma once

#include <Vrtl_thesis.h>
#include <Vrtl_thesis___024root.h>

#include "rtl_pipeline.h"

namespace bench {

/// Corner detection as the thesis builds it: nine FAST units.
using ThesisRtl = RtlPipeline<Vrtl_thesis>;

}  // namespace bench

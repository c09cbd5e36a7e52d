#pragma once

#include <Vrtl_lean.h>
#include <Vrtl_lean___024root.h>

#include "rtl_pipeline.h"

namespace bench {

/// The same outputs from one FAST unit.
using LeanRtl = RtlPipeline<Vrtl_lean>;

}  // namespace bench

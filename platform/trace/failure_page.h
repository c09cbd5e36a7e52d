#pragma once

#include <trace/tools.h>

namespace platform::trace {

/// What to look at where a check failed first: its signals, the clock nearest to them, the buffers
/// and other signals of their scopes, from before what it waited for to some clocks behind.
SaveFile failure_page(const TraceFile& file, const CheckResult& result);

}  // namespace platform::trace

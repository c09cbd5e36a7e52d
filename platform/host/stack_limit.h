#pragma once

namespace platform::host {

/// Makes sure that this process and its threads have the stack that they need. Where the limit is
/// below (ulimit -s) and may be raised, it is, and this process becomes the same command anew,
/// since threads get what the limit was at its start. Call it first in main(). Throws vp::HostError
/// if the limit may not be raised.
void ensure_stack(char* const arguments[]);

}  // namespace platform::host

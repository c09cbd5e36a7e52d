#pragma once

namespace vp {

/// Calls of the platform's own code that reach Linux whatever code of a user's is under way
/// (vp/foreign/process_calls.cpp). For signal handlers, too.

/// syscall() of the C library. Sets errno.
long call_kernel(long number, long a = 0, long b = 0, long c = 0, long d = 0, long e = 0,
                 long f = 0);

/// Ends the process at once, without destructors and exit handlers.
[[noreturn]] void end_process(int code);

/// raise() of the C library.
void raise_again(int signal);

}  // namespace vp

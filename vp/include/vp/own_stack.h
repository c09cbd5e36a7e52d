#pragma once

#include <cstddef>

namespace vp {

/// Calls `code(context)` on the stack [first, first + size) instead of the caller's, and returns
/// when it does. Exceptions pass. The code may switch to other coroutines meanwhile (SystemC's
/// wait()), and may be left by siglongjmp().
///
/// Throws std::runtime_error if the host gives no context.
void run_on_stack(void* first, std::size_t size, void (*code)(void* context), void* context);

}  // namespace vp

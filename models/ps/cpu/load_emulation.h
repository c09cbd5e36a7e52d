#pragma once

#include <cstddef>
#include <cstdint>

namespace ps {

/// Executes the load that faulted at `address`, from `source` in place of its memory, so that the
/// program continues behind it. For the signal handler: `context` is a ucontext_t.
///
/// Knows the loads that compilers use for data: MOV of 4 or 8 bytes and MOVZX of 1 or 2, into a
/// general register of 4 or 8 bytes (x86-64). False, without any change: it is another instruction,
/// or reads more than `most` bytes.
bool emulate_load(void* context, std::uintptr_t address, const unsigned char* source,
                  std::size_t most);

}  // namespace ps

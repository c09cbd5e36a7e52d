#pragma once

#include <cstdint>

namespace shim {

/// The DDR: bus addresses [first, end).
void set_memory(std::uint64_t first, std::uint64_t end);

/// Some uio is open: an interrupt may end a wait.
bool may_be_interrupted();

}  // namespace shim

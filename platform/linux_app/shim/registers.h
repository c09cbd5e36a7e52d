#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

namespace shim {

/// mmap() of device registers: pages without access rights. Each access of the application faults,
/// is made by the platform, and the application goes on: the instruction is stepped over with the
/// word in the page, so that it does what it always does.
void* map_registers(void* address, std::size_t length, int protection, int flags,
                    std::uint32_t bus_address);
/// What the application may do with them. False: there are none.
bool protect_registers(void* address, std::size_t length, int protection);
/// They are registers no more.
void unmap_registers(void* address, std::size_t length);

}  // namespace shim

#pragma once

#include <cstdint>

namespace vp {

/// How a register answers software. Device-specific effects are the model's; this is what a bus
/// sees.
enum class Access : std::uint8_t {
  read_write,         ///< reads back what was written (within `writable`)
  read_only,          ///< writes are acknowledged and ignored
  write_only,         ///< reads return 0
  write_1_to_clear,   ///< a 1 clears the bit (within `writable`), a 0 keeps it
  write_1_to_toggle,  ///< a 1 inverts the bit (within `writable`), a 0 keeps it
};

/// One register of a device, declared once: the model, the software's header and the documentation
/// come from it.
struct RegisterInfo {
  const char* name;      ///< the datasheet's name
  std::uint32_t offset;  ///< bytes from the device's base address
  std::uint32_t reset;   ///< value after reset
  Access access;
  std::uint32_t writable;     ///< bits that a write can change
  const char* documentation;  ///< one line
};

}  // namespace vp

#pragma once

#include <cstddef>
#include <cstdint>

namespace vp {

/// How a register answers software. Device-specific effects are the model's; this is what a bus
/// sees.
enum class Access : std::uint8_t {
  read_write,         ///< reads back what was written (within `writable`)
  read_only,          ///< writes are acknowledged and ignored
  write_only,         ///< reads return 0
  write_1_to_clear,   ///< a 1 clears the bit (within `writable`), a 0 keeps it
  write_1_to_set,     ///< a 1 sets the bit (within `writable`), a 0 keeps it
  write_1_to_toggle,  ///< a 1 inverts the bit (within `writable`), a 0 keeps it
};

/// Some bits of a register that belong together: how they answer software may differ from the rest.
struct RegisterField {
  const char* name;    ///< the datasheet's name
  std::uint32_t mask;  ///< the bits
  Access access;
  const char* documentation;  ///< one line
};

/// The fields of a register, from the lowest bit on. None: the register is one field, or a bit for
/// each of something. Bits that no field has read 0.
struct RegisterFields {
  constexpr RegisterFields() = default;
  template <std::size_t N>
  constexpr RegisterFields(const RegisterField (&table)[N]) : first(table), count(N) {}
  constexpr const RegisterField* begin() const { return first; }
  constexpr const RegisterField* end() const { return first + count; }
  const RegisterField* first = nullptr;
  std::size_t count = 0;
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
  RegisterFields fields = {};
};

}  // namespace vp

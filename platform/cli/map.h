#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <report/hardware_map.h>

namespace platform::cli {

/// "31:24", "0", "15:12, 3"; as a mask if they are many ranges.
std::string bits_text(std::uint32_t mask);

/// The fields of the registers of one device, one after the other: a set of fields that several
/// registers have appears once.
class FieldsOnce {
 public:
  struct Found {
    const std::vector<report::HardwareMap::Field>& fields;  ///< to be shown
    std::string as;  ///< name of the register that showed the same; "" if none did
  };
  Found find(const report::HardwareMap::Register& r);

 private:
  std::map<const void*, std::string> shown_;
  std::vector<report::HardwareMap::Field> none_;
};

/// The map as a page: memory map, interrupts, clocks, and the registers of each kind of device
/// once, as their descriptions declare them.
std::string map_as_markdown(const report::HardwareMap& map);

}  // namespace platform::cli

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <report/hardware_map.h>

namespace platform {

/// Names of addresses, as `markervp map` prints them.
class DeviceNames {
 public:
  explicit DeviceNames(const report::HardwareMap& map) : devices_(map.devices) {}

  /// Null where no device is.
  const report::HardwareMap::Device* find(std::uint64_t address) const;
  /// Null if no device is called so.
  const report::HardwareMap::Device* find(const std::string& name) const;
  /// "axi_gpio_0.GPIO_DATA", "ddr+0x1000"; "" where nothing is.
  std::string text(std::uint64_t address) const;
  /// Of all devices, for messages.
  std::vector<std::string> names() const;

 private:
  std::vector<report::HardwareMap::Device> devices_;
};

}  // namespace platform

#include <zynq/device_names.h>

#include <vp/text.h>

namespace platform {

const report::HardwareMap::Device* DeviceNames::find(std::uint64_t address) const {
  for (const auto& device : devices_) {
    if (address >= device.base && address - device.base < device.size) return &device;
  }
  return nullptr;
}

const report::HardwareMap::Device* DeviceNames::find(const std::string& name) const {
  for (const auto& device : devices_) {
    if (device.name == name) return &device;
  }
  return nullptr;
}

std::string DeviceNames::text(std::uint64_t address) const {
  const report::HardwareMap::Device* device = find(address);
  if (!device) return {};
  const std::uint64_t offset = address - device->base;
  for (const auto& r : device->registers) {
    if (r.offset == offset) return device->name + "." + r.name;
  }
  return device->name + "+" + vp::hex(offset);
}

std::vector<std::string> DeviceNames::names() const {
  std::vector<std::string> names;
  for (const auto& device : devices_) names.push_back(device.name);
  return names;
}

}  // namespace platform

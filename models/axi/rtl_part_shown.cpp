#include <axi/rtl_part.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <type_traits>

#include <vp/ip.h>
#include <vp/probe.h>

// What maps, traces and reports show of RTL.
namespace axi {

std::string RtlPart::registers_file() const {
  if (!registers_.get().empty()) return registers_;
  for (const char* ending : {".registers.xml", ".registers.rdl", ".registers.h"}) {
    std::filesystem::path beside = rtl_->file();
    beside.replace_extension().concat(ending);
    std::error_code ignored;
    if (std::filesystem::exists(beside, ignored)) return beside.string();
  }
  return {};
}

void RtlPart::show_pins() {
  const RtlDescriptor& descriptor = rtl_->descriptor();
  const vp::HierarchyScope inside(*this);
  for (std::uint32_t i = 0; i < descriptor.port_count; ++i) {
    const RtlPort& port = descriptor.ports[i];
    const bool shown = std::any_of(outputs_.begin(), outputs_.end(),
                                   [&](const Output& output) { return output.name == port.name; });
    if (shown) continue;
    const auto* place = static_cast<const unsigned char*>(rtl_->pin(i));
    if (port.bits <= 64) {
      show_pin(port.name, place, port.bits);
      continue;
    }
    for (unsigned low = 0; low < port.bits; low += 32) {
      const unsigned bits = std::min(32u, port.bits - low);
      show_pin(
          std::string(port.name) + "_" + std::to_string(low + bits - 1) + "_" + std::to_string(low),
          place + low / 8, bits);
    }
  }
}

void RtlPart::show_pin(const std::string& name, const void* place, unsigned bits) {
  const auto add_probe = [&](const auto& value) {
    using T = std::decay_t<decltype(value)>;
    probes_.push_back(std::make_unique<vp::Probe<T>>(name.c_str(), value, bits));
  };
  if (bits <= 8) return add_probe(*static_cast<const std::uint8_t*>(place));
  if (bits <= 16) return add_probe(*static_cast<const std::uint16_t*>(place));
  if (bits <= 32) return add_probe(*static_cast<const std::uint32_t*>(place));
  add_probe(*static_cast<const std::uint64_t*>(place));
}

// Figures of synthesis are all that is known of it.
vp::IpEstimate RtlPart::own_estimate() const {
  vp::IpEstimate estimate;
  estimate.known = false;
  estimate.source = "not known of RTL '" + rtl_->file() + "'";
  return estimate;
}

}  // namespace axi

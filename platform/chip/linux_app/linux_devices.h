#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <chip/linux_app/protocol.h>
#include <chip/system/zynq.h>
#include <facts/result.h>
#include <host/guard.h>
#include <vp/parameter.h>

namespace platform {

/// What a Linux of this platform has for applications: a device tree, so to speak, and what its
/// calls cost.
class LinuxDevices final : public sc_core::sc_module {
 public:
  /// Throws vp::InputError if the buffers do not fit into the DMA memory.
  LinuxDevices(sc_core::sc_module_name name, Zynq& zynq);
  const char* kind() const override { return "platform::LinuxDevices"; }

  vp::Parameter<std::uint32_t> system_call;
  vp::Parameter<std::uint32_t> wake_up;
  vp::Parameter<std::uint32_t> udmabufs;
  vp::Parameter<std::uint64_t> udmabuf_size;

  /// An interrupt line of a device in the PL, as uio_pdrv_genirq makes a file of it.
  struct Uio {
    std::string name;  ///< "axi_gpio_0", of several lines "axi_dma_0_mm2s_introut"
    std::uint32_t interrupt;
    std::uint64_t base, size;  ///< of the device's registers
  };
  /// By address and interrupt: /dev/uio0 is the first.
  static std::vector<Uio> uios_of(const facts::HardwareMap& map);
  const std::vector<Uio>& uios() const { return uios_; }

 private:
  std::vector<Uio> uios_;
};

/// A folder with /dev and /sys/class as an application sees them. It outlives neither this object
/// nor this process.
class LinuxFolder {
 public:
  /// Throws vp::InputError if the host has no room for it.
  LinuxFolder();

  const std::string& path() const { return path_; }
  /// A file in it, "/dev/mem"; its folders are made.
  void write(const std::string& file, const std::string& text) const;
  void add(const LinuxDevices::Uio& uio, std::size_t number) const;

 private:
  std::optional<host::ScratchFolder> folder_;
  std::string path_;  ///< without links
};

}  // namespace platform

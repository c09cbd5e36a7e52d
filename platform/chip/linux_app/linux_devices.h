#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <chip/handoff/device_tree.h>
#include <chip/linux_app/protocol.h>
#include <chip/system/zynq.h>
#include <facts/result.h>
#include <host/guard.h>
#include <vp/parameter.h>

namespace platform {

/// What a Linux of this platform has for applications: its device tree, and what its calls cost.
class LinuxDevices final : public sc_core::sc_module {
 public:
  /// Throws vp::InputError if the buffers do not fit into the memory, or the list of UIO names a
  /// device that is not there.
  LinuxDevices(sc_core::sc_module_name name, Zynq& zynq);
  const char* kind() const override { return "platform::LinuxDevices"; }

  vp::Parameter<std::uint32_t> system_call;
  vp::Parameter<std::uint32_t> wake_up;
  vp::Parameter<std::uint32_t> udmabufs;
  vp::Parameter<std::uint64_t> udmabuf_size;
  vp::Parameter<std::uint64_t> udmabuf_address;
  vp::Parameter<std::string> uio;

  /// A node of the tree that uio_pdrv_genirq makes a file of.
  struct Uio {
    std::string name;    ///< of the file: `linux,uio-name`, else the node's without its address
    std::string device;  ///< label of the node: "axi_dma_0"
    std::string node;    ///< "dma@40400000"
    std::string line;    ///< whose interrupts it counts: "mm2s_introut"; "": none
    std::uint32_t interrupt = 0;
    std::uint64_t base = 0, size = 0;  ///< of the device's registers
  };
  /// /dev/uio0 and those that follow, as `list` names them, and enters them into the tree. Of an
  /// empty list all devices of the programmable logic by address, those with an interrupt first.
  /// Throws vp::InputError for a device that is not there.
  static std::vector<Uio> make_uios(device_tree::Node& tree, const std::string& list);
  const std::vector<Uio>& uios() const { return uios_; }
  const device_tree::Node& tree() const { return tree_; }

 private:
  void check_room(Zynq& zynq) const;
  void check_address(Zynq& zynq) const;

  device_tree::Node tree_;
  std::vector<Uio> uios_;
};

/// A folder with /dev, /sys/class and the device tree as an application sees them. It outlives
/// neither this object nor this process.
class LinuxFolder {
 public:
  /// Throws vp::InputError if the host has no room for it.
  LinuxFolder();

  const std::string& path() const { return path_; }
  /// A file in it, "/dev/mem"; its folders are made.
  void write(const std::string& file, const std::string& text) const;
  void add(const LinuxDevices::Uio& uio, std::size_t number) const;
  void add(const device_tree::Node& tree) const;

 private:
  std::optional<host::ScratchFolder> folder_;
  std::string path_;  ///< without links
};

}  // namespace platform

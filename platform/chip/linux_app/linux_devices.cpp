#include <chip/linux_app/linux_devices.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <chip/system/hardware_map.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform {

using namespace vp::literals;

namespace {

namespace fs = std::filesystem;

constexpr vp::Range<std::uint32_t> cycles_range{0, 10'000'000};
constexpr std::uint64_t page = 4096;

/// "pl.axi_dma_0" of "pl.axi_dma_0.s_axi_lite".
std::string parent_of(const std::string& path) {
  return path.substr(0, path.rfind('.'));
}

}  // namespace

std::vector<LinuxDevices::Uio> LinuxDevices::uios_of(const facts::HardwareMap& map) {
  std::vector<Uio> uios;
  for (const facts::HardwareMap::Device& device : map.devices) {
    if (device.way != "m_axi_gp0" || device.registers.empty()) continue;
    const std::size_t first = uios.size();
    for (const facts::HardwareMap::Interrupt& interrupt : map.interrupts) {
      if (parent_of(interrupt.source) != parent_of(device.path)) continue;
      const std::string line = interrupt.source.substr(interrupt.source.rfind('.') + 1);
      uios.push_back({device.name + "_" + line, interrupt.id, device.base, device.size});
    }
    if (uios.size() == first + 1) uios.back().name = device.name;
  }
  if (uios.size() > linux_app::most_uio) uios.resize(linux_app::most_uio);
  return uios;
}

LinuxDevices::LinuxDevices(sc_core::sc_module_name name, Zynq& zynq)
    : sc_module(name),
      system_call("system_call", 700, vp::Unit::cycles, cycles_range, vp::Source::assumed,
                  "a call of the kernel by the application: about 1 us"),
      wake_up("wake_up", 10'000, vp::Unit::cycles, cycles_range, vp::Source::assumed,
              "from what an application waits for to its next statement: about 15 us"),
      udmabufs("udmabufs", 1, vp::Unit::none, {0, 8}, vp::Source::decision,
               "buffers /dev/udmabuf0 …"),
      udmabuf_size("udmabuf_size", 1_MiB, vp::Unit::bytes, {4_KiB, 512_MiB}, vp::Source::decision,
                   "of each of them"),
      uios_(uios_of(hardware_map(zynq))) {
  const ps::DmaAllocator& memory = zynq.ps.ddr.dma_memory();
  const std::uint64_t room = memory.end() - memory.first() - memory.used();
  const std::uint64_t size = (udmabuf_size + page - 1) / page * page;
  if (size * (udmabufs + 1) <= room) return;
  throw vp::InputError(std::to_string(udmabufs) + " buffers of " + std::to_string(udmabuf_size) +
                       " B (" + udmabufs.name() + ", " + udmabuf_size.name() +
                       ") do not fit into the DMA memory of " + std::to_string(room) +
                       " B: choose smaller ones, or a lower ps.ddr.dma_base");
}

namespace {

[[noreturn]] void no_folder(const std::string& reason) {
  throw vp::InputError("--linux: no folder can be made for the application's /dev and /sys (" +
                       reason + "): let TMPDIR name one that takes files");
}

/// What the host has in a folder, but for its own devices of those kinds.
void link_entries(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(from, ignored)) {
    const std::string name = entry.path().filename().string();
    const auto begins = [&](const char* with) { return name.rfind(with, 0) == 0; };
    if (name == "mem" || begins("uio") || begins("udmabuf") || begins("u-dma-buf")) continue;
    fs::create_symlink(entry.path(), to / name, ignored);
  }
}

}  // namespace

LinuxFolder::LinuxFolder() {
  try {
    folder_.emplace("linux");
    path_ = fs::canonical(folder_->path()).string();
  } catch (const std::system_error& error) {
    no_folder(error.code().message());
  }
  link_entries("/dev", path_ + "/dev");
  link_entries("/sys/class", path_ + "/sys/class");
  // What older releases of the driver call it.
  const fs::path classes = fs::path(path_) / "sys/class";
  fs::create_directories(classes / "uio");
  fs::create_directories(classes / "u-dma-buf");
  fs::create_directory_symlink("u-dma-buf", classes / "udmabuf");
}

void LinuxFolder::write(const std::string& file, const std::string& text) const {
  const std::string path = path_ + file;
  std::error_code ignored;
  fs::create_directories(fs::path(path).parent_path(), ignored);
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw vp::OutputError(path, errno);
}

// Documentation/driver-api/uio-howto.rst of Linux.
void LinuxFolder::add(const LinuxDevices::Uio& uio, std::size_t number) const {
  const std::string file = "/uio" + std::to_string(number), of = "/sys/class/uio" + file;
  write("/dev" + file, "");
  write(of + "/name", uio.name + "\n");
  write(of + "/version", "devicetree\n");
  const auto hex = [](std::uint64_t value) { return vp::hex(static_cast<std::uint32_t>(value)); };
  write(of + "/maps/map0/name", uio.name + "\n");
  write(of + "/maps/map0/addr", hex(uio.base) + "\n");
  write(of + "/maps/map0/size", hex(uio.size) + "\n");
  write(of + "/maps/map0/offset", "0x0\n");
}

}  // namespace platform

#include <chip/linux_app/linux_devices.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
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

using device_tree::Node;
using device_tree::Property;
using Uio = LinuxDevices::Uio;

constexpr vp::Range<std::uint32_t> cycles_range{0, 10'000'000};
constexpr std::uint64_t page = 4096;
constexpr const char* uio_driver = "generic-uio";  ///< uio_pdrv_genirq.of_id of most projects

/// "dma" of "dma@40400000".
std::string without_address(const std::string& node) {
  return node.substr(0, node.find('@'));
}

std::vector<std::uint32_t> cells_of(const Node& node, const char* property) {
  std::vector<std::uint32_t> cells;
  const Property* const found = node.property(property);
  if (!found) return cells;
  for (const auto& group : found->groups) {
    for (const device_tree::Cell& cell : group) cells.push_back(cell.number);
  }
  return cells;
}

/// Lines that lead to the controller of the PS: name and number. Of those behind a controller in
/// the programmable logic no file counts interrupts here.
std::vector<std::pair<std::string, std::uint32_t>> lines_of(const Node& node) {
  constexpr std::uint32_t first_shared = 32, cells_of_gic = 3;
  std::vector<std::pair<std::string, std::uint32_t>> lines;
  const Property* const parent = node.property("interrupt-parent");
  if (!parent || parent->groups.front().front().label != "intc") return lines;
  const std::vector<std::uint32_t> cells = cells_of(node, "interrupts");
  const std::vector<std::string>& names = node.property("interrupt-names")->strings;
  for (std::size_t i = 0; i < names.size(); ++i)
    lines.emplace_back(names[i], cells.at(cells_of_gic * i + 1) + first_shared);
  return lines;
}

/// As uio_pdrv_genirq takes a node: of several interrupts the first.
Uio uio_of(const Node& node) {
  Uio uio{without_address(node.name), node.label, node.name, {}};
  const std::vector<std::uint32_t> place = cells_of(node, "reg");
  uio.base = place.at(0);
  uio.size = place.at(1);
  const auto lines = lines_of(node);
  if (lines.empty()) return uio;
  uio.line = lines.front().first;
  uio.interrupt = lines.front().second;
  return uio;
}

std::vector<Uio> usual_uios(const Node& bus) {
  std::vector<Uio> uios;
  for (const Node& node : bus.children) uios.push_back(uio_of(node));
  std::stable_partition(uios.begin(), uios.end(), [](const Uio& one) { return !one.line.empty(); });
  if (uios.size() > linux_app::most_uio) uios.resize(linux_app::most_uio);
  return uios;
}

/// "DEVICE", or "DEVICE.LINE" for another interrupt than its first.
Uio listed_uio(const std::string& text, const Node& bus, const std::string& parameter) {
  const std::size_t dot = text.find('.');
  const std::string device = text.substr(0, dot);
  std::vector<std::string> names;
  for (const Node& node : bus.children) {
    names.push_back(node.label);
    if (node.label != device) continue;
    Uio uio = uio_of(node);
    if (dot == std::string::npos) return uio;
    std::vector<std::string> lines;
    for (const auto& [line, interrupt] : lines_of(node)) {
      lines.push_back(line);
      uio.interrupt = line == text.substr(dot + 1) ? interrupt : uio.interrupt;
      if (line == text.substr(dot + 1)) uio.line = line;
    }
    if (uio.line == text.substr(dot + 1)) return uio;
    throw vp::ParameterError(parameter, parameter + ": '" + text + "': " + device +
                                            (lines.empty() ? " has no interrupt at the PS"
                                                           : " has " + vp::join(lines, ", ")));
  }
  const std::string nearest = vp::nearest_match(device, names);
  throw vp::ParameterError(parameter,
                           parameter + ": unknown device '" + device +
                               "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                               "there are " + vp::join(names, ", "));
}

/// The tree says of each which driver takes it.
void enter(Node& bus, const Uio& uio) {
  for (Node& node : bus.children) {
    if (node.label != uio.device) continue;
    std::vector<std::string>& drivers = node.properties.front().strings;
    if (drivers.back() != uio_driver) drivers.emplace_back(uio_driver);
    if (uio.name != without_address(node.name) && !node.property("linux,uio-name"))
      node.properties.push_back(device_tree::texts("linux,uio-name", {uio.name}));
  }
}

}  // namespace

std::vector<Uio> LinuxDevices::make_uios(Node& tree, const std::string& list) {
  const std::string parameter = "linux.uio";
  Node& bus = *tree.child("amba_pl");
  std::vector<Uio> uios;
  for (std::string text : vp::split(list, ',')) {
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    if (text.empty()) continue;
    const std::size_t equals = text.find('=');
    Uio uio =
        listed_uio(equals == std::string::npos ? text : text.substr(equals + 1), bus, parameter);
    if (equals != std::string::npos) uio.name = text.substr(0, equals);
    for (const Uio& other : uios) {
      if (!uio.line.empty() && other.interrupt == uio.interrupt)
        throw vp::ParameterError(parameter, parameter + ": interrupt " +
                                                std::to_string(uio.interrupt) +
                                                " is taken twice, and Linux gives it to one");
    }
    uios.push_back(std::move(uio));
  }
  if (uios.size() > linux_app::most_uio)
    throw vp::ParameterError(parameter, parameter + ": " + std::to_string(uios.size()) +
                                            " devices: at most " +
                                            std::to_string(linux_app::most_uio));
  if (uios.empty()) uios = usual_uios(bus);
  for (const Uio& uio : uios) enter(bus, uio);
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
      udmabuf_address("udmabuf_address", 0, vp::Unit::address, {0, 0x3FFF'F000},
                      vp::Source::decision,
                      "of the first of them, for a program that has it as a constant: reserved "
                      "memory of its device tree; 0: where memory is left"),
      uio("uio", "", vp::Source::decision,
          "/dev/uio0 and those that follow, as the board's device tree has them: "
          "'axi_dma_0, my-gpio=axi_gpio_0, axi_dma_1.s2mm_introut' (a name, a device, one of its "
          "interrupts); empty: each device of the programmable logic, those with an interrupt "
          "first"),
      tree_(hardware_tree(zynq)),
      uios_(make_uios(tree_, uio)) {
  if (udmabuf_address == 0) {
    check_room(zynq);
  } else {
    check_address(zynq);
  }
}

void LinuxDevices::check_room(Zynq& zynq) const {
  const ps::DmaAllocator& memory = zynq.ps.ddr.dma_memory();
  const std::uint64_t room = memory.end() - memory.first() - memory.used();
  const std::uint64_t size = (udmabuf_size + page - 1) / page * page;
  if (size * (udmabufs + 1) <= room) return;
  throw vp::InputError(std::to_string(udmabufs) + " buffers of " + std::to_string(udmabuf_size) +
                       " B (" + udmabufs.name() + ", " + udmabuf_size.name() +
                       ") do not fit into the DMA memory of " + std::to_string(room) +
                       " B: choose smaller ones, or a lower ps.ddr.dma_base");
}

void LinuxDevices::check_address(Zynq& zynq) const {
  const ps::DmaAllocator& memory = zynq.ps.ddr.dma_memory();
  const std::uint64_t first = udmabuf_address;
  const std::uint64_t end = first + (udmabuf_size + page - 1) / page * page * udmabufs;
  const auto refuse = [this](const std::string& problem) {
    throw vp::ParameterError(udmabuf_address.name(),
                             std::string(udmabuf_address.name()) + ": " + problem);
  };
  const auto hex = [](std::uint64_t address) {
    return vp::hex(static_cast<std::uint32_t>(address));
  };
  if (first % page != 0) refuse(hex(first) + " is no multiple of a page, 4096 bytes");
  if (first < ps::Ddr::base || end > zynq.ps.ddr.end())
    refuse("buffers up to " + hex(end - 1) + " leave the DDR, " + hex(ps::Ddr::base) + " to " +
           hex(zynq.ps.ddr.end() - 1));
  if (first < memory.first() + memory.used() && end > memory.first())
    refuse("memory up to " + hex(memory.first() + memory.used() - 1) +
           " is in use: take a higher address, or another ps.ddr.dma_base");
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
  fs::create_directories(fs::path(path_) / "proc");
  fs::create_directory_symlink("/sys/firmware/devicetree/base",
                               fs::path(path_) / "proc/device-tree");
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

// Documentation/driver-api/uio-howto.rst of Linux; forms as drivers/uio/uio.c writes them.
void LinuxFolder::add(const LinuxDevices::Uio& uio, std::size_t number) const {
  const std::string file = "/uio" + std::to_string(number), of = "/sys/class/uio" + file;
  write("/dev" + file, "");
  write(of + "/name", uio.name + "\n");
  write(of + "/version", "devicetree\n");
  const auto hex = [](std::uint64_t value) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "0x%08x\n", static_cast<unsigned>(value));
    return std::string(digits);
  };
  write(of + "/maps/map0/name", uio.node + "\n");
  write(of + "/maps/map0/addr", hex(uio.base / page * page));
  write(of + "/maps/map0/size", hex((uio.base % page + uio.size + page - 1) / page * page));
  char offset[16];
  std::snprintf(offset, sizeof offset, "0x%x\n", static_cast<unsigned>(uio.base % page));
  write(of + "/maps/map0/offset", offset);
  fs::create_directories(path_ + of + "/device");
  fs::create_directory_symlink("/sys/firmware/devicetree/base/amba_pl/" + uio.node,
                               path_ + of + "/device/of_node");
}

void LinuxFolder::add(const device_tree::Node& tree) const {
  for (const auto& [file, bytes] : device_tree::files(tree))
    write("/sys/firmware/devicetree/base" + file, bytes);
}

}  // namespace platform

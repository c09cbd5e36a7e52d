#include <chip/handoff/device_tree.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>

#include <vp/text.h>

namespace platform::device_tree {

Property flag(std::string name) {
  return {std::move(name)};
}
Property texts(std::string name, std::vector<std::string> strings) {
  return {std::move(name), std::move(strings)};
}
Property numbers(std::string name, const std::vector<std::uint32_t>& values) {
  Property property{std::move(name), {}, {{}}};
  for (const std::uint32_t value : values) property.groups.front().push_back({value});
  return property;
}
Property hex_numbers(std::string name, const std::vector<std::uint32_t>& values) {
  Property property = numbers(std::move(name), values);
  property.hexadecimal = true;
  return property;
}
Property reference(std::string name, std::string label) {
  return {std::move(name), {}, {{{0, std::move(label)}}}};
}
Property references(std::string name,
                    const std::vector<std::pair<std::string, std::uint32_t>>& cells) {
  Property property{std::move(name)};
  for (const auto& [label, cell] : cells) property.groups.push_back({{0, label}, {cell}});
  return property;
}

const Property* Node::property(const std::string& wanted) const {
  for (const Property& one : properties)
    if (one.name == wanted) return &one;
  return nullptr;
}

const Node* Node::child(const std::string& wanted) const {
  for (const Node& one : children)
    if (one.name == wanted) return &one;
  return nullptr;
}

Node* Node::child(const std::string& wanted) {
  return const_cast<Node*>(static_cast<const Node*>(this)->child(wanted));
}

namespace {

std::string hex(std::uint64_t value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "0x%llx", static_cast<unsigned long long>(value));
  return digits;
}

std::string quoted(const std::string& text) {
  std::string escaped = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped + '"';
}

std::string value_text(const Property& property) {
  std::vector<std::string> parts;
  for (const std::string& string : property.strings) parts.push_back(quoted(string));
  for (const std::vector<Cell>& group : property.groups) {
    std::vector<std::string> cells;
    cells.reserve(group.size());
    for (const Cell& cell : group) {
      cells.push_back(!cell.label.empty()    ? "&" + cell.label
                      : property.hexadecimal ? hex(cell.number)
                                             : std::to_string(cell.number));
    }
    parts.push_back("<" + vp::join(cells, " ") + ">");
  }
  return parts.empty() ? "" : " = " + vp::join(parts, ", ");
}

}  // namespace

std::string text(const Node& node, unsigned depth) {
  const std::string indent(depth, '\t');
  std::string text = indent + (node.label.empty() ? "" : node.label + ": ") + node.name + " {\n";
  for (const Property& property : node.properties)
    text += indent + "\t" + property.name + value_text(property) + ";\n";
  for (const Node& child : node.children) text += device_tree::text(child, depth + 1);
  return text + indent + "};\n";
}

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;
using Phandles = std::map<std::string, std::uint32_t>;

/// In the order in which they are referred to first, as dtc numbers them.
void number_references(const Node& node, Phandles& phandles) {
  for (const Property& property : node.properties) {
    for (const std::vector<Cell>& group : property.groups) {
      for (const Cell& cell : group)
        if (!cell.label.empty())
          phandles.emplace(cell.label, static_cast<std::uint32_t>(phandles.size() + 1));
    }
  }
  for (const Node& child : node.children) number_references(child, phandles);
}

std::string bytes_of(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  return bytes;
}

std::string bytes_of(const Property& property, const Phandles& phandles) {
  std::string bytes;
  for (const std::string& string : property.strings) bytes += string + '\0';
  for (const std::vector<Cell>& group : property.groups) {
    for (const Cell& cell : group)
      bytes += bytes_of(cell.label.empty() ? cell.number : phandles.at(cell.label));
  }
  return bytes;
}

void add_files(const Node& node, const std::string& folder, const Phandles& phandles,
               Files& files) {
  for (const Property& property : node.properties)
    files.emplace_back(folder + property.name, bytes_of(property, phandles));
  const auto phandle = phandles.find(node.label);
  if (!node.label.empty() && phandle != phandles.end())
    files.emplace_back(folder + "phandle", bytes_of(phandle->second));
  // The kernel adds it: without the address, of the root empty.
  const std::string name = folder == "/" ? "" : node.name.substr(0, node.name.find('@'));
  files.emplace_back(folder + "name", name + '\0');
  for (const Node& child : node.children)
    add_files(child, folder + child.name + "/", phandles, files);
}

}  // namespace

Files files(const Node& root) {
  Phandles phandles;
  number_references(root, phandles);
  Files files;
  add_files(root, "/", phandles, files);
  return files;
}

namespace {

constexpr std::uint32_t first_shared_interrupt = 32;  ///< of the controller's numbers
constexpr std::uint32_t level_high = 4;
constexpr std::uint32_t first_fclk = 15;  ///< FCLK_CLK0 among the outputs of clkc

/// The IP as a device tree calls its class, an older name that Linux knows as well, and what the
/// binding of its class asks for.
struct Class {
  const char* node;
  const char* older;
  std::vector<std::pair<const char*, std::uint32_t>> cells = {};
  std::vector<const char*> flags = {};
};

const Class* class_of(const PlDevice& device) {
  static const std::map<std::string, Class> classes{
      {"axi_dma", {"dma", "xlnx,axi-dma-1.00.a", {{"#dma-cells", 1}}}},
      {"axi_vdma", {"dma", "xlnx,axi-vdma-1.00.a", {{"#dma-cells", 1}}}},
      {"axi_cdma", {"dma", "xlnx,axi-cdma-1.00.a", {{"#dma-cells", 1}}}},
      {"axi_gpio", {"gpio", "xlnx,xps-gpio-1.00.a", {{"#gpio-cells", 2}}, {"gpio-controller"}}},
      {"axi_iic", {"i2c", "xlnx,xps-iic-2.00.a", {{"#address-cells", 1}, {"#size-cells", 0}}}},
      {"axi_intc",
       {"interrupt-controller",
        "xlnx,xps-intc-1.00.a",
        {{"#interrupt-cells", 2}},
        {"interrupt-controller"}}},
      {"axi_timer", {"timer", "xlnx,xps-timer-1.00.a"}},
      {"axi_quad_spi",
       {"axi_quad_spi", "xlnx,xps-spi-2.00.a", {{"#address-cells", 1}, {"#size-cells", 0}}}},
      {"axi_uartlite", {"serial", "xlnx,xps-uartlite-1.00.a"}},
      {"v_tc", {"v_tc", "xlnx,v-tc-6.1"}}};
  const auto found = device.is_vendors ? classes.find(device.ip) : classes.end();
  return found == classes.end() ? nullptr : &found->second;
}

std::string dashes(std::string text) {
  for (char& c : text)
    c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// "xlnx,sg-length-width" of an option, as the bindings have it; "" for those that the tree does
/// not have: addresses are what `reg` is for.
std::string property_of(const std::string& option) {
  if (option == "ADDR_WIDTH") return "xlnx,addrwidth";
  const bool is_address = option.find("ADDR") != std::string::npos;
  return is_address ? "" : "xlnx," + dashes(option);
}

/// Drivers take a scatter-gather engine for built if its property is there, whatever its value.
void add_options(Node& node, const PlDevice& device) {
  std::set<std::string> done;
  for (const auto& [option, value] : device.options) {
    const std::string name = property_of(option);
    const bool is_flag = option == "INCLUDE_SG";
    if (!name.empty() && (!is_flag || value != 0) && done.insert(name).second)
      node.properties.push_back(is_flag ? flag(name) : hex_numbers(name, {value}));
  }
}

std::uint32_t option_of(const PlDevice& device, const std::string& name, std::uint32_t otherwise) {
  for (const auto& [option, value] : device.options)
    if (option == name) return value;
  return otherwise;
}

void add_interrupts(Node& node, const PlDevice& device, const std::string& only = {}) {
  std::vector<std::uint32_t> cells;
  std::vector<std::string> pins;
  for (const Interrupt& interrupt : device.interrupts) {
    if (!only.empty() && interrupt.pin.rfind(only, 0) != 0) continue;
    cells.insert(cells.end(), interrupt.cells.begin(), interrupt.cells.end());
    pins.push_back(interrupt.pin);
  }
  if (cells.empty()) return;
  node.properties.push_back(reference("interrupt-parent", device.controller));
  node.properties.push_back(numbers("interrupts", cells));
  if (only.empty()) node.properties.push_back(texts("interrupt-names", pins));
}

/// Documentation/devicetree/bindings/dma/xilinx/xilinx_dma.txt of Linux.
void add_dma_channels(Node& node, const PlDevice& device) {
  constexpr std::uint32_t usual_width = 32;
  std::uint64_t address = device.base;
  for (const std::string way : {"mm2s", "s2mm"}) {
    const std::string capitals = way == "mm2s" ? "MM2S" : "S2MM";
    if (option_of(device, "INCLUDE_" + capitals, 1) != 0) {
      Node channel{"dma-channel@" + hex(address).substr(2)};
      channel.properties = {texts("compatible", {"xlnx,axi-dma-" + way + "-channel"}),
                            numbers("dma-channels", {1})};
      add_interrupts(channel, device, way);
      channel.properties.push_back(hex_numbers(
          "xlnx,datawidth", {option_of(device, "M_AXI_" + capitals + "_DATA_WIDTH", usual_width)}));
      node.children.push_back(std::move(channel));
    }
    constexpr std::uint64_t to_s2mm = 0x30;
    address += to_s2mm;
  }
}

}  // namespace

std::vector<std::uint32_t> shared_interrupt(std::uint32_t id) {
  constexpr std::uint32_t first_private = 16, of_both_cores = 3u << 8;
  if (id < first_shared_interrupt) return {1, id - first_private, of_both_cores | level_high};
  return {0, id - first_shared_interrupt, level_high};
}

std::uint32_t fclk_output(unsigned number) {
  return first_fclk + number;
}

std::string compatible(const std::string& ip, const std::string& version) {
  return "xlnx," + dashes(ip) + "-" + version;
}

Node pl_node(const PlDevice& device) {
  const Class* const known = class_of(device);
  Node node{(known ? known->node : device.ip) + ("@" + hex(device.base).substr(2)), device.label};
  std::vector<std::string> kinds{compatible(device.ip, device.version)};
  if (known) kinds.emplace_back(known->older);
  node.properties = {texts("compatible", kinds),
                     hex_numbers("reg", {static_cast<std::uint32_t>(device.base),
                                         static_cast<std::uint32_t>(device.size)})};
  add_interrupts(node, device);
  if (!device.clocks.empty()) {
    std::vector<std::pair<std::string, std::uint32_t>> clocks;
    std::vector<std::string> pins;
    for (const auto& [pin, output] : device.clocks) {
      clocks.emplace_back("clkc", output);
      pins.push_back(pin);
    }
    node.properties.push_back(references("clocks", clocks));
    node.properties.push_back(texts("clock-names", pins));
  }
  if (known) {
    for (const auto& [name, value] : known->cells)
      node.properties.push_back(numbers(name, {value}));
    for (const char* const name : known->flags) node.properties.push_back(flag(name));
  }
  add_options(node, device);
  if (known && device.ip == "axi_dma") add_dma_channels(node, device);
  return node;
}

Node pl_bus(const std::vector<PlDevice>& devices) {
  Node bus{"amba_pl", "amba_pl"};
  bus.properties = {numbers("#address-cells", {1}), numbers("#size-cells", {1}),
                    texts("compatible", {"simple-bus"}), flag("ranges")};
  for (const PlDevice& device : devices) bus.children.push_back(pl_node(device));
  return bus;
}

}  // namespace platform::device_tree

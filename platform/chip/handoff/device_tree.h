#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// A device tree as plain values, and how Linux names the devices of the programmable logic in it.
namespace platform::device_tree {

/// 32 bits of a property: a number, or a reference to the node of that label.
struct Cell {
  std::uint32_t number = 0;
  std::string label = {};
};

/// A property is a list of texts, groups of cells, or, without either, a flag.
struct Property {
  std::string name;
  std::vector<std::string> strings = {};
  std::vector<std::vector<Cell>> groups = {};
  bool hexadecimal = false;
};

Property flag(std::string name);
Property texts(std::string name, std::vector<std::string> strings);
Property numbers(std::string name, const std::vector<std::uint32_t>& values);
Property hex_numbers(std::string name, const std::vector<std::uint32_t>& values);
Property reference(std::string name, std::string label);
/// Of each clock its cells: <&clkc 15>, <&clkc 16>.
Property references(std::string name,
                    const std::vector<std::pair<std::string, std::uint32_t>>& cells);

struct Node {
  std::string name;  ///< with its address: "dma@40400000"
  std::string label = {};
  std::vector<Property> properties = {};
  std::vector<Node> children = {};

  /// Null: it has none of that name.
  const Property* property(const std::string& wanted) const;
  const Node* child(const std::string& wanted) const;
  Node* child(const std::string& wanted);
};

/// The node as dtc(1) reads it.
std::string text(const Node& node, unsigned depth = 0);

/// What Linux shows below /sys/firmware/devicetree/base: each property as a file, its cells with
/// the highest byte first. A node that is referred to has a `phandle`.
std::vector<std::pair<std::string, std::string>> files(const Node& root);

/// A line of a device to an interrupt controller.
struct Interrupt {
  std::string pin;                   ///< "mm2s_introut"
  std::vector<std::uint32_t> cells;  ///< as the binding of the controller has them
};

/// A device of the programmable logic.
struct PlDevice {
  std::string label;         ///< "axi_dma_0"
  std::string ip = {};       ///< "axi_dma"
  std::string version = {};  ///< "7.1"
  bool is_vendors = true;
  std::uint64_t base = 0, size = 0;
  std::string controller = {};  ///< label of the one that its lines lead to
  std::vector<Interrupt> interrupts = {};
  std::vector<std::pair<std::string, std::uint32_t>> clocks = {};   ///< pin, output of clkc
  std::vector<std::pair<std::string, std::uint32_t>> options = {};  ///< "IS_DUAL", 0
};

/// The cells of a shared interrupt of the PS, or of the PL's private ones (below 32), which
/// software knows as `id`: a level that is high.
std::vector<std::uint32_t> shared_interrupt(std::uint32_t id);
/// The output of clkc that is FCLK_CLK`number`.
std::uint32_t fclk_output(unsigned number);

/// What a device tree calls the kind of an IP: "xlnx,axi-dma-7.1".
std::string compatible(const std::string& ip, const std::string& version);
/// Its node, as the vendor's device tree generator writes it.
Node pl_node(const PlDevice& device);
/// The bus that holds these devices.
Node pl_bus(const std::vector<PlDevice>& devices);

}  // namespace platform::device_tree

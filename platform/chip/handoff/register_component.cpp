#include <chip/handoff/described_register.h>
#include <chip/handoff/xml.h>
#include <strings.h>
#include <vp/error.h>
#include <vp/text.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <utility>

// IP-XACT: <spirit:…> of IEEE 1685-2009, as Vivado writes it, and <ipxact:…> of 2014.
namespace platform::handoff {

namespace {

class ComponentReader {
 public:
  ComponentReader(const std::string& text, const std::string& origin)
      : xml_(text, origin),
        prefix_(text.find("<ipxact:component") != text.npos ? "ipxact:" : "spirit:") {}

  std::vector<RegisterMap> read() {
    const pugi::xml_node root = xml_.root(prefix_ + "component");
    std::vector<RegisterMap> maps;
    for (const pugi::xml_node& map : all(in(root, "memoryMaps"), "memoryMap")) {
      RegisterMap found{interface_of(root, text(map, "name")), {}};
      for (const pugi::xml_node& block : all(map, "addressBlock")) add_block(found, map, block);
      if (!found.registers.empty()) maps.push_back(std::move(found));
    }
    return maps;
  }

 private:
  pugi::xml_node in(const pugi::xml_node& node, const char* name) const {
    return node.child((prefix_ + name).c_str());
  }
  /// All of a name, which pugixml looks at as long as they are walked through.
  pugi::xml_object_range<pugi::xml_named_node_iterator> all(const pugi::xml_node& node,
                                                            const char* name) const {
    return node.children(names_.emplace(prefix_ + name).first->c_str());
  }
  std::string text(const pugi::xml_node& node, const char* name) const {
    return vp::visible(in(node, name).text().get());
  }
  std::uint64_t number(const pugi::xml_node& node, const char* name,
                       std::uint64_t otherwise) const {
    const pugi::xml_node child = in(node, name);
    if (!child) return otherwise;
    return register_number(std::string(vp::trim(child.text().get())), xml_.where(child));
  }
  std::uint64_t required(const pugi::xml_node& node, const char* name) const {
    if (!in(node, name)) xml_.fail(node, "no <" + prefix_ + name + "> in it");
    return number(node, name, 0);
  }

  /// Of the bus that leads to a memory map; else the map's own name.
  std::string interface_of(const pugi::xml_node& root, const std::string& map) const {
    for (const pugi::xml_node& bus : all(in(root, "busInterfaces"), "busInterface")) {
      const pugi::xml_node slave = in(bus, "slave");
      const std::string name = prefix_ + "memoryMapRef";
      const pugi::xml_node reference = slave.child(name.c_str());
      if (attribute(reference, name.c_str()) == map || attribute(reference, "memoryMapRef") == map)
        return text(bus, "name");
    }
    return map;
  }

  static std::string access_of(const std::string& access, const std::string& otherwise) {
    if (access.empty()) return otherwise;
    return access == "read-only" ? "ro" : access.rfind("write", 0) == 0 ? "wo" : "rw";
  }

  void add_block(RegisterMap& map, const pugi::xml_node& memory_map,
                 const pugi::xml_node& block) const {
    if (number(memory_map, "addressUnitBits", 8) != 8)
      xml_.fail(memory_map, "its address units have " + text(memory_map, "addressUnitBits") +
                                " bits: 8 are read");
    if (!in(block, "register") && !in(block, "registerFile")) return;
    add_registers(map, block, "", required(block, "baseAddress"),
                  access_of(text(block, "access"), "rw"));
  }

  /// Registers and files of them below a block or a file.
  void add_registers(RegisterMap& map, const pugi::xml_node& parent, const std::string& prefix,
                     std::uint64_t base, const std::string& access) const {
    for (const pugi::xml_node& node : all(parent, "register")) {
      if (is_memory(node)) {
        add_memory(map, node, prefix, base, access);
        continue;
      }
      const std::uint64_t bytes = (required(node, "size") + 7) / 8;
      for_each(node, bytes, [&](const std::string& index, std::uint64_t at) {
        add_one(map, node, prefix + text(node, "name") + index, base + at, access);
      });
    }
    for (const pugi::xml_node& node : all(parent, "registerFile")) {
      for_each(node, required(node, "range"), [&](const std::string& index, std::uint64_t at) {
        add_registers(map, node, prefix + text(node, "name") + index + "_", base + at,
                      access_of(text(node, "access"), access));
      });
    }
  }

  /// Vivado HLS calls a memory a register, Memory_<name>, whose size is in bytes.
  bool is_memory(const pugi::xml_node& node) const {
    constexpr std::uint64_t largest_register = 64;
    return text(node, "name").rfind(memory_prefix, 0) == 0 && !in(node, "field") &&
           required(node, "size") > largest_register;
  }

  void add_memory(RegisterMap& map, const pugi::xml_node& node, const std::string& prefix,
                  std::uint64_t base, const std::string& access) const {
    const std::uint64_t bytes = required(node, "size");
    if (bytes / 4 > most_registers)
      xml_.fail(node, "a memory of more than " + std::to_string(most_registers) + " words");
    const std::string name = prefix + text(node, "name").substr(std::strlen(memory_prefix));
    for (std::uint64_t at = 0; at < bytes; at += 4) {
      DescribedRegister word;
      word.name = name + "[" + std::to_string(at / 4) + "]";
      word.offset = base + required(node, "addressOffset") + at;
      word.access = access_of(text(node, "access"), access);
      add_register(map, std::move(word), xml_.where(node));
    }
  }

  /// Each element of an array, or the only one: its index "[3]" and its offset.
  template <class Visit>
  void for_each(const pugi::xml_node& node, std::uint64_t step, Visit visit) const {
    const std::uint64_t first = required(node, "addressOffset");
    const pugi::xml_node array = in(node, "array") ? in(node, "array") : node;
    std::uint64_t count = 1;
    for (const pugi::xml_node& dim : all(array, "dim")) {
      count *= register_number(std::string(vp::trim(dim.text().get())), xml_.where(dim));
      if (count > most_registers)
        xml_.fail(dim, "an array of more than " + std::to_string(most_registers));
    }
    const std::uint64_t stride = number(array, "stride", step);
    for (std::uint64_t i = 0; i < count; ++i)
      visit(in(array, "dim") ? "[" + std::to_string(i) + "]" : std::string(), first + i * stride);
  }

  void add_one(RegisterMap& map, const pugi::xml_node& node, const std::string& name,
               std::uint64_t offset, const std::string& block_access) const {
    DescribedRegister one;
    one.name = name;
    one.offset = offset;
    one.bits = static_cast<unsigned>(std::min<std::uint64_t>(required(node, "size"), 1024));
    one.access = access_of(text(node, "access"), block_access);
    one.documentation = vp::trim(text(node, "description"));
    one.reset = number(in(node, "reset"), "value", 0);
    for (const pugi::xml_node& field : all(node, "field")) add_field(one, field);
    add_register(map, std::move(one), xml_.where(node));
  }

  void add_field(DescribedRegister& one, const pugi::xml_node& node) const {
    DescribedRegister::Field field;
    field.name = text(node, "name");
    field.low = static_cast<unsigned>(std::min<std::uint64_t>(required(node, "bitOffset"), 1024));
    field.bits = static_cast<unsigned>(std::min<std::uint64_t>(required(node, "bitWidth"), 1024));
    // 2014 has access and resets of a field in elements of their own.
    const pugi::xml_node resets = in(in(node, "resets"), "reset");
    if (resets && field.low < 64) one.reset |= number(resets, "value", 0) << field.low;
    if (field.low < 64) field.reset = one.reset >> field.low;
    field.access = access_of(text(node, "access"), one.access);
    const std::string written = text(node, "modifiedWriteValue"), read = text(node, "readAction");
    if (written == "oneToClear") field.access = "w1c";
    if (written == "oneToSet") field.access = "w1s";
    if (written == "oneToToggle") field.access = "w1t";
    field.documentation = vp::trim(text(node, "description"));
    if (read == "clear" || read == "set")
      field.documentation += (field.documentation.empty() ? "" : "; ") + std::string("reading ") +
                             (read == "clear" ? "clears" : "sets") + " it";
    one.fields.push_back(std::move(field));
  }

  static constexpr const char* memory_prefix = "Memory_";

  const XmlDocument xml_;
  const std::string prefix_;
  mutable std::set<std::string> names_;
};

}  // namespace

std::vector<RegisterMap> registers_of_component(const std::string& text,
                                                const std::string& origin) {
  return ComponentReader(text, origin).read();
}

}  // namespace platform::handoff

#include <chip/handoff/handoff.h>
#include <chip/handoff/xml.h>
#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

namespace platform::handoff {

namespace {

constexpr unsigned widest_port = 1u << 16;

/// Elements of one kind in a list: MODULES of MODULE.
pugi::xml_object_range<pugi::xml_named_node_iterator> items(const pugi::xml_node& parent,
                                                            const char* list, const char* item) {
  return parent.child(list).children(item);
}

/// What an interface is whose VLNV the file lacks, as in Vivado 2015: by the pins that each has.
std::string kind_by_pins(const BusInterface& bus) {
  const auto has = [&](const std::string& end) {
    return std::any_of(bus.pins.begin(), bus.pins.end(), [&](const auto& pin) {
      const std::string name = "_" + vp::lower(pin.second);
      return name.size() > end.size() &&
             name.compare(name.size() - end.size(), end.size(), end) == 0;
    });
  };
  if (has("_awaddr") || has("_araddr")) return "aximm";
  return has("_tvalid") ? "axis" : "";
}

/// Takes the elements of a .hwh apart.
class HwhReader {
 public:
  HwhReader(std::string text, const std::string& origin)
      : xml_(std::move(text), origin), root_(xml_.root("EDKSYSTEM")) {
    handoff_.file = origin;
  }

  Handoff read() {
    handoff_.tool = attribute(root_, "VIVADOVERSION");
    handoff_.date = attribute(root_, "TIMESTAMP");
    read_system(only("SYSTEMINFO"));
    refuse_pieces();
    for (const auto& port : items(root_, "EXTERNALPORTS", "PORT"))
      handoff_.ports.push_back(read_port(port));
    for (const auto& bus : items(root_, "EXTERNALINTERFACES", "BUSINTERFACE"))
      handoff_.interfaces.push_back(read_interface(bus));
    std::set<std::string> names;
    for (const auto& module : items(root_, "MODULES", "MODULE")) {
      handoff_.modules.push_back(read_module(module));
      const std::string& instance = handoff_.modules.back().instance;
      if (!names.insert(instance).second)
        xml_.fail(module, "a second module '" + instance + "': give one another name");
    }
    check_processing_system();
    return std::move(handoff_);
  }

 private:
  void refuse_pieces() {
    for (const auto& module : items(root_, "MODULES", "MODULE")) {
      if (attribute(module, "MODTYPE") == "ps7_cortexa9")
        xml_.fail(module, std::string("it ") + in_pieces);
    }
  }

  pugi::xml_node only(const char* name) {
    const pugi::xml_node node = root_.child(name);
    if (!node) xml_.fail(root_, std::string("no <") + name + "> in it: export it again");
    return node;
  }

  std::string required(const pugi::xml_node& node, const char* name) {
    const std::string_view value = attribute(node, name);
    if (value.empty())
      xml_.fail(node, std::string("<") + node.name() + "> lacks its attribute " + name);
    return vp::visible(value);
  }

  std::uint64_t number(const pugi::xml_node& node, const char* name) {
    const std::string text = required(node, name);
    const auto value = vp::Decimal::parse(text);
    const auto whole = value ? value->whole() : std::nullopt;
    if (!whole || *whole < 0 || *whole > UINT64_MAX)
      xml_.fail(node, std::string(name) + " '" + vp::excerpt(text) + "' is not a number");
    return static_cast<std::uint64_t>(*whole);
  }

  void read_system(const pugi::xml_node& info) {
    handoff_.name = required(info, "NAME");
    handoff_.board = vp::visible(attribute(info, "BOARD"));
    const std::string family = required(info, "ARCH"), device = vp::lower(required(info, "DEVICE"));
    const std::string grade(attribute(info, "SPEEDGRADE"));
    if (vp::lower(family) != "zynq") {
      xml_.fail(info, "the design is for a " + family + " (" + device +
                          "): markervp models the Zynq-7000 alone");
    }
    handoff_.part = "xc" + device + vp::lower(attribute(info, "PACKAGE")) + grade;
    handoff_.device = "xc" + device + grade;
  }

  Parameters read_parameters(const pugi::xml_node& parent) {
    Parameters result;
    for (const auto& parameter : items(parent, "PARAMETERS", "PARAMETER"))
      result[required(parameter, "NAME")] = vp::visible(attribute(parameter, "VALUE"));
    return result;
  }

  unsigned width_of(const pugi::xml_node& node) {
    if (attribute(node, "LEFT").empty()) return 1;
    const std::uint64_t left = number(node, "LEFT"), right = number(node, "RIGHT");
    const std::uint64_t width = std::max(left, right) - std::min(left, right) + 1;
    if (width > widest_port)
      xml_.fail(node, "a port of " + std::to_string(width) + " bits: at most 65536 are read");
    return static_cast<unsigned>(width);
  }

  Port read_port(const pugi::xml_node& node) {
    Port port;
    port.name = required(node, "NAME");
    const std::string direction = required(node, "DIR");
    port.direction = direction == "I" ? 'I' : direction == "O" ? 'O' : 'B';
    port.width = width_of(node);
    const std::string_view kind = attribute(node, "SIGIS");
    if (kind != "undef") port.kind = vp::visible(kind);
    port.signal = vp::visible(attribute(node, "SIGNAME"));
    port.active_high = attribute(node, "POLARITY") == "ACTIVE_HIGH";
    const std::string_view hz = attribute(node, "CLKFREQUENCY");
    if (hz.empty()) return port;
    const auto value = vp::Decimal::parse(hz);  // "5e+07" since 2025.2
    if (!value || value->negative())
      xml_.fail(node, "CLKFREQUENCY '" + vp::excerpt(vp::visible(hz)) + "' is not a frequency");
    port.hz = value->to_double();
    return port;
  }

  BusInterface read_interface(const pugi::xml_node& node) {
    BusInterface bus;
    bus.name = required(node, "NAME");
    const auto vlnv = vp::split(vp::visible(attribute(node, "VLNV")), ':');
    if (vlnv.size() == 4) bus.kind = vlnv[2];
    const std::string_view type = attribute(node, "TYPE");
    bus.sends = type == "MASTER" || type == "INITIATOR";
    bus.listens = type == "MONITOR";
    bus.bus = vp::visible(attribute(node, "BUSNAME"));
    if (bus.bus == "__NOC__") bus.bus.clear();  // Vivado's word for no connection
    for (const auto& parameter : node.children("PARAMETER"))
      bus.parameters[required(parameter, "NAME")] = vp::visible(attribute(parameter, "VALUE"));
    // Vivado 2015 gives no logical names.
    for (const auto& pin : items(node, "PORTMAPS", "PORTMAP"))
      bus.pins.emplace_back(vp::visible(attribute(pin, "LOGICAL")), required(pin, "PHYSICAL"));
    if (vlnv.size() != 4) bus.kind = kind_by_pins(bus);
    return bus;
  }

  /// A property of a register or field, if it has it and if it is a number.
  std::optional<std::uint32_t> property(const pugi::xml_node& entry, const std::string& name) {
    for (const auto& property : entry.children("PROPERTY"))
      if (attribute(property, "NAME") == name)
        return static_cast<std::uint32_t>(number(property, "VALUE"));
    return std::nullopt;
  }

  void read_registers(const pugi::xml_node& node, Module& module) {
    for (const auto& block : items(node, "ADDRESSBLOCKS", "ADDRESSBLOCK")) {
      for (const auto& entry : items(block, "REGISTERS", "REGISTER")) {
        const auto offset = property(entry, "ADDRESS_OFFSET");
        if (!offset) continue;
        RegisterName named{vp::visible(attribute(block, "INTERFACE")), required(entry, "NAME"),
                           *offset};
        for (const auto& field : items(entry, "FIELDS", "FIELD")) {
          const auto low = property(field, "BIT_OFFSET"), bits = property(field, "BIT_WIDTH");
          if (low && bits) named.fields.push_back({required(field, "NAME"), *low, *bits});
        }
        module.registers.push_back(std::move(named));
      }
    }
  }

  Module read_module(const pugi::xml_node& node) {
    Module module;
    module.instance = required(node, "INSTANCE");
    module.full_name = required(node, "FULLNAME");
    module.vlnv = required(node, "VLNV");
    module.type = vp::visible(attribute(node, "MODTYPE"));
    module.revision = vp::visible(attribute(node, "COREREVISION"));
    if (vp::split(module.vlnv, ':').size() != 4)
      xml_.fail(node, "VLNV '" + vp::excerpt(module.vlnv) + "' is not vendor:library:name:version");
    module.parameters = read_parameters(node);
    for (const auto& port : items(node, "PORTS", "PORT")) module.ports.push_back(read_port(port));
    for (const auto& bus : items(node, "BUSINTERFACES", "BUSINTERFACE"))
      module.interfaces.push_back(read_interface(bus));
    for (const auto& range : items(node, "MEMORYMAP", "MEMRANGE"))
      module.segments.push_back(read_segment(range));
    read_registers(node, module);
    return module;
  }

  Segment read_segment(const pugi::xml_node& node) {
    Segment segment;
    segment.master = vp::visible(attribute(node, "MASTERBUSINTERFACE"));
    segment.instance = required(node, "INSTANCE");
    segment.slave = vp::visible(attribute(node, "SLAVEBUSINTERFACE"));
    segment.base = number(node, "BASEVALUE");
    segment.last = number(node, "HIGHVALUE");
    segment.memory = attribute(node, "MEMTYPE") == "MEMORY";
    segment.base_name = vp::visible(attribute(node, "BASENAME"));
    segment.last_name = vp::visible(attribute(node, "HIGHNAME"));
    if (segment.last < segment.base)
      xml_.fail(node, "the segment of " + segment.instance + " ends before it begins");
    return segment;
  }

  void check_processing_system() {
    const auto is_ps = [](const Module& m) { return m.ip() == "processing_system7"; };
    const auto count = std::count_if(handoff_.modules.begin(), handoff_.modules.end(), is_ps);
    if (count == 1) return;
    if (count > 1) xml_.fail(root_, "more than one processing_system7 in a design");
    const bool has_microblaze = std::any_of(handoff_.modules.begin(), handoff_.modules.end(),
                                            [](const Module& m) { return m.ip() == "microblaze"; });
    xml_.fail(root_, "design '" + handoff_.name + "' has no processing_system7" +
                         (has_microblaze ? ", but a MicroBlaze, which markervp does not model"
                                         : ": it is the inner design of an IP, or a part of one"));
  }

  XmlDocument xml_;
  pugi::xml_node root_;
  Handoff handoff_;
};

template <class Item>
const Item* named(const std::vector<Item>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

std::string parameter(const Parameters& parameters, const std::string& name) {
  const auto exact = parameters.find(name);
  if (exact != parameters.end()) return exact->second;
  const std::string wanted = vp::lower(name);
  for (const auto& [key, value] : parameters) {
    if (vp::lower(key) == wanted) return value;
  }
  return {};
}

const Port* Module::port(const std::string& name) const {
  return named(ports, name);
}

const BusInterface* Module::interface(const std::string& name) const {
  return named(interfaces, name);
}

std::string Module::ip() const {
  return vp::split(vlnv, ':').at(2);
}

bool Module::is_vendors() const {
  const auto parts = vp::split(vlnv, ':');
  return (parts[0] == "xilinx.com" || parts[0] == "amd.com") &&
         (parts[1] == "ip" || parts[1] == "inline_hdl");
}

const Module* Handoff::module(const std::string& instance) const {
  const auto found = std::find_if(modules.begin(), modules.end(),
                                  [&](const Module& m) { return m.instance == instance; });
  return found == modules.end() ? nullptr : &*found;
}

const Module& Handoff::ps() const {
  return *std::find_if(modules.begin(), modules.end(),
                       [](const Module& m) { return m.ip() == "processing_system7"; });
}

Handoff read_hwh(std::string text, const std::string& origin) {
  return HwhReader(std::move(text), origin).read();
}

}  // namespace platform::handoff

#include <chip/block_design/block_design.h>

#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>

#include <algorithm>
#include <cctype>

// Ways of a design between masters and slaves: each interconnect on one is a router that leads the
// slave's addresses on.
namespace platform::block_design {

namespace {

constexpr unsigned longest_way = 32;  ///< interconnects behind each other; more is a ring

}  // namespace

void BlockDesign::join_addresses() {
  for (const AddressSegment& segment : design_.addresses) join_segment(segment);
}

/// The interconnects from the master to the slave, in this order.
std::vector<std::string> BlockDesign::way_between(const AddressSegment& segment) const {
  std::vector<std::string> way;
  if (!find_way(segment.slave, segment.master, way, 0)) {
    refuse(segment.slave,
           "has an address for " + segment.master.text() + ", and no bus leads from there to it");
  }
  return way;
}

// From the slave up: an interconnect is entered at each of its slave ports.
bool BlockDesign::find_way(const End& from, const End& master, std::vector<std::string>& way,
                           unsigned depth) const {
  const PlacedPart* part = design_.part(from.part);
  const auto bus = part->buses.find(from.port);
  if (bus == part->buses.end() || depth > longest_way) return false;
  const End& up = bus->second;
  if (up.part == master.part && up.port == master.port) return true;
  if (!is_bus(up.part)) return false;
  for (const auto& [port, source] : design_.part(up.part)->buses) {
    if (!find_way({up.part, port, source.place}, master, way, depth + 1)) continue;
    way.push_back(up.part);
    return true;
  }
  return false;
}

vp::Router& BlockDesign::router(const std::string& name) {
  return dynamic_cast<vp::Router&>(*placed(name).object);
}

/// The first router of a master's way; one of its own where it meets no interconnect.
vp::Router& BlockDesign::way_of(const End& master, const std::vector<std::string>& way) {
  vp::Router*& first = first_of_[master.text()];
  vp::Router* wanted = nullptr;
  if (!way.empty()) {
    wanted = &router(way.front());
  } else {
    vp::Router*& direct = direct_of_[master.text()];
    if (!direct)
      direct = &direct_.emplace_back((master.part + "_" + vp::lower(master.port)).c_str());
    wanted = direct;
  }
  if (first) {
    if (first != wanted) refuse(master, "is joined to two buses");
    return *first;
  }
  Placed& part = placed(master.part);
  const auto port = part.masters.find(master.port);
  if (port == part.masters.end()) {
    // A master in a stub asks for nothing: what it is wired to is tied, once.
    if (part.any_output) {
      no_master(master.part + "_" + vp::lower(master.port)).bind(wanted->socket);
      first = wanted;
      return *wanted;
    }
    std::vector<std::string> names;
    for (const auto& [name, known] : part.masters) names.push_back(name);
    refuse(master, "is no master that the platform models", names);
  }
  first = wanted;
  port->second.bind(*wanted);
  return *wanted;
}

SlavePort BlockDesign::slave_of(const AddressSegment& segment) {
  Placed& part = placed(segment.slave.part);
  const auto found = part.slaves.find(segment.slave.port);
  if (found != part.slaves.end()) return found->second;
  if (part.any_slave) return part.any_slave(segment.slave.port);
  std::vector<std::string> names;
  for (const auto& [name, known] : part.slaves) names.push_back(name);
  refuse(segment.slave, "is no slave that the platform models", names);
}

/// Where software finds a slave is a property of it.
std::uint64_t BlockDesign::base_of(const AddressSegment& segment) {
  if (is_absolute(segment.slave) || segment.master.part != ps_) return segment.base;
  const std::string number = number_of(segment);
  auto& base = bases_[segment.slave.text() + number];
  if (!base) {
    sc_core::sc_module* module = placed(segment.slave.part).object.get();
    const vp::HierarchyScope scope(*module);
    const bool has_others = std::any_of(
        design_.addresses.begin(), design_.addresses.end(), [&](const AddressSegment& other) {
          return other.slave.part == segment.slave.part && other.slave.port != segment.slave.port;
        });
    const std::string name =
        (has_others ? vp::lower(segment.slave.port) + "_" : "") + "base_address" + number;
    base = std::make_unique<vp::Parameter<std::uint64_t>>(
        name.c_str(), segment.base, vp::Unit::address, vp::Range<std::uint64_t>{0, 0xFFFF'FFFF},
        vp::Source::decision, "where software finds it, " + vp::hex(segment.size) + " bytes");
  }
  return base->get();
}

/// Whether it sees the addresses of its master: a port of the PS.
bool BlockDesign::is_absolute(const End& slave) {
  const auto& slaves = placed(slave.part).slaves;
  const auto port = slaves.find(slave.port);
  return port != slaves.end() && port->second.absolute;
}

/// Whether a slave has a second place, for this master or for another one.
bool BlockDesign::is_seen_elsewhere(const AddressSegment& segment) {
  return !is_absolute(segment.slave) &&
         std::any_of(design_.addresses.begin(), design_.addresses.end(),
                     [&](const AddressSegment& other) {
                       return other.slave.text() == segment.slave.text() &&
                              other.base != segment.base && asks(other);
                     });
}

/// Where the places of a slave come together: it has one bus itself.
vp::Router& BlockDesign::windows_of(const AddressSegment& segment) {
  vp::Router*& windows = windows_of_[segment.slave.text()];
  if (windows) return *windows;
  const std::string name = segment.slave.part + "_" + vp::lower(segment.slave.port) + "_windows";
  windows = &direct_.emplace_back(name.c_str());
  std::uint64_t size = 0;
  for (const AddressSegment& other : design_.addresses)
    if (other.slave.text() == segment.slave.text()) size = std::max(size, other.size);
  slave_of(segment).bind(
      windows->map(segment.slave.part, 0, size, vp::Router::Addresses::relative));
  return *windows;
}

/// Of a slave that its master sees in several places: "", "_1", "_2" …
std::string BlockDesign::number_of(const AddressSegment& segment) const {
  std::size_t number = 0;
  for (const AddressSegment& other : design_.addresses) {
    if (&other == &segment) break;
    number +=
        other.slave.text() == segment.slave.text() && other.master.text() == segment.master.text()
            ? 1
            : 0;
  }
  return number == 0 ? "" : "_" + std::to_string(number);
}

/// A stub asks for nothing: the local memory of a processor in the PL needs no way there.
bool BlockDesign::asks(const AddressSegment& segment) {
  std::vector<std::string> way;
  return !placed(segment.master.part).any_output || find_way(segment.slave, segment.master, way, 0);
}

void BlockDesign::join_segment(const AddressSegment& segment) {
  if (!asks(segment)) return;
  const std::vector<std::string> way = way_between(segment);
  std::vector<vp::Router*> routers{&way_of(segment.master, way)};
  for (std::size_t i = 1; i < way.size(); ++i) routers.push_back(&router(way[i]));
  entered_.insert(routers.begin(), routers.end());
  const bool absolute = is_absolute(segment.slave);
  const std::uint64_t base = base_of(segment);
  if (absolute) {
    auto& master = placed(segment.master.part).masters;
    const auto port = master.find(segment.master.port);
    if (port != master.end() && port->second.share)
      port->second.share(paths_[segment.slave.text()]);
  }
  const bool is_port = segment.slave.part == ps_;
  std::string name = is_port ? vp::lower(segment.slave.port) : segment.slave.part;
  const auto twice = std::count_if(
      design_.addresses.begin(), design_.addresses.end(), [&](const AddressSegment& other) {
        return other.slave.part == segment.slave.part && other.slave.port != segment.slave.port;
      });
  if (!is_port && twice != 0) name += "_" + vp::lower(segment.slave.port);
  name += number_of(segment);
  using Addresses = vp::Router::Addresses;
  for (std::size_t i = 0; i < routers.size(); ++i) {
    const bool last = i + 1 == routers.size();
    std::set<std::uint64_t>& bases = mapped_[std::string(routers[i]->name()) + "/" + name];
    if (!bases.insert(base).second) continue;
    // Masters of one bus may see a slave in two places: the bus has a range for each.
    const std::string region = bases.size() == 1 ? name : name + "_" + vp::lower(vp::hex(base));
    try {
      RegionSocket& socket =
          routers[i]->map(region, base, segment.size,
                          last && !absolute ? Addresses::relative : Addresses::absolute);
      if (last && is_seen_elsewhere(segment)) {
        socket.bind(windows_of(segment).socket);
      } else if (last) {
        slave_of(segment).bind(socket);
      } else {
        socket.bind(routers[i + 1]->socket);
      }
    } catch (const vp::InputError& error) {
      throw vp::InputError(segment.slave.place + ": " + error.what());
    }
  }
}

/// What nothing comes to has a master that asks for nothing.
RegionSocket& BlockDesign::no_master(const std::string& name) {
  return tied_masters_.emplace_back((name + "_tied").c_str()).socket;
}

// A master without a segment is answered with an error wherever it goes.
void BlockDesign::close_open_ports() {
  for (auto& [name, part] : placed_) {
    if (name == ps_) continue;
    if (is_bus(name) && entered_.count(&router(name)) == 0)
      no_master(name).bind(router(name).socket);
    for (auto& [bus, port] : part.masters) {
      if (first_of_.count(name + "." + bus) == 0)
        port.bind(direct_.emplace_back((name + "_" + vp::lower(bus) + "_open").c_str()));
    }
    for (auto& [bus, port] : part.slaves) {
      const bool is_seen =
          std::any_of(design_.addresses.begin(), design_.addresses.end(),
                      [&name = name, &bus = bus](const AddressSegment& segment) {
                        return segment.slave.part == name && segment.slave.port == bus;
                      });
      if (is_seen) continue;
      if (part.open_slave) {
        part.open_slave(bus);
      } else {
        port.bind(no_master(name + "_" + vp::lower(bus)));
      }
    }
  }
}

}  // namespace platform::block_design

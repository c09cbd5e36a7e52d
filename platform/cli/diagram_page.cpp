#include <cli/diagram_page.h>

#include <fmt/format.h>

#include <chip/block_design/diagram.h>
#include <chip/system/hardware_map.h>
#include <trace/statistics.h>
#include <vp/counter.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <vector>

namespace platform::cli {

namespace {

using facts::HardwareMap;
using trace::json_text;

/// The picture in one line, from its element on.
std::string picture_of(const block_design::DesignFile& design, const std::string& scratch) {
  const vp::PartFile file(scratch + ".svg");
  block_design::write_diagram(design, file.path());
  std::string svg = vp::read_text(file.path(), "diagram");
  svg.erase(0, svg.find("<svg"));
  std::replace(svg.begin(), svg.end(), '\n', ' ');
  return svg;
}

std::string registers_of(const HardwareMap& map, const std::string& module) {
  std::vector<std::string> rows;
  for (const HardwareMap::Device& device : map.devices) {
    if (device.path != module && device.path.rfind(module + ".", 0) != 0) continue;
    for (const HardwareMap::Register& r : device.registers)
      rows.push_back(fmt::format("[\"0x{:08X}\",{},{},{}]", device.base + r.offset,
                                 json_text(r.name), json_text(r.access),
                                 json_text(r.documentation)));
  }
  return "[" + vp::join(rows, ",") + "]";
}

/// The module of a part, and the streams at it, which are named by their master.
std::vector<std::string> places_of(const block_design::DesignFile& design,
                                   const block_design::PlacedPart& part, const std::string& module,
                                   const std::string& pl) {
  std::vector<std::string> places{module};
  for (const block_design::PlacedPart& slave : design.parts) {
    for (const auto& [bus, master] : slave.buses)
      if (slave.name == part.name || master.part == part.name)
        places.push_back(pl + "." + master.part + "_" + master.port);
  }
  return places;
}

/// Whether a counter is that of a memory-mapped link to the part: pl.<bus before it>.<part>.reads.
bool is_of_link(const std::string& counter, const std::string& part) {
  const std::vector<std::string> words = vp::split(counter, '.');
  return words.size() == 4 && words[0] != "ps" && words[2] == part;
}

/// What happened at all.
std::string traffic_of(const std::vector<std::string>& places, const std::string& part) {
  std::vector<std::string> rows;
  for (const vp::Counter* counter : vp::all_counters()) {
    const std::string name = counter->name();
    const bool is_here =
        is_of_link(name, part) ||
        std::any_of(places.begin(), places.end(),
                    [&name](const std::string& place) { return name.rfind(place + ".", 0) == 0; });
    if (*counter != 0 && is_here)
      rows.push_back(fmt::format("[{},{},{}]", json_text(name), counter->get(),
                                 json_text(counter->documentation())));
  }
  return "[" + vp::join(rows, ",") + "]";
}

/// Of each part, with its module in the simulation.
std::string parts_of(Zynq& zynq, const block_design::DesignFile& design) {
  const HardwareMap map = hardware_map(zynq);
  const std::string pl = zynq.pl().name();
  std::vector<std::string> parts;
  for (const block_design::PlacedPart& part : design.parts) {
    const std::string module =
        part.vlnv.find(":processing_system7:") != std::string::npos ? "ps" : pl + "." + part.name;
    parts.push_back(
        fmt::format("{{\"name\":{},\"ip\":{},\"module\":{},\"registers\":{},"
                    "\"traffic\":{}}}",
                    json_text(part.name), json_text(part.vlnv), json_text(module),
                    module == "ps" ? "[]" : registers_of(map, module),
                    traffic_of(places_of(design, part, module, pl), part.name)));
  }
  return "[" + vp::join(parts, ",") + "]";
}

std::string diagram_of(Zynq& zynq, const std::string& file, const std::string& scratch) {
  const block_design::DesignFile design = block_design::read_design_file(file);
  try {
    return "{\"svg\":" + json_text(picture_of(design, scratch)) +
           ",\"parts\":" + parts_of(zynq, design) + "}";
  } catch (const vp::InputError& error) {
    return "{\"problem\":" + json_text(error.what()) + "}";
  }
}

}  // namespace

void add_diagram(page::RunExtras& page, Zynq& zynq, const vp::Configuration& configuration,
                 const std::string& folder) {
  const vp::Setting* design = configuration.find("design");
  if (design && block_design::is_design_yaml(design->text))
    page.add_member("diagram", diagram_of(zynq, design->text, folder + "/diagram"));
}

}  // namespace platform::cli

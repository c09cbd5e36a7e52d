#include <chip/block_design/import_design.h>
#include <vp/text.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace platform::block_design {

namespace {

using Json = nlohmann::ordered_json;

/// A line for each; empty: the hand-off names none.
std::string lines_of(const handoff::Module& module, const std::string& interface) {
  std::vector<std::string> lines;
  for (const handoff::RegisterName& one : module.registers) {
    if (!one.interface.empty() && one.interface != interface) continue;
    Json fields = Json::object();
    for (const auto& field : one.fields) fields[field.name] = {field.low, field.bits};
    const Json described = {{"offset", one.offset}, {"fields", fields}};
    lines.push_back("  " + Json(one.name).dump() + ": " + described.dump());
  }
  return vp::join(lines, ",\n");
}

}  // namespace

// Of a part with several interfaces those of the first one that the PS sees.
std::string register_names(const handoff::Handoff& handoff) {
  std::vector<std::string> parts;
  std::set<std::string> seen;
  for (const handoff::Segment& segment : handoff.ps().segments) {
    const handoff::Module* module = handoff.module(segment.instance);
    if (!module || !seen.insert(module->instance).second) continue;
    const std::string lines = lines_of(*module, segment.slave);
    if (!lines.empty())
      parts.push_back(" " + Json(module->instance).dump() + ": {\n" + lines + "\n }");
  }
  return "{\n" + vp::join(parts, ",\n") + (parts.empty() ? "" : "\n") + "}\n";
}

}  // namespace platform::block_design

#include <designs/designs.h>

#include <designs/plugin.h>
#include <vp/error.h>
#include <vp/text.h>
#include <algorithm>

namespace platform {

const DesignInfo& thesis_design();
const DesignInfo& ps_only_design();

const std::vector<const DesignInfo*>& builtin_designs() {
  static const std::vector<const DesignInfo*> designs{&thesis_design(), &ps_only_design()};
  return designs;
}

const DesignInfo& design_named(const std::string& name) {
  if (is_design_file(name)) return load_design(name);
  std::vector<std::string> names;
  for (const DesignInfo* design : builtin_designs()) {
    if (design->name == name) return *design;
    names.push_back(design->name);
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("no design '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "choose " + vp::one_of(names) + ", or the file of another one, .so");
}

const DesignInfo& design_of_program(const std::string& program) {
  for (const DesignInfo* design : builtin_designs()) {
    const auto& own = design->programs;
    if (std::find(own.begin(), own.end(), program) != own.end()) return *design;
  }
  return *builtin_designs().front();
}

}  // namespace platform

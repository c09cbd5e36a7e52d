#include <zynq/design.h>

#include <vp/ip.h>
#include <zynq/parts.h>
#include <algorithm>

namespace platform {

const trace::Vocabulary& no_words() {
  static const trace::Vocabulary none;
  return none;
}

std::vector<Design::ClockRole> Design::clock_roles() {
  std::vector<ClockRole> roles;
  for (const Part& part : parts_of(module())) {
    const bool known = std::any_of(roles.begin(), roles.end(),
                                   [&](const ClockRole& role) { return role.clock == part.clock; });
    const std::string role = part.clock_name.substr(part.clock_name.rfind('.') + 1);
    if (!known) roles.push_back({role, part.clock, part.group});
  }
  return roles;
}

}  // namespace platform

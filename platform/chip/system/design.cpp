#include <chip/system/design.h>

#include <algorithm>

#include <chip/cost/parts.h>
#include <vp/ip.h>

namespace platform {

namespace {

// What the PL's memory masters see: the range of the HP0 port.
constexpr std::uint64_t hp0_base = 0, hp0_size = 0x4000'0000;

}  // namespace

void PlPorts::m_axi_gp0(vp::Router& registers) {
  ps.m_axi_gp0.link.socket.bind(registers.socket);
  registers_ = &registers;
}

void PlPorts::m_axi_gp1(vp::Router& registers, const vp::Clock& aclk) {
  ps.m_axi_gp1(aclk).link.socket.bind(registers.socket);
  registers_gp1_ = &registers;
}

void PlPorts::s_axi_hp0(vp::Router& memory) {
  memory.map("s_axi_hp0", hp0_base, hp0_size, vp::Router::Addresses::absolute)
      .bind(ps.s_axi_hp0.socket);
  has_memory_master_ = true;
}

void PlPorts::tie_off() {
  if (!registers_) ps.m_axi_gp0.link.socket.bind(no_registers_.emplace("m_axi_gp0_tied").socket);
  if (!has_memory_master_) {
    no_memory_master_.emplace("s_axi_hp0_tied").socket.bind(ps.s_axi_hp0.socket);
  }
}

void PlPorts::irq_f2p(vp::Signal<std::uint32_t>& lines) {
  ps.gic.irq_f2p(lines);
}

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

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include <trace/clock_choice.h>
#include <trace/transactions/interfaces.h>
#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/text.h>

// Buses whose signals have names that say nothing: the user says which is which.

namespace platform::trace {

namespace {

struct Setting {
  const char* name;
  std::initializer_list<BusKind> kinds;
};

/// What may be said besides roles.
const std::array<Setting, 7> settings = {{{"baud", {BusKind::uart}},
                                          {"bits", {BusKind::uart, BusKind::spi}},
                                          {"parity", {BusKind::uart}},
                                          {"mode", {BusKind::spi}},
                                          {"order", {BusKind::spi}},
                                          {"select", {BusKind::spi}},
                                          {"active", {BusKind::irq}}}};

bool has_setting(BusKind kind, const std::string& name) {
  return std::any_of(settings.begin(), settings.end(), [&](const Setting& one) {
    return name == one.name &&
           std::find(one.kinds.begin(), one.kinds.end(), kind) != one.kinds.end();
  });
}

std::vector<std::string> blank_separated(const std::string& text) {
  std::vector<std::string> words;
  for (const std::string& word : vp::split(text, ' ')) {
    if (!vp::trim(word).empty()) words.emplace_back(vp::trim(word));
  }
  return words;
}

/// Roles without which nothing can be decoded; of AXI those of reads or of writes.
std::vector<std::vector<std::string>> least_roles(BusKind kind) {
  switch (kind) {
    case BusKind::axi4:
    case BusKind::axi4_lite:
      return {{"awvalid", "awready", "wvalid", "wready", "bvalid", "bready"},
              {"arvalid", "arready", "rvalid", "rready"}};
    case BusKind::axi_stream:
      return {{"tvalid"}};
    case BusKind::apb:
      return {{"psel", "penable"}};
    case BusKind::wishbone:
      return {{"cyc", "stb", "ack"}};
    case BusKind::i2c:
      return {{"scl", "sda"}};
    case BusKind::spi:
      return {{"sclk", "mosi"}, {"sclk", "miso"}};
    case BusKind::uart:
    case BusKind::irq:
      break;
  }
  return {{"line"}};
}

void check_roles(const TraceFile& file, const BusInterface& one, const std::string& where) {
  const auto least = least_roles(one.kind);
  const auto complete = [&](const std::vector<std::string>& roles) {
    return std::all_of(roles.begin(), roles.end(), [&](const auto& r) { return one.role(r); });
  };
  if (std::none_of(least.begin(), least.end(), complete)) {
    std::vector<std::string> choices;
    choices.reserve(least.size());
    for (const auto& roles : least) choices.push_back(vp::join(roles, ", "));
    throw vp::InputError(where + "needs " + vp::join(choices, "; or "));
  }
  // A half of AXI that is there must be whole.
  for (const auto& roles : least) {
    if (one.role(roles.front()) && !complete(roles))
      throw vp::InputError(where + "needs " + vp::join(roles, ", "));
  }
  for (const auto& [role, variable] : one.roles) {
    const bool is_control =
        std::any_of(least.begin(), least.end(), [&role = role](const auto& roles) {
          return std::find(roles.begin(), roles.end(), role) != roles.end();
        });
    const bool may_be_wide = role == "psel" || one.kind == BusKind::irq;
    if (is_control && !may_be_wide && file.variable(variable).width != 1) {
      throw vp::InputError(where + role + " is a vector of " +
                           std::to_string(file.variable(variable).width) + " bits, not a wire");
    }
  }
}

}  // namespace

void describe_interface(const TraceFile& file, const std::string& text, FoundInterfaces& found) {
  const std::string where = "--as '" + vp::excerpt(text) + "': ";
  const std::size_t colon = text.find(':');
  const std::vector<std::string> head = blank_separated(text.substr(0, colon));
  if (colon == std::string::npos || head.size() != 2) {
    throw vp::InputError(where + "write it like 'uart console: line=top.pin7 baud=115200'");
  }
  BusInterface one;
  one.kind = bus_kind_named(head[0]);
  one.name = head[1];
  for (const std::string& word : blank_separated(text.substr(colon + 1))) {
    const std::size_t sign = word.find('=');
    const std::string role = word.substr(0, sign);
    if (sign == std::string::npos) throw vp::InputError(where + "'" + word + "' has no '='");
    if (has_setting(one.kind, role)) {
      one.settings[role] = word.substr(sign + 1);
      continue;
    }
    const auto& roles = roles_of(one.kind);
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) {
      const std::string near = vp::nearest_match(role, roles);
      throw vp::InputError(
          where + "'" + role + "' is no role of " + bus_kind_name(one.kind) +
          (near.empty() ? ": " + vp::join(roles, ", ") : ": did you mean '" + near + "'?"));
    }
    one.roles[role] = vp::find_path(word.substr(sign + 1), file.paths(), where);
  }
  check_roles(file, one, where);
  one.scope = scope_of(file.paths()[one.roles.begin()->second]);
  auto& all = found.interfaces;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const BusInterface& other) { return other.name == one.name; }),
            all.end());
  all.push_back(std::move(one));
}

}  // namespace platform::trace

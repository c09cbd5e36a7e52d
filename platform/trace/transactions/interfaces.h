#pragma once

#include <trace/replay.h>
#include <trace/transactions/transaction.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace platform::trace {

/// A bus among the signals of a trace.
struct BusInterface {
  enum class Side : std::uint8_t { unknown, manager, subordinate };

  BusKind kind = BusKind::axi4;
  std::string name;   ///< scope and prefix: "tb.dut.m_axi"; no two are alike
  std::string scope;  ///< of its signals: "tb.dut"
  /// Whose ports they are, by the prefix: `m_axi` belongs to a manager, `s_axi` to a subordinate.
  Side side = Side::unknown;
  std::map<std::string, std::uint32_t> roles;   ///< "awvalid": variable
  std::map<std::string, std::string> settings;  ///< that the user gave: "baud": "115200"
  std::optional<std::uint32_t> reset;           ///< variable
  bool reset_low = true;                        ///< active low
  struct Copy {
    std::string name, scope;
    Side side = Side::unknown;
  };
  std::vector<Copy> copies;  ///< the same bus at other levels

  std::optional<std::uint32_t> role(const std::string& name) const {
    const auto found = roles.find(name);
    return found == roles.end() ? std::nullopt : std::optional(found->second);
  }
};

/// What looks like a bus and cannot be decoded.
struct LeftOut {
  std::string name, reason;
};

struct FoundInterfaces {
  std::vector<BusInterface> interfaces;  ///< by name
  std::vector<LeftOut> left_out;
};

/// Finds buses by the names of their signals: a prefix, and a suffix that says the role, in any
/// case, with or without separators; members of structures count as prefix. `S00_AXI_AWVALID`,
/// `req.aw.valid`, `m_axis_tvalid`, `wb_cyc_i`, `uart_tx`.
FoundInterfaces find_interfaces(const TraceFile& file);

/// Adds a bus that the user describes: "axi4 dma: awvalid=top.u7.n12 awready=top.u7.n13 …",
/// "uart console: line=top.pin7 baud=115200". It replaces one of that name. Throws vp::InputError.
void describe_interface(const TraceFile& file, const std::string& text, FoundInterfaces& found);

/// The roles that a bus of this kind may have.
const std::vector<std::string>& roles_of(BusKind kind);

}  // namespace platform::trace

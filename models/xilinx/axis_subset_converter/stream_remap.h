#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace xilinx {

/// What drives a bit of a remapped signal.
struct RemapBit {
  enum class From : std::uint8_t { zero, one, data, user, keep, strobe, last, id, dest };
  From from = From::zero;
  unsigned bit = 0;
};

/// An expression of the AXI4-Stream subset converter (PG085), as "tdata[7:0],8'h00,tdata[15:8]":
/// signals and constants one behind the other, the upper ones first. The result is the lowest bit
/// first. Throws vp::InputError, which says what of it is wrong; `of` names it in messages.
std::vector<RemapBit> parse_remap(const std::string& expression, const std::string& of);

}  // namespace xilinx

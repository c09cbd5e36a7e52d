#pragma once

#include <vp/ip.h>
#include <vp/register_bank.h>

/// What the Xilinx IP with registers on AXI4-Lite share.
namespace xilinx {

/// How their registers answer: holes are acknowledged, byte enables ignored.
inline vp::RegisterBankOptions axi_lite_options(unsigned address_bits) {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.byte_enables = vp::RegisterBankOptions::ByteEnables::ignore;
  options.address_bits = address_bits;
  return options;
}

/// Clocks in which an AXI4-Lite slave works for one access: the register stages of the IPIF from
/// address to response (DS768).
constexpr std::uint64_t clocks_per_access = 5;

/// Reads and writes by software so far, those that a poll passed over included.
inline std::uint64_t accesses(const vp::RegisterBank& bank) {
  std::uint64_t sum = 0;
  for (const vp::Register& r : bank.registers()) sum += r.use().reads + r.use().writes;
  return sum;
}

/// A configuration like the thesis' as Vivado builds it. Public reports of designs with the PS, an
/// interconnect, a reset and one or two such IP have 441 to 953 LUT and 607 to 1129 FF in all.
inline vp::IpEstimate axi_estimate(const char* kind, std::uint32_t lut, std::uint32_t ff,
                                   double bram36) {
  vp::IpEstimate e;
  e.kind = kind;
  e.lut = lut;
  e.ff = ff;
  e.bram36 = bram36;
  e.uncertainty_percent = 40;
  e.source = "assumed from public utilisation reports of designs with this IP";
  // Memory side and streams work at 150 MHz there (PG022); crossbars at 190 and more, speed grade
  // -2 (PG059).
  e.fmax_hz = 120'000'000;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation = "AXI4-Lite of such IP on Artix 7, the same fabric, -1 (PG022, PG067)";
  return e;
}

}  // namespace xilinx

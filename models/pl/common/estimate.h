#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <vp/ip.h>
#include <xilinx/bram/bram.h>

/// What the estimates of the IP share. The thesis' utilisation is in figures 4.26, 4.29 and 4.31,
/// whose numbers are not in its text: counts come from synthesis of the IP's RTL or, without RTL,
/// from the structure.
namespace pl {

constexpr std::uint64_t mhz = 1'000'000;

/// Words of a FIFO up to which it is distributed memory, or what synthesis makes of it.
constexpr std::uint32_t deepest_in_lut = 256;

/// Block memories of a FIFO of `depth` words that is deeper.
inline double fifo_memory(std::uint32_t depth, std::uint32_t width) {
  return depth > deepest_in_lut ? xilinx::block_ram_36(depth, width) : 0;
}

/// An IP that comes with RTL: all that is known of it is what synthesis gives.
inline vp::IpEstimate synthesised_ip(const char* kind,
                                     std::map<std::string, std::int64_t> parameters = {}) {
  vp::IpEstimate e;
  e.kind = kind;
  e.rtl = {kind, std::move(parameters), {}};
  return e;
}

/// One of the thesis, where it works at the system clock.
inline vp::IpEstimate rtl_ip(const char* kind,
                             std::map<std::string, std::int64_t> parameters = {}) {
  vp::IpEstimate e = synthesised_ip(kind, std::move(parameters));
  e.fmax_hz = 100 * mhz;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation = "works at the thesis' system clock (4.1)";
  return e;
}

/// An IP whose clock the thesis does not limit: it works at `fmax_hz` there.
inline vp::IpEstimate small_ip(const char* kind, std::uint32_t lut, std::uint32_t ff,
                               std::uint64_t fmax_hz) {
  vp::IpEstimate e;
  e.kind = kind;
  e.lut = lut;
  e.ff = ff;
  e.uncertainty_percent = 50;
  e.source = "derived from the structure that thesis 4.3 and 4.4 describe";
  e.fmax_hz = fmax_hz;
  e.fmax_origin = vp::FmaxOrigin::derived;
  e.fmax_documentation = "works at the thesis' system clock (4.1)";
  return e;
}

}  // namespace pl

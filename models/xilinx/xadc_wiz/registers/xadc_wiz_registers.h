#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// XADC wizard v3.3 (PG091) with AXI4-Lite: its own registers, and from `drp` on those of the XADC,
/// a word each.
namespace xadc_wiz {

constexpr std::uint32_t SRR = 0x00;
constexpr std::uint32_t SR = 0x04;
constexpr std::uint32_t AOSR = 0x08;
constexpr std::uint32_t CONVSTR = 0x0C;
constexpr std::uint32_t SYSMONRR = 0x10;
constexpr std::uint32_t GIER = 0x5C;
constexpr std::uint32_t IPISR = 0x60;
constexpr std::uint32_t IPIER = 0x68;
constexpr std::uint32_t drp = 0x200;
constexpr unsigned drp_count = 128;
constexpr unsigned address_bits = 11;
constexpr std::uint32_t reset_key = 0xA;
constexpr std::uint32_t gier_GIE = 1u << 31;

/// Bits of SR.
namespace sr {
constexpr std::uint32_t EOC = 1u << 6;
constexpr std::uint32_t EOS = 1u << 7;
}  // namespace sr

/// Bits of IPISR and IPIER: 4 end of sequence, 5 end of conversion, others alarms.
constexpr std::uint32_t event_EOS = 1u << 4, event_EOC = 1u << 5, events = 0x7FF;

#define XADC_WIZ_DRP(n) \
  { "DRP_" #n, drp + 4 * 0x##n, 0, vp::Access::read_write, 0xFFFF, "Register 0x" #n " of the XADC" }
#define XADC_WIZ_DRP_ROW(n)                                                           \
  XADC_WIZ_DRP(n##0), XADC_WIZ_DRP(n##1), XADC_WIZ_DRP(n##2), XADC_WIZ_DRP(n##3),     \
      XADC_WIZ_DRP(n##4), XADC_WIZ_DRP(n##5), XADC_WIZ_DRP(n##6), XADC_WIZ_DRP(n##7), \
      XADC_WIZ_DRP(n##8), XADC_WIZ_DRP(n##9), XADC_WIZ_DRP(n##A), XADC_WIZ_DRP(n##B), \
      XADC_WIZ_DRP(n##C), XADC_WIZ_DRP(n##D), XADC_WIZ_DRP(n##E), XADC_WIZ_DRP(n##F)

inline constexpr vp::RegisterInfo registers[] = {
    {"SRR", SRR, 0, vp::Access::write_only, 0xF, "0xA resets the core"},
    {"SR", SR, 0, vp::Access::read_only, 0, "Channel; ends of conversion, which a read clears"},
    {"AOSR", AOSR, 0, vp::Access::read_only, 0, "Alarms"},
    {"CONVSTR", CONVSTR, 0, vp::Access::write_only, 0x1, "1 starts a conversion"},
    {"SYSMONRR", SYSMONRR, 0, vp::Access::write_only, 0x1, "1 resets the XADC"},
    {"GIER", GIER, 0, vp::Access::read_write, gier_GIE, "Global interrupt enable"},
    {"IPISR", IPISR, 0, vp::Access::write_1_to_toggle, events, "Events"},
    {"IPIER", IPIER, 0, vp::Access::read_write, events, "Events that interrupt"},
    XADC_WIZ_DRP_ROW(0),
    XADC_WIZ_DRP_ROW(1),
    XADC_WIZ_DRP_ROW(2),
    XADC_WIZ_DRP_ROW(3),
    XADC_WIZ_DRP_ROW(4),
    XADC_WIZ_DRP_ROW(5),
    XADC_WIZ_DRP_ROW(6),
    XADC_WIZ_DRP_ROW(7),
};

#undef XADC_WIZ_DRP
#undef XADC_WIZ_DRP_ROW

}  // namespace xadc_wiz

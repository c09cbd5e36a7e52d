#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Clocking wizard v6.0 (PG065) with dynamic reconfiguration over AXI4-Lite: an MMCM whose factors
/// software sets.
namespace clk_wiz {

constexpr std::uint32_t SRR = 0x000;
constexpr std::uint32_t SR = 0x004;
constexpr std::uint32_t CCR0 = 0x200;
constexpr std::uint32_t CCR1 = 0x204;
constexpr std::uint32_t CCR2 = 0x208;  ///< of output n: + 12 · n
constexpr std::uint32_t output_stride = 12;
constexpr std::uint32_t CCR23 = 0x25C;
constexpr unsigned output_count = 7;
constexpr unsigned address_bits = 11;
constexpr std::uint32_t reset_key = 0xA;

constexpr std::uint32_t sr_LOCKED = 1u << 0;

/// Bits of CCR0.
namespace ccr0 {
constexpr std::uint32_t DIVCLK = 0xFFu;
constexpr unsigned MULT_shift = 8, FRAC_shift = 16;
constexpr std::uint32_t MULT = 0xFFu << MULT_shift;
constexpr std::uint32_t FRAC = 0x3FFu << FRAC_shift;
}  // namespace ccr0

/// Bits of CCR2 and its like; the fraction is in thousandths.
namespace divide {
constexpr std::uint32_t Divide = 0xFFu;
constexpr unsigned FRAC_shift = 8;
constexpr std::uint32_t FRAC = 0x3FFu << FRAC_shift;
}  // namespace divide

/// Bits of CCR23.
namespace ccr23 {
constexpr std::uint32_t LOAD = 1u << 0;
constexpr std::uint32_t SADDR = 1u << 1;
}  // namespace ccr23

#define CLK_WIZ_OUTPUT(n)                                                                          \
  {"CLKOUT" #n "_DIVIDE",                                                                          \
   CCR2 + (n)*output_stride,                                                                       \
   0x00000001,                                                                                     \
   vp::Access::read_write,                                                                         \
   0x0007FFFF,                                                                                     \
   "Output " #n ": divisor, thousandths"},                                                         \
      {"CLKOUT" #n "_PHASE", CCR2 + (n)*output_stride + 4,  0, vp::Access::read_write,             \
       0xFFFFFFFF,           "Output " #n ": phase, stored"},                                      \
  {                                                                                                \
    "CLKOUT" #n "_DUTY", CCR2 + (n)*output_stride + 8, 50'000, vp::Access::read_write, 0xFFFFFFFF, \
        "Output " #n ": duty cycle, stored"                                                        \
  }

inline constexpr vp::RegisterInfo registers[] = {
    {"SRR", SRR, 0, vp::Access::write_only, 0xF, "0xA resets the core"},
    {"SR", SR, 0, vp::Access::read_only, 0, "Bit 0: the MMCM is locked"},
    {"CCR0", CCR0, 0x00000101, vp::Access::read_write, 0x07FFFFFF,
     "Divisor of the input, multiplier, thousandths"},
    {"CCR1", CCR1, 0, vp::Access::read_write, 0xFFFFFFFF, "Phase of the feedback, stored"},
    CLK_WIZ_OUTPUT(0),
    CLK_WIZ_OUTPUT(1),
    CLK_WIZ_OUTPUT(2),
    CLK_WIZ_OUTPUT(3),
    CLK_WIZ_OUTPUT(4),
    CLK_WIZ_OUTPUT(5),
    CLK_WIZ_OUTPUT(6),
    {"CCR23", CCR23, 0, vp::Access::read_write, 0x3, "3 loads the factors"},
};

#undef CLK_WIZ_OUTPUT

}  // namespace clk_wiz

#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// Triple timer counter of the Zynq-7000's processing system (UG585 chapter 8 and appendix B.32):
/// three counters of 16 bits, their registers interleaved.
namespace ttc {

constexpr std::uint32_t ttc0_base = 0xF8001000, ttc1_base = 0xF8002000;
constexpr std::uint32_t ttc0_interrupt = 42, ttc1_interrupt = 69;  ///< of counter 0; 1 and 2 follow
constexpr unsigned counter_count = 3;
constexpr std::uint32_t counter_stride = 4;

// Offsets of counter 0; counter n is at + 4 · n.
constexpr std::uint32_t CLK_CTRL_1 = 0x00;
constexpr std::uint32_t CNT_CTRL_1 = 0x0C;
constexpr std::uint32_t CNT_VAL_1 = 0x18;
constexpr std::uint32_t INTERVAL_CNT_1 = 0x24;
constexpr std::uint32_t MATCH_1_CNT_1 = 0x30;
constexpr std::uint32_t MATCH_2_CNT_1 = 0x3C;
constexpr std::uint32_t MATCH_3_CNT_1 = 0x48;
constexpr std::uint32_t INT_STS_1 = 0x54;
constexpr std::uint32_t INT_EN_1 = 0x60;
constexpr std::uint32_t EVENT_CTRL_1 = 0x6C;
constexpr std::uint32_t EVENT_1 = 0x78;

/// Bits of CLK_CTRL.
namespace clk_ctrl {
constexpr std::uint32_t Prescale_En = 1u << 0;
constexpr unsigned Prescale_shift = 1;
constexpr std::uint32_t Prescale = 0xFu << Prescale_shift;
constexpr std::uint32_t Source = 1u << 5;
constexpr std::uint32_t Ext_Edge = 1u << 6;
}  // namespace clk_ctrl

/// Bits of CNT_CTRL.
namespace cnt_ctrl {
constexpr std::uint32_t DIS = 1u << 0;
constexpr std::uint32_t INT = 1u << 1;
constexpr std::uint32_t DEC = 1u << 2;
constexpr std::uint32_t Match = 1u << 3;
constexpr std::uint32_t RST = 1u << 4;
constexpr std::uint32_t Wave_en = 1u << 5;
constexpr std::uint32_t Wave_pol = 1u << 6;
}  // namespace cnt_ctrl

/// Bits of INT_STS and INT_EN.
namespace event {
constexpr std::uint32_t Interval = 1u << 0;
constexpr std::uint32_t Match_1 = 1u << 1;
constexpr std::uint32_t Match_2 = 1u << 2;
constexpr std::uint32_t Match_3 = 1u << 3;
constexpr std::uint32_t Overflow = 1u << 4;
constexpr std::uint32_t Ev = 1u << 5;
}  // namespace event

inline constexpr vp::RegisterField clk_ctrl_fields[] = {
    {"Prescale_En", clk_ctrl::Prescale_En, vp::Access::read_write, "1: the prescaler divides"},
    {"Prescale", clk_ctrl::Prescale, vp::Access::read_write, "it divides by 2 to the power N + 1"},
    {"Source", clk_ctrl::Source, vp::Access::read_write, "1: an external clock"},
    {"Ext_Edge", clk_ctrl::Ext_Edge, vp::Access::read_write, "1: its falling edges"},
};
inline constexpr vp::RegisterField cnt_ctrl_fields[] = {
    {"DIS", cnt_ctrl::DIS, vp::Access::read_write, "1: the counter stops"},
    {"INT", cnt_ctrl::INT, vp::Access::read_write, "1: counts to INTERVAL_CNT, 0: to 0xFFFF"},
    {"DEC", cnt_ctrl::DEC, vp::Access::read_write, "1: counts down"},
    {"Match", cnt_ctrl::Match, vp::Access::read_write, "1: matches are looked for"},
    {"RST", cnt_ctrl::RST, vp::Access::read_write, "1 starts again, and clears itself"},
    {"Wave_en", cnt_ctrl::Wave_en, vp::Access::read_write, "0: the waveform is put out"},
    {"Wave_pol", cnt_ctrl::Wave_pol, vp::Access::read_write,
     "0: rises at match 1, falls at the end; 1: the other way round"},
};

#define TTC_ROWS(n)                                                                       \
  {"CLK_CTRL_" #n,                                                                        \
   CLK_CTRL_1 + ((n)-1) * counter_stride,                                                 \
   0,                                                                                     \
   vp::Access::read_write,                                                                \
   0x7F,                                                                                  \
   "Clock of counter " #n,                                                                \
   clk_ctrl_fields},                                                                      \
      {"CNT_CTRL_" #n, CNT_CTRL_1 + ((n)-1) * counter_stride,                             \
       0x21,           vp::Access::read_write,                                            \
       0x7F,           "Control of counter " #n,                                          \
       cnt_ctrl_fields},                                                                  \
      {"CNT_VAL_" #n, CNT_VAL_1 + ((n)-1) * counter_stride, 0, vp::Access::read_only, 0,  \
       "Counter " #n},                                                                    \
      {"INTERVAL_CNT_" #n,                                                                \
       INTERVAL_CNT_1 + ((n)-1) * counter_stride,                                         \
       0,                                                                                 \
       vp::Access::read_write,                                                            \
       0xFFFF,                                                                            \
       "Last value of counter " #n " in interval mode"},                                  \
      {"MATCH_1_CNT_" #n,                                                                 \
       MATCH_1_CNT_1 + ((n)-1) * counter_stride,                                          \
       0,                                                                                 \
       vp::Access::read_write,                                                            \
       0xFFFF,                                                                            \
       "First match of counter " #n},                                                     \
      {"MATCH_2_CNT_" #n,                                                                 \
       MATCH_2_CNT_1 + ((n)-1) * counter_stride,                                          \
       0,                                                                                 \
       vp::Access::read_write,                                                            \
       0xFFFF,                                                                            \
       "Second match of counter " #n},                                                    \
      {"MATCH_3_CNT_" #n,                                                                 \
       MATCH_3_CNT_1 + ((n)-1) * counter_stride,                                          \
       0,                                                                                 \
       vp::Access::read_write,                                                            \
       0xFFFF,                                                                            \
       "Third match of counter " #n},                                                     \
      {"INT_STS_" #n,                                                                     \
       INT_STS_1 + ((n)-1) * counter_stride,                                              \
       0,                                                                                 \
       vp::Access::read_only,                                                             \
       0,                                                                                 \
       "Events of counter " #n "; a read clears them"},                                   \
      {"INT_EN_" #n, INT_EN_1 + ((n)-1) * counter_stride,      0, vp::Access::read_write, \
       0x3F,         "Events of counter " #n " that interrupt"},                          \
      {"EVENT_CTRL_" #n,                                                                  \
       EVENT_CTRL_1 + ((n)-1) * counter_stride,                                           \
       0,                                                                                 \
       vp::Access::read_write,                                                            \
       0x7,                                                                               \
       "Event timer of counter " #n ": not modelled"},                                    \
  {                                                                                       \
    "EVENT_" #n, EVENT_1 + ((n)-1) * counter_stride, 0, vp::Access::read_only, 0,         \
        "Length of the external event of counter " #n                                     \
  }

inline constexpr vp::RegisterInfo registers[] = {TTC_ROWS(1), TTC_ROWS(2), TTC_ROWS(3)};

#undef TTC_ROWS

}  // namespace ttc

#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// GPIO of the Zynq-7000's processing system (UG585 chapter 14 and appendix B.19): 54 pins of the
/// MIO and 64 of the EMIO in four banks, with one interrupt.
namespace ps_gpio {

constexpr std::uint32_t base = 0xE000A000;
constexpr std::uint32_t interrupt_id = 52;

constexpr unsigned bank_count = 4;
constexpr unsigned mio_pins = 54, emio_pins = 64, pin_count = mio_pins + emio_pins;
/// Pins of a bank: 31:0 and 53:32 of the MIO, 31:0 and 63:32 of the EMIO.
constexpr std::uint32_t bank_mask[bank_count] = {0xFFFFFFFF, 0x003FFFFF, 0xFFFFFFFF, 0xFFFFFFFF};
constexpr unsigned bank_first_pin[bank_count] = {0, 32, 54, 86};

// Offsets. Bank b has MASK_DATA at + 8 · b, DATA and DATA_RO at + 4 · b, the rest at + 0x40 · b.
constexpr std::uint32_t MASK_DATA_0_LSW = 0x000;
constexpr std::uint32_t MASK_DATA_0_MSW = 0x004;
constexpr std::uint32_t DATA_0 = 0x040;
constexpr std::uint32_t DATA_0_RO = 0x060;
constexpr std::uint32_t DIRM_0 = 0x204;
constexpr std::uint32_t OEN_0 = 0x208;
constexpr std::uint32_t INT_MASK_0 = 0x20C;
constexpr std::uint32_t INT_EN_0 = 0x210;
constexpr std::uint32_t INT_DIS_0 = 0x214;
constexpr std::uint32_t INT_STAT_0 = 0x218;
constexpr std::uint32_t INT_TYPE_0 = 0x21C;
constexpr std::uint32_t INT_POLARITY_0 = 0x220;
constexpr std::uint32_t INT_ANY_0 = 0x224;
constexpr std::uint32_t mask_data_stride = 8, data_stride = 4, bank_stride = 0x40;

/// The upper half of bank 1 has six pins.
inline constexpr vp::RegisterField short_mask_data_fields[] = {
    {"DATA", 0x0000003F, vp::Access::read_write, "output register of 6 pins"},
    {"MASK", 0x003F0000, vp::Access::write_only, "1: the write leaves that pin as it is"},
};
inline constexpr vp::RegisterField mask_data_fields[] = {
    {"DATA", 0x0000FFFF, vp::Access::read_write, "output register of 16 pins"},
    {"MASK", 0xFFFF0000, vp::Access::write_only, "1: the write leaves that pin as it is"},
};

#define PS_GPIO_DATA_ROWS(bank, most, upper, upper_fields)                             \
  {"MASK_DATA_" #bank "_LSW",                                                          \
   MASK_DATA_0_LSW + (bank)*mask_data_stride,                                          \
   0,                                                                                  \
   vp::Access::read_write,                                                             \
   0xFFFFFFFF,                                                                         \
   "Bank " #bank ": output register 15:0, with a mask",                                \
   mask_data_fields},                                                                  \
      {"MASK_DATA_" #bank "_MSW",                                                      \
       MASK_DATA_0_MSW + (bank)*mask_data_stride,                                      \
       0,                                                                              \
       vp::Access::read_write,                                                         \
       upper,                                                                          \
       "Bank " #bank ": output register 31:16, with a mask",                           \
       upper_fields},                                                                  \
      {"DATA_" #bank,                                                                  \
       DATA_0 + (bank)*data_stride,                                                    \
       0,                                                                              \
       vp::Access::read_write,                                                         \
       most,                                                                           \
       "Bank " #bank ": output register; EMIO pins that are inputs read their level"}, \
  {                                                                                    \
    "DATA_" #bank "_RO", DATA_0_RO + (bank)*data_stride, 0, vp::Access::read_only, 0,  \
        "Bank " #bank ": level of the pins"                                            \
  }

#define PS_GPIO_BANK_ROWS(bank, most)                                                  \
  {"DIRM_" #bank,                                                                      \
   DIRM_0 + (bank)*bank_stride,                                                        \
   0,                                                                                  \
   vp::Access::read_write,                                                             \
   most,                                                                               \
   "Bank " #bank ": 1 makes a pin an output"},                                         \
      {"OEN_" #bank,                                                                   \
       OEN_0 + (bank)*bank_stride,                                                     \
       0,                                                                              \
       vp::Access::read_write,                                                         \
       most,                                                                           \
       "Bank " #bank ": 1 drives an output, 0 leaves it high-impedance"},              \
      {"INT_MASK_" #bank,                                                              \
       INT_MASK_0 + (bank)*bank_stride,                                                \
       0,                                                                              \
       vp::Access::read_only,                                                          \
       0,                                                                              \
       "Bank " #bank ": 1 where the interrupt is masked"},                             \
      {"INT_EN_" #bank,                                                                \
       INT_EN_0 + (bank)*bank_stride,                                                  \
       0,                                                                              \
       vp::Access::write_only,                                                         \
       most,                                                                           \
       "Bank " #bank ": 1 enables an interrupt"},                                      \
      {"INT_DIS_" #bank,                                                               \
       INT_DIS_0 + (bank)*bank_stride,                                                 \
       0,                                                                              \
       vp::Access::write_only,                                                         \
       most,                                                                           \
       "Bank " #bank ": 1 masks an interrupt"},                                        \
      {"INT_STAT_" #bank,                                                              \
       INT_STAT_0 + (bank)*bank_stride,                                                \
       0,                                                                              \
       vp::Access::write_1_to_clear,                                                   \
       most,                                                                           \
       "Bank " #bank ": 1 where the event came, masked or not"},                       \
      {"INT_TYPE_" #bank,                                                              \
       INT_TYPE_0 + (bank)*bank_stride,                                                \
       most,                                                                           \
       vp::Access::read_write,                                                         \
       most,                                                                           \
       "Bank " #bank ": 1 for edges, 0 for levels"},                                   \
      {"INT_POLARITY_" #bank,                                                          \
       INT_POLARITY_0 + (bank)*bank_stride,                                            \
       0,                                                                              \
       vp::Access::read_write,                                                         \
       most,                                                                           \
       "Bank " #bank ": 1 for rising edges and high levels"},                          \
  {                                                                                    \
    "INT_ANY_" #bank, INT_ANY_0 + (bank)*bank_stride, 0, vp::Access::read_write, most, \
        "Bank " #bank ": 1 for both edges"                                             \
  }

inline constexpr vp::RegisterInfo registers[] = {
    PS_GPIO_DATA_ROWS(0, 0xFFFFFFFF, 0xFFFFFFFF, mask_data_fields),
    PS_GPIO_DATA_ROWS(1, 0x003FFFFF, 0x003F003F, short_mask_data_fields),
    PS_GPIO_DATA_ROWS(2, 0xFFFFFFFF, 0xFFFFFFFF, mask_data_fields),
    PS_GPIO_DATA_ROWS(3, 0xFFFFFFFF, 0xFFFFFFFF, mask_data_fields),
    PS_GPIO_BANK_ROWS(0, 0xFFFFFFFF),
    PS_GPIO_BANK_ROWS(1, 0x003FFFFF),
    PS_GPIO_BANK_ROWS(2, 0xFFFFFFFF),
    PS_GPIO_BANK_ROWS(3, 0xFFFFFFFF),
};

#undef PS_GPIO_DATA_ROWS
#undef PS_GPIO_BANK_ROWS

}  // namespace ps_gpio

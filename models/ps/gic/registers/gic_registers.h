#pragma once

#include <vp/register_description.h>

#include <cstdint>

/// The interrupt controller of the Cortex-A9 MPCore (PL390, GICv1) as a Zynq-7000 builds it (UG585
/// appendix B.24): 96 interrupts, 32 priorities, two CPUs. Names are those of the ARM and Xilinx
/// manuals. The list of registers is that of one CPU that runs in secure state, as after reset.
///
/// Checked against what others took from UG585 appendix B.24 and the Cortex-A9 MPCore TRM: ICDICTR,
/// ICDIIDR, ICCIIDR, ICDICFR0 to 5 and ICDIPTR0 to 7 (SkyEye's Zynq model; ICDICFR0 and 1 also by
/// the code of a self-test for the chip), the offsets of the status registers (driver scugic).
namespace gic {

/// Bus addresses on the Zynq-7000.
constexpr std::uint32_t cpu_interface_base = 0xF8F00100;
constexpr std::uint32_t distributor_base = 0xF8F01000;

/// Interrupt numbers.
constexpr unsigned id_count = 96;
constexpr unsigned sgi_count = 16;  ///< 0 … 15 are raised by software
constexpr unsigned first_spi = 32;  ///< 16 … 31 belong to one CPU, 32 … are shared
constexpr std::uint32_t global_timer_id = 27;
constexpr std::uint32_t n_fiq_id = 28;  ///< of the PL, active high at its pin: Core0_nFIQ
constexpr std::uint32_t private_timer_id = 29;
constexpr std::uint32_t watchdog_id = 30;
constexpr std::uint32_t n_irq_id = 31;      ///< of the PL, active high at its pin: Core0_nIRQ
constexpr std::uint32_t irq_f2p_0_id = 61;  ///< IRQ_F2P[0] … [7] are 61 … 68
constexpr std::uint32_t irq_f2p_8_id = 84;  ///< IRQ_F2P[8] … [15] are 84 … 91
constexpr unsigned irq_f2p_bits = 16;
constexpr std::uint32_t irq_f2p_id(unsigned bit) {
  return bit < 8 ? irq_f2p_0_id + bit : irq_f2p_8_id + (bit - 8);
}
/// The bit of IRQ_F2P that is interrupt `id`; irq_f2p_bits if none is.
constexpr unsigned irq_f2p_bit(std::uint32_t id) {
  unsigned bit = 0;
  while (bit < irq_f2p_bits && irq_f2p_id(bit) != id) ++bit;
  return bit;
}
constexpr std::uint32_t spurious_id = 1023;  ///< ICCIAR: nothing to acknowledge
constexpr std::uint32_t non_secure_id =
    1022;  ///< ICCIAR: only a non-secure interrupt, and AckCtl is 0

/// Priorities have 5 bits: the lower 3 of a byte read 0. 0 is the most urgent.
constexpr std::uint32_t priority_mask = 0xF8;

/// CPU interface: offsets from cpu_interface_base.
constexpr std::uint32_t ICCICR = 0x00;
constexpr std::uint32_t ICCPMR = 0x04;
constexpr std::uint32_t ICCBPR = 0x08;
constexpr std::uint32_t ICCIAR = 0x0C;
constexpr std::uint32_t ICCEOIR = 0x10;
constexpr std::uint32_t ICCRPR = 0x14;
constexpr std::uint32_t ICCHPIR = 0x18;
constexpr std::uint32_t ICCABPR = 0x1C;
constexpr std::uint32_t ICCIIDR = 0xFC;

/// Distributor: offsets from distributor_base. Registers that come in rows take their number.
constexpr std::uint32_t ICDDCR = 0x000;
constexpr std::uint32_t ICDICTR = 0x004;
constexpr std::uint32_t ICDIIDR = 0x008;
constexpr std::uint32_t ICDISR(unsigned n) {
  return 0x080 + 4 * n;
}  ///< 32 interrupts each
constexpr std::uint32_t ICDISER(unsigned n) {
  return 0x100 + 4 * n;
}  ///< 32 interrupts each
constexpr std::uint32_t ICDICER(unsigned n) {
  return 0x180 + 4 * n;
}  ///< 32 interrupts each
constexpr std::uint32_t ICDISPR(unsigned n) {
  return 0x200 + 4 * n;
}  ///< 32 interrupts each
constexpr std::uint32_t ICDICPR(unsigned n) {
  return 0x280 + 4 * n;
}  ///< 32 interrupts each
constexpr std::uint32_t ICDABR(unsigned n) {
  return 0x300 + 4 * n;
}  ///< 32 interrupts each
constexpr std::uint32_t ICDIPR(unsigned n) {
  return 0x400 + 4 * n;
}  ///< 4 interrupts each
constexpr std::uint32_t ICDIPTR(unsigned n) {
  return 0x800 + 4 * n;
}  ///< 4 interrupts each
constexpr std::uint32_t ICDICFR(unsigned n) {
  return 0xC00 + 4 * n;
}  ///< 16 interrupts each
constexpr std::uint32_t PPI_STATUS = 0xD00;
constexpr std::uint32_t SPI_STATUS(unsigned n) {
  return 0xD04 + 4 * n;
}  ///< 32 interrupts each, from 32 on
constexpr std::uint32_t ICDSGIR = 0xF00;
constexpr std::uint32_t ICPIDR(unsigned n) {
  return n < 4 ? 0xFE0 + 4 * n : 0xFC0 + 4 * n;
}
constexpr std::uint32_t ICCIDR(unsigned n) {
  return 0xFF0 + 4 * n;
}

/// How many registers a row has.
constexpr unsigned bit_registers = id_count / 32;    ///< ICDISR … ICDABR
constexpr unsigned byte_registers = id_count / 4;    ///< ICDIPR, ICDIPTR
constexpr unsigned sense_registers = id_count / 16;  ///< ICDICFR

/// Bits of ICCICR.
namespace iccicr {
constexpr std::uint32_t EnableS = 1u << 0;   ///< secure interrupts reach the CPU
constexpr std::uint32_t EnableNS = 1u << 1;  ///< non-secure interrupts reach the CPU
constexpr std::uint32_t AckCtl =
    1u << 2;  ///< a secure read of ICCIAR may acknowledge a non-secure interrupt
constexpr std::uint32_t FIQEn = 1u << 3;  ///< secure interrupts use nFIQ
constexpr std::uint32_t SBPR = 1u << 4;   ///< ICCBPR serves non-secure interrupts too
constexpr std::uint32_t all = 0x1F;
}  // namespace iccicr

/// Fields of ICCIAR, ICCEOIR and ICCHPIR.
namespace icciar {
constexpr std::uint32_t ACKINTID = 0x3FF;
constexpr unsigned CPUID_shift = 10;
constexpr std::uint32_t CPUID = 7u << CPUID_shift;  ///< the CPU that raised a software interrupt
}  // namespace icciar

/// Bits of ICDDCR.
namespace icddcr {
constexpr std::uint32_t EnableS = 1u << 0;
constexpr std::uint32_t EnableNS = 1u << 1;
}  // namespace icddcr

/// Values of the two bits that an interrupt has in ICDICFR.
namespace icdicfr {
constexpr std::uint32_t level_high = 1;
constexpr std::uint32_t rising_edge = 3;
}  // namespace icdicfr

/// Fields of ICDSGIR.
namespace icdsgir {
constexpr std::uint32_t SGIINTID = 0xF;
constexpr std::uint32_t SATT = 1u << 15;
constexpr unsigned CPUTargetList_shift = 16;
constexpr std::uint32_t CPUTargetList = 0xFFu << CPUTargetList_shift;
constexpr unsigned TargetListFilter_shift = 24;
constexpr std::uint32_t TargetListFilter = 3u << TargetListFilter_shift;
constexpr std::uint32_t filter_list = 0;    ///< the CPUs of CPUTargetList
constexpr std::uint32_t filter_others = 1;  ///< all but the one that writes
constexpr std::uint32_t filter_self = 2;    ///< the one that writes
}  // namespace icdsgir

inline constexpr vp::RegisterField iccicr_fields[] = {
    {"EnableS", iccicr::EnableS, vp::Access::read_write, "1: secure interrupts reach the CPU"},
    {"EnableNS", iccicr::EnableNS, vp::Access::read_write,
     "1: non-secure interrupts reach the CPU"},
    {"AckCtl", iccicr::AckCtl, vp::Access::read_write,
     "1: a secure read of ICCIAR may acknowledge a non-secure interrupt"},
    {"FIQEn", iccicr::FIQEn, vp::Access::read_write, "1: secure interrupts use nFIQ"},
    {"SBPR", iccicr::SBPR, vp::Access::read_write, "1: ICCBPR serves non-secure interrupts, too"},
};
inline constexpr vp::RegisterField icciar_fields[] = {
    {"ACKINTID", icciar::ACKINTID, vp::Access::read_only,
     "number; 1023 nothing, 1022 only a non-secure one, and AckCtl is 0"},
    {"CPUID", icciar::CPUID, vp::Access::read_only, "the CPU that raised a software interrupt"},
};
inline constexpr vp::RegisterField icceoir_fields[] = {
    {"EOIINTID", 0x03FF, vp::Access::write_only, "number that ICCIAR gave"},
    {"CPUID", 0x1C00, vp::Access::write_only, "CPU that ICCIAR gave"},
};
inline constexpr vp::RegisterField icciidr_fields[] = {
    {"Implementer", 0xFFF, vp::Access::read_only, "0x43B: ARM"},
    {"Revision", 0xF000, vp::Access::read_only, "of the controller"},
    {"Architecture", 0xF0000, vp::Access::read_only, "1: GICv1"},
    {"Part_number", 0xFFF00000, vp::Access::read_only, "0x390"},
};
inline constexpr vp::RegisterField icddcr_fields[] = {
    {"EnableS", icddcr::EnableS, vp::Access::read_write, "1: secure interrupts are forwarded"},
    {"EnableNS", icddcr::EnableNS, vp::Access::read_write,
     "1: non-secure interrupts are forwarded"},
};
inline constexpr vp::RegisterField icdictr_fields[] = {
    {"IT_Lines_Number", 0x1F, vp::Access::read_only, "2: 32 * (2 + 1) interrupts"},
    {"CPU_Number", 0xE0, vp::Access::read_only, "1: two CPUs"},
    {"SecurityExtn", 0x400, vp::Access::read_only, "1: two security domains"},
    {"LSPI", 0xF800, vp::Access::read_only, "31 shared interrupts can be locked"},
};
inline constexpr vp::RegisterField icdiidr_fields[] = {
    {"Implementer", 0xFFF, vp::Access::read_only, "0x43B: ARM"},
    {"Revision", 0xFFF000, vp::Access::read_only, "0x020"},
    {"Version", 0xFF000000, vp::Access::read_only, "1"},
};
inline constexpr vp::RegisterField enable_fields[] = {
    {"SGI", 0x0000FFFF, vp::Access::read_only, "software interrupts are always enabled"},
    {"PPI", 0xFFFF0000, vp::Access::write_1_to_set, "private interrupts, a bit each"},
};
inline constexpr vp::RegisterField disable_fields[] = {
    {"SGI", 0x0000FFFF, vp::Access::read_only, "software interrupts are always enabled"},
    {"PPI", 0xFFFF0000, vp::Access::write_1_to_clear, "private interrupts, a bit each"},
};
inline constexpr vp::RegisterField icdipr_fields[] = {
    {"Priority_0", 0xF8, vp::Access::read_write, "of interrupt 4 n; 0 is the most urgent"},
    {"Priority_1", 0xF800, vp::Access::read_write, "of interrupt 4 n + 1"},
    {"Priority_2", 0xF80000, vp::Access::read_write, "of interrupt 4 n + 2"},
    {"Priority_3", 0xF8000000, vp::Access::read_write, "of interrupt 4 n + 3"},
};
inline constexpr vp::RegisterField icdiptr_fields[] = {
    {"Targets_0", 0x3, vp::Access::read_write, "of interrupt 4 n: bit 0 CPU 0, bit 1 CPU 1"},
    {"Targets_1", 0x300, vp::Access::read_write, "of interrupt 4 n + 1"},
    {"Targets_2", 0x30000, vp::Access::read_write, "of interrupt 4 n + 2"},
    {"Targets_3", 0x3000000, vp::Access::read_write, "of interrupt 4 n + 3"},
};
inline constexpr vp::RegisterField icdicfr_fields[] = {
    {"N_N", 0x55555555, vp::Access::read_only, "always 1: any CPU may handle it"},
    {"Edge", 0xAAAAAAAA, vp::Access::read_write,
     "bit 2 m + 1 of interrupt 16 n + m: 0 level high, 1 rising edge"},
};
inline constexpr vp::RegisterField ppi_status_fields[] = {
    {"Global_timer", 1u << 11, vp::Access::read_only, "level of interrupt 27"},
    {"nFIQ", 1u << 12, vp::Access::read_only, "level of interrupt 28: not wired"},
    {"Private_timer", 1u << 13, vp::Access::read_only, "level of interrupt 29"},
    {"Watchdog", 1u << 14, vp::Access::read_only, "level of interrupt 30"},
    {"nIRQ", 1u << 15, vp::Access::read_only, "level of interrupt 31: not wired"},
};
inline constexpr vp::RegisterField icdsgir_fields[] = {
    {"SGIINTID", icdsgir::SGIINTID, vp::Access::write_only, "number"},
    {"SATT", icdsgir::SATT, vp::Access::write_only, "security: no effect here"},
    {"CPUTargetList", icdsgir::CPUTargetList, vp::Access::write_only, "a bit for each CPU"},
    {"TargetListFilter", icdsgir::TargetListFilter, vp::Access::write_only,
     "0 those of the list, 1 all others, 2 only this CPU"},
};

inline constexpr vp::RegisterInfo cpu_interface_registers[] = {
    {"ICCICR", ICCICR, 0x00000000, vp::Access::read_write, 0x0000001F, "CPU interface control",
     iccicr_fields},
    {"ICCPMR", ICCPMR, 0x00000000, vp::Access::read_write, 0x000000F8,
     "Priority mask: only interrupts more urgent than this reach the CPU"},
    {"ICCBPR", ICCBPR, 0x00000002, vp::Access::read_write, 0x00000007,
     "Binary point: bits above it decide about preemption (at least 2)"},
    {"ICCIAR", ICCIAR, 0x000003FF, vp::Access::read_only, 0x00000000,
     "Acknowledge: reading makes the most urgent pending interrupt active", icciar_fields},
    {"ICCEOIR", ICCEOIR, 0x00000000, vp::Access::write_only, 0x00001FFF,
     "End of interrupt: write the value read from ICCIAR", icceoir_fields},
    {"ICCRPR", ICCRPR, 0x000000FF, vp::Access::read_only, 0x00000000,
     "Priority of the active interrupt; 0xFF when idle"},
    {"ICCHPIR", ICCHPIR, 0x000003FF, vp::Access::read_only, 0x00000000,
     "The most urgent pending interrupt, without acknowledging it", icciar_fields},
    {"ICCABPR", ICCABPR, 0x00000003, vp::Access::read_write, 0x00000007,
     "Binary point of non-secure interrupts (at least 3)"},
    {"ICCIIDR", ICCIIDR, 0x3901243B, vp::Access::read_only, 0x00000000, "Implementer and revision",
     icciidr_fields},
};

#define GIC_ROW_3(name, ...)                                              \
  {#name "0", name(0), __VA_ARGS__}, {#name "1", name(1), __VA_ARGS__}, { \
#name "2", name(2), __VA_ARGS__                                       \
  }
#define GIC_SPI_BYTES(name, ...)                                                \
  {#name "8", name(8), __VA_ARGS__}, {#name "9", name(9), __VA_ARGS__},         \
      {#name "10", name(10), __VA_ARGS__}, {#name "11", name(11), __VA_ARGS__}, \
      {#name "12", name(12), __VA_ARGS__}, {#name "13", name(13), __VA_ARGS__}, \
      {#name "14", name(14), __VA_ARGS__}, {#name "15", name(15), __VA_ARGS__}, \
      {#name "16", name(16), __VA_ARGS__}, {#name "17", name(17), __VA_ARGS__}, \
      {#name "18", name(18), __VA_ARGS__}, {#name "19", name(19), __VA_ARGS__}, \
      {#name "20", name(20), __VA_ARGS__}, {#name "21", name(21), __VA_ARGS__}, \
      {#name "22", name(22), __VA_ARGS__}, {                                    \
#name "23", name(23), __VA_ARGS__                                           \
  }
#define GIC_PRIVATE_BYTES(name, ...)                                        \
  {#name "0", name(0), __VA_ARGS__}, {#name "1", name(1), __VA_ARGS__},     \
      {#name "2", name(2), __VA_ARGS__}, {#name "3", name(3), __VA_ARGS__}, \
      {#name "4", name(4), __VA_ARGS__}, {#name "5", name(5), __VA_ARGS__}, \
      {#name "6", name(6), __VA_ARGS__}, {                                  \
#name "7", name(7), __VA_ARGS__                                         \
  }

// There are no interrupts 16 to 26: neither target nor sensitivity (UG585 appendix B.24).
#define GIC_TARGET_ROW(n, reset, text) \
  { "ICDIPTR" #n, ICDIPTR(n), reset, vp::Access::read_only, 0x00000000, text }
#define GIC_PRIVATE_TARGETS(text)                                               \
  GIC_TARGET_ROW(0, 0x01010101, text), GIC_TARGET_ROW(1, 0x01010101, text),     \
      GIC_TARGET_ROW(2, 0x01010101, text), GIC_TARGET_ROW(3, 0x01010101, text), \
      GIC_TARGET_ROW(4, 0x00000000, text), GIC_TARGET_ROW(5, 0x00000000, text), \
      GIC_TARGET_ROW(6, 0x01000000, text), GIC_TARGET_ROW(7, 0x01010101, text)

inline constexpr vp::RegisterInfo distributor_registers[] = {
    {"ICDDCR", ICDDCR, 0x00000000, vp::Access::read_write, 0x00000003, "Distributor control",
     icddcr_fields},
    {"ICDICTR", ICDICTR, 0x0000FC22, vp::Access::read_only, 0x00000000,
     "What was built: 96 interrupts, 2 CPUs, security, 31 lockable", icdictr_fields},
    {"ICDIIDR", ICDIIDR, 0x0102043B, vp::Access::read_only, 0x00000000, "Implementer and revision",
     icdiidr_fields},
    GIC_ROW_3(ICDISR, 0x00000000, vp::Access::read_write, 0xFFFFFFFF,
              "Security: 1 is non-secure; 32 interrupts"),
    {"ICDISER0", ICDISER(0), 0x0000FFFF, vp::Access::write_1_to_set, 0xFFFF0000,
     "Enable: writing 1 sets; software interrupts are always enabled", enable_fields},
    {"ICDISER1", ICDISER(1), 0x00000000, vp::Access::write_1_to_set, 0xFFFFFFFF,
     "Enable: writing 1 sets"},
    {"ICDISER2", ICDISER(2), 0x00000000, vp::Access::write_1_to_set, 0xFFFFFFFF,
     "Enable: writing 1 sets"},
    {"ICDICER0", ICDICER(0), 0x0000FFFF, vp::Access::write_1_to_clear, 0xFFFF0000,
     "Enable: writing 1 clears", disable_fields},
    {"ICDICER1", ICDICER(1), 0x00000000, vp::Access::write_1_to_clear, 0xFFFFFFFF,
     "Enable: writing 1 clears"},
    {"ICDICER2", ICDICER(2), 0x00000000, vp::Access::write_1_to_clear, 0xFFFFFFFF,
     "Enable: writing 1 clears"},
    {"ICDISPR0", ICDISPR(0), 0x00000000, vp::Access::write_1_to_set, 0xFFFF0000,
     "Pending: writing 1 sets; software interrupts are raised by ICDSGIR"},
    {"ICDISPR1", ICDISPR(1), 0x00000000, vp::Access::write_1_to_set, 0xFFFFFFFF,
     "Pending: writing 1 sets"},
    {"ICDISPR2", ICDISPR(2), 0x00000000, vp::Access::write_1_to_set, 0xFFFFFFFF,
     "Pending: writing 1 sets"},
    {"ICDICPR0", ICDICPR(0), 0x00000000, vp::Access::write_1_to_clear, 0xFFFF0000,
     "Pending: writing 1 clears; software interrupts end by acknowledge"},
    {"ICDICPR1", ICDICPR(1), 0x00000000, vp::Access::write_1_to_clear, 0xFFFFFFFF,
     "Pending: writing 1 clears"},
    {"ICDICPR2", ICDICPR(2), 0x00000000, vp::Access::write_1_to_clear, 0xFFFFFFFF,
     "Pending: writing 1 clears"},
    GIC_ROW_3(ICDABR, 0x00000000, vp::Access::read_only, 0x00000000, "Active: 32 interrupts"),
    GIC_PRIVATE_BYTES(ICDIPR, 0x00000000, vp::Access::read_write, 0xF8F8F8F8,
                      "Priority, a byte per interrupt", icdipr_fields),
    GIC_SPI_BYTES(ICDIPR, 0x00000000, vp::Access::read_write, 0xF8F8F8F8,
                  "Priority, a byte per interrupt", icdipr_fields),
    GIC_PRIVATE_TARGETS("Target of private interrupts: the CPU that reads; 0 if not implemented"),
    GIC_SPI_BYTES(ICDIPTR, 0x00000000, vp::Access::read_write, 0x03030303,
                  "Targets, a byte per interrupt, a bit per CPU", icdiptr_fields),
    {"ICDICFR0", ICDICFR(0), 0xAAAAAAAA, vp::Access::read_only, 0x00000000,
     "Sensitivity of software interrupts: edge"},
    {"ICDICFR1", ICDICFR(1), 0x7DC00000, vp::Access::read_only, 0x00000000,
     "Sensitivity of private interrupts"},
    {"ICDICFR2", ICDICFR(2), 0x55555555, vp::Access::read_write, 0xAAAAAAAA,
     "Sensitivity, 2 bits per interrupt: 01 level high, 11 rising edge", icdicfr_fields},
    {"ICDICFR3", ICDICFR(3), 0x55555555, vp::Access::read_write, 0xAAAAAAAA,
     "Sensitivity, 2 bits per interrupt: 01 level high, 11 rising edge", icdicfr_fields},
    {"ICDICFR4", ICDICFR(4), 0x55555555, vp::Access::read_write, 0xAAAAAAAA,
     "Sensitivity, 2 bits per interrupt: 01 level high, 11 rising edge", icdicfr_fields},
    {"ICDICFR5", ICDICFR(5), 0x55555555, vp::Access::read_write, 0xAAAAAAAA,
     "Sensitivity, 2 bits per interrupt: 01 level high, 11 rising edge", icdicfr_fields},
    {"PPI_STATUS", PPI_STATUS, 0x00000000, vp::Access::read_only, 0x00000000,
     "Levels of the inputs of private interrupts, bit n of interrupt 16 + n", ppi_status_fields},
    {"SPI_STATUS0", SPI_STATUS(0), 0x00000000, vp::Access::read_only, 0x00000000,
     "Levels of the inputs of shared interrupts 32 to 63"},
    {"SPI_STATUS1", SPI_STATUS(1), 0x00000000, vp::Access::read_only, 0x00000000,
     "Levels of the inputs of shared interrupts 64 to 95"},
    {"ICDSGIR", ICDSGIR, 0x00000000, vp::Access::write_only, 0x03FF800F,
     "Raises a software interrupt", icdsgir_fields},
    {"ICPIDR4", ICPIDR(4), 0x00000004, vp::Access::read_only, 0x00000000, "Peripheral id 4"},
    {"ICPIDR5", ICPIDR(5), 0x00000000, vp::Access::read_only, 0x00000000, "Peripheral id 5"},
    {"ICPIDR6", ICPIDR(6), 0x00000000, vp::Access::read_only, 0x00000000, "Peripheral id 6"},
    {"ICPIDR7", ICPIDR(7), 0x00000000, vp::Access::read_only, 0x00000000, "Peripheral id 7"},
    {"ICPIDR0", ICPIDR(0), 0x00000090, vp::Access::read_only, 0x00000000, "Peripheral id 0"},
    {"ICPIDR1", ICPIDR(1), 0x000000B3, vp::Access::read_only, 0x00000000, "Peripheral id 1"},
    {"ICPIDR2", ICPIDR(2), 0x0000001B, vp::Access::read_only, 0x00000000, "Peripheral id 2"},
    {"ICPIDR3", ICPIDR(3), 0x00000000, vp::Access::read_only, 0x00000000, "Peripheral id 3"},
    {"ICCIDR0", ICCIDR(0), 0x0000000D, vp::Access::read_only, 0x00000000, "Component id 0"},
    {"ICCIDR1", ICCIDR(1), 0x000000F0, vp::Access::read_only, 0x00000000, "Component id 1"},
    {"ICCIDR2", ICCIDR(2), 0x00000005, vp::Access::read_only, 0x00000000, "Component id 2"},
    {"ICCIDR3", ICCIDR(3), 0x000000B1, vp::Access::read_only, 0x00000000, "Component id 3"},
};

#undef GIC_ROW_3
#undef GIC_SPI_BYTES
#undef GIC_PRIVATE_BYTES
#undef GIC_PRIVATE_TARGETS
#undef GIC_TARGET_ROW

}  // namespace gic

#ifndef XIL_IO_H
#define XIL_IO_H

/*
 * Reads and writes by address. From 0x4000_0000 on are registers (UG585 table 4-1), reached
 * through the HAL; below, and on the virtual platform above 4 GiB, is memory, reached by pointer.
 * The HAL has 32-bit accesses only: a narrower write to a register reads the word first, which
 * matters where reading has a side effect.
 */

#include <hal/hal.h>
#include <xil_printf.h>
#include <xil_types.h>
#include <xpseudo_asm.h>
#include <xstatus.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SYNCHRONIZE_IO dmb()
#define DATA_SYNC dsb()
#define INST_SYNC isb()

static inline bool markervp_is_register(UINTPTR address) {
  return address >= 0x40000000U && address <= 0xFFFFFFFFU;
}

static inline u32 Xil_In32(UINTPTR Addr) {
  if (markervp_is_register(Addr)) return hal_read32((uint32_t)Addr);
  return *(const volatile u32*)Addr;
}

static inline void Xil_Out32(UINTPTR Addr, u32 Value) {
  if (markervp_is_register(Addr)) {
    hal_write32((uint32_t)Addr, Value);
  } else {
    *(volatile u32*)Addr = Value;
  }
}

static inline u16 Xil_In16(UINTPTR Addr) {
  if (!markervp_is_register(Addr)) return *(const volatile u16*)Addr;
  return (u16)(hal_read32((uint32_t)Addr & ~3U) >> ((Addr & 2U) * 8U));
}

static inline u8 Xil_In8(UINTPTR Addr) {
  if (!markervp_is_register(Addr)) return *(const volatile u8*)Addr;
  return (u8)(hal_read32((uint32_t)Addr & ~3U) >> ((Addr & 3U) * 8U));
}

static inline u64 Xil_In64(UINTPTR Addr) {
  const u64 low = Xil_In32(Addr);
  return (u64)Xil_In32(Addr + 4U) << 32 | low;
}

static inline void Xil_Out16(UINTPTR Addr, u16 Value) {
  if (markervp_is_register(Addr)) {
    const u32 shift = (Addr & 2U) * 8U;
    const uint32_t word = (uint32_t)Addr & ~3U;
    hal_write32(word, (hal_read32(word) & ~(0xFFFFU << shift)) | (u32)Value << shift);
  } else {
    *(volatile u16*)Addr = Value;
  }
}

static inline void Xil_Out8(UINTPTR Addr, u8 Value) {
  if (markervp_is_register(Addr)) {
    const u32 shift = (Addr & 3U) * 8U;
    const uint32_t word = (uint32_t)Addr & ~3U;
    hal_write32(word, (hal_read32(word) & ~(0xFFU << shift)) | (u32)Value << shift);
  } else {
    *(volatile u8*)Addr = Value;
  }
}

static inline u16 Xil_EndianSwap16(u16 Data) {
  return __builtin_bswap16(Data);
}
static inline u32 Xil_EndianSwap32(u32 Data) {
  return __builtin_bswap32(Data);
}

/* The chip is little endian. */
#define Xil_In16LE Xil_In16
#define Xil_In32LE Xil_In32
#define Xil_Out16LE Xil_Out16
#define Xil_Out32LE Xil_Out32
#define Xil_In16BE(Addr) Xil_EndianSwap16(Xil_In16(Addr))
#define Xil_In32BE(Addr) Xil_EndianSwap32(Xil_In32(Addr))
#define Xil_Out16BE(Addr, Value) Xil_Out16((Addr), Xil_EndianSwap16(Value))
#define Xil_Out32BE(Addr, Value) Xil_Out32((Addr), Xil_EndianSwap32(Value))
#define Xil_Htonl Xil_EndianSwap32
#define Xil_Htons Xil_EndianSwap16
#define Xil_Ntohl Xil_EndianSwap32
#define Xil_Ntohs Xil_EndianSwap16

static inline void Xil_Out64(UINTPTR Addr, u64 Value) {
  Xil_Out32(Addr, (u32)Value);
  Xil_Out32(Addr + 4U, (u32)(Value >> 32));
}

#ifdef __cplusplus
}
#endif

#endif

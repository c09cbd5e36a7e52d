#pragma once

#include <cstdint>

/// The second-level cache controller of the Zynq-7000 (ARM PL310 r3p2, UG585 appendix B.25).
namespace chip::pl310 {

inline constexpr std::uint32_t base = 0xF8F0'2000;

inline constexpr std::uint32_t control = base + 0x100;
inline constexpr std::uint32_t auxiliary_control = base + 0x104;
inline constexpr std::uint32_t tag_latency = base + 0x108;
inline constexpr std::uint32_t data_latency = base + 0x10C;
inline constexpr std::uint32_t interrupt_clear = base + 0x220;
inline constexpr std::uint32_t cache_sync = base + 0x730;
inline constexpr std::uint32_t invalidate_line = base + 0x770;
inline constexpr std::uint32_t invalidate_ways = base + 0x77C;
inline constexpr std::uint32_t clean_line = base + 0x7B0;
inline constexpr std::uint32_t clean_invalidate_line = base + 0x7F0;

inline constexpr std::uint32_t all_ways = 0xFF;  ///< 8 of them, 512 KiB together

}  // namespace chip::pl310

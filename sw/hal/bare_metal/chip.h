#pragma once

#include <cstdint>

namespace chip {

inline constexpr int input_exit_code = 2;  ///< an option of the build does not fit the program
inline constexpr int fault_exit_code = 3;  ///< as on the virtual platform

/// The program is over: says so on the console, tells a debugger, and sleeps for good.
[[noreturn]] void end(int exit_code);

/// Checks the options given to the build against those of the program; ends it if one does not fit.
void check_options();

/// A register at a bus address, for the parts of the HAL that may not call it.
inline volatile std::uint32_t& device_register(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

inline void barrier() {
  asm volatile("dsb" ::: "memory");
}

inline constexpr std::uint32_t cache_line = 32;

/// Messages of the HAL itself, straight to the console.
void print(const char* text);
void print_number(std::uint32_t value);
void print_hexadecimal(std::uint32_t value);  ///< 0x and 8 digits

/// Starts the console.
void initialise_console();

/// Waits until the console has sent everything.
void drain_console();

/// An option that the build sets to another value than its default.
struct OptionOverride {
  const char* program;
  const char* option;
  double value;
};

/// Written by CMake from MARKERVP_CHIP_OPTIONS; ends with a nullptr.
extern const OptionOverride option_overrides[];

}  // namespace chip

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

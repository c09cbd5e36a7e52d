#pragma once

#include <hal/hal.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// A HAL for tests: registers are a map with hooks, interrupts run at HAL calls, everything is
/// recorded.
namespace fake_hal {

struct Access {
  bool write;
  std::uint32_t address;
  std::uint32_t value;

  bool operator==(const Access& other) const {
    return write == other.write && address == other.address && value == other.value;
  }
};

struct Publication {
  std::uint32_t kind;
  std::vector<std::uint8_t> data;
};

struct State {
  // Registers: the hook if there is one, else what was written last (0 before).
  std::map<std::uint32_t, std::uint32_t> registers;
  std::map<std::uint32_t, std::function<std::uint32_t()>> on_read;
  std::map<std::uint32_t, std::function<void(std::uint32_t)>> on_write;
  std::vector<Access> accesses;
  bool record_accesses = true;

  // Interrupts.
  hal_interrupt_handler handler = nullptr;
  void* handler_context = nullptr;
  bool enabled = false;
  std::function<bool()> interrupt_pending = [] { return false; };
  std::function<void()> on_idle = [] {};  ///< called when the program sleeps and nothing is pending
  std::uint64_t sleeps = 0;

  // Memory.
  std::uint32_t next_bus_address = 0x1000'0000;
  std::map<std::uint32_t, std::vector<std::uint8_t>> buffers;  ///< by bus address
  bool out_of_memory = false;
  std::vector<std::pair<const void*, std::size_t>> flushed, invalidated;
  std::vector<hal_cache_whole> whole_cache_operations;

  // Test bench.
  std::vector<hal_frame> frames;
  std::size_t next_frame = 0;
  std::map<std::uint32_t, double> options;           ///< by number; the rest are 0
  std::map<std::uint32_t, std::string> option_data;  ///< of options that name a file
  std::map<std::string, std::uint32_t> xparameters;  ///< where the design differs from the header
  std::vector<Publication> publications;
  std::string console;
  std::vector<std::string> warnings;  ///< of drivers

  // Annotations.
  std::map<std::uint32_t, std::uint64_t> work;
  std::vector<std::uint32_t> function_stack;
  std::map<std::uint32_t, std::uint64_t> function_calls;
};

/// The one state; `reset` makes it new.
State& state();
void reset();

/// The byte of DMA memory at a bus address; throws std::out_of_range if missing.
std::uint8_t& memory(std::uint32_t bus_address);

/// All values written to `address`, in order.
std::vector<std::uint32_t> writes_to(std::uint32_t address);

}  // namespace fake_hal

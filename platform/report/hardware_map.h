#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform::report {

/// What software sees of the platform: addresses, registers, interrupts, clocks.
struct HardwareMap {
  /// Some bits of a register.
  struct Field {
    std::string name;
    std::uint32_t mask = 0;
    std::string access;
    std::uint32_t reset = 0;  ///< of this build, shifted down
    std::string documentation;
  };
  struct Register {
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t declared_reset = 0;  ///< of the full build
    std::uint32_t reset = 0;           ///< of this build
    bool built = true;                 ///< false: reads 0, ignores writes
    std::uint32_t at_start = 0;        ///< when the program starts: boot code has run
    std::string access;                ///< "rw", "ro", "wo", "w1c", "w1s", "w1t"
    std::uint32_t writable = 0;        ///< bits that a write can change
    std::string documentation;
    std::vector<Field> fields = {};        ///< from the lowest bit on; none: all bits are alike
    const void* fields_of_kind = nullptr;  ///< the same for registers with the same fields
  };
  /// A range of addresses of the processor.
  struct Device {
    std::string name;  ///< "axi_gpio_0"
    std::string what;  ///< "AXI GPIO (PG144)"
    std::string path;  ///< of its registers or memory in the platform: "pl.axi_gpio_0.s_axi"
    std::uint64_t base = 0;
    std::uint64_t size = 0;
    std::string way;                    ///< through what the processor reaches it: "m_axi_gp0"
    std::vector<Register> registers;    ///< none: memory
    const void* description = nullptr;  ///< the same for devices of one kind
  };
  struct Interrupt {
    std::uint32_t id = 0;
    std::string source;
  };
  struct Clock {
    std::string name;
    std::uint64_t hertz = 0;       ///< at the start
    std::string set_by;            ///< register; empty: not software
    std::uint64_t programmed = 0;  ///< what that register gives, Hz
  };

  std::vector<Device> devices;  ///< by address
  std::vector<Interrupt> interrupts;
  std::vector<Clock> clocks;
  std::string xparameters = {};  ///< the text of xparameters.h
};

}  // namespace platform::report

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace ps {

/// What a program reaches at an address.
struct Answerer {
  std::string name;         ///< for messages; empty: nothing is there
  bool is_modelled = true;  ///< false: the chip has a block there, and the platform has none
};

/// What lies around a core, for its messages, and for what it does behind main(). Unless set:
/// nothing is known of it.
struct Surroundings {
  /// Why nIRQ is low: the interrupt, and since when its line asks for it.
  struct Request {
    std::string text;
    std::uint64_t since_ps = 0;
  };
  struct Wait {
    bool irq_masked;
    std::optional<std::uint32_t> polled;  ///< address of the register that it looks at
    bool only_stopped = false;            ///< no more than which interrupt is stopped on its way
  };

  /// Names the device at an address.
  std::function<Answerer(std::uint32_t)> device = [](std::uint32_t) { return Answerer{}; };
  /// Describes a register's value, "axi_dma_0.MM2S_DMASR: 0x00000002 (Idle 1)".
  std::function<std::string(std::uint32_t address, std::uint32_t value)> register_text = plain_text;
  std::function<Request()> request = [] { return Request{}; };
  /// Says what keeps the program waiting, as the end of a message ("; interrupt 61 …"), or "".
  std::function<std::string(const Wait&)> wait_reason = [](const Wait&) { return std::string(); };
  /// Whether an interrupt of a device is enabled that would come to the core.
  std::function<bool()> any_interrupt = [] { return false; };

  /// " (name)" for messages; empty if nothing is there.
  std::string name_at(std::uint32_t address) const;

  /// "0x40400004: 0x00000002"
  static std::string plain_text(std::uint32_t address, std::uint32_t value);
};

}  // namespace ps

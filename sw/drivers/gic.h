#pragma once

#include <gic_registers.h>
#include <hal/hal.h>

#include <array>
#include <cstdint>

namespace drivers {

enum class Trigger : std::uint8_t { level_high, rising_edge };

/// The Cortex-A9 MPCore's interrupt controller (PL390) as one core uses it. The second core has an
/// object of its own.
class Gic {
 public:
  /// All interrupts off, priority 0xA0, shared ones to CPU 0, level sensitive; then controller and
  /// CPU interface on, and the dispatcher connected to the IRQ exception.
  void initialise();

  /// The same on the second core, after the first: only what each core has for itself. Shared
  /// interrupts still go to CPU 0.
  void initialise_second();

  /// Sets handler and sensitivity of interrupt `id` and enables it. False if there is no such
  /// interrupt.
  bool connect(std::uint32_t id, Trigger trigger, hal_interrupt_handler handler, void* context);

  /// Disables interrupt `id` and forgets its handler.
  void disconnect(std::uint32_t id);

  /// Raises software interrupt `id` (0 to 15) at the cores of `cpus`, a bit for each.
  static void raise(std::uint32_t id, std::uint32_t cpus);

  /// Interrupts that came without a handler.
  std::uint32_t unhandled() const { return unhandled_; }

  static constexpr std::uint8_t default_priority = 0xA0;  ///< as the vendor's driver
  static constexpr std::uint8_t priority_mask = 0xF0;     ///< as the vendor's driver

 private:
  struct Entry {
    hal_interrupt_handler handler;
    void* context;
  };

  void open_cpu_interface();
  static void dispatch(void* self);

  std::array<Entry, gic::id_count> handlers_;
  std::uint32_t unhandled_;
};

}  // namespace drivers

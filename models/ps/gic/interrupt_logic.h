#pragma once

#include <array>
#include <cstdint>

#include <gic_registers.h>

namespace ps {

/// What the interrupt controller decides, without registers and time: which interrupt is pending,
/// active, and signalled to the CPU (ARM Generic Interrupt Controller architecture 1.0, chapter 3;
/// one CPU in secure state).
class InterruptLogic {
 public:
  InterruptLogic() { reset(); }
  void reset();

  /// What software set in the distributor.
  struct Interrupt {
    bool non_secure = false;
    bool enabled = false;
    bool edge = false;
    bool latched = false;  ///< pending by an edge, a software interrupt or ICDISPR
    bool active = false;
    bool wire = false;  ///< level of the input
    std::uint8_t priority = 0;
    std::uint8_t targets = 0;  ///< bit 0: this CPU

    bool pending() const { return latched || (wire && !edge); }
  };
  Interrupt& operator[](std::uint32_t id) { return interrupts_[id]; }
  const Interrupt& operator[](std::uint32_t id) const { return interrupts_[id]; }

  /// Registers that the decisions depend on.
  std::uint32_t icddcr = 0;
  std::uint32_t iccicr = 0;
  std::uint32_t iccpmr = 0;
  std::uint32_t iccbpr = 2;
  std::uint32_t iccabpr = 3;

  /// An input changed to `level`: a rising edge latches an edge-sensitive interrupt, enabled or
  /// not.
  void set_wire(std::uint32_t id, bool level);

  bool irq() const { return signalled() == Line::irq; }
  bool fiq() const { return signalled() == Line::fiq; }

  /// What ICCIAR would return: the signalled interrupt; 1023 if there is none, 1022 if it is
  /// non-secure and AckCtl is 0.
  std::uint32_t acknowledgeable() const;
  /// Reads ICCIAR: that interrupt becomes active.
  std::uint32_t acknowledge();
  /// Writes ICCEOIR. False if the interrupt was not active (a mistake of the software; nothing
  /// happens).
  bool end(std::uint32_t id);
  /// ICCHPIR: like ICCIAR, without effects, and whatever the priorities of mask and running
  /// interrupt.
  std::uint32_t highest_pending() const;
  /// ICCRPR: priority of the most urgent active interrupt, 0xFF if idle.
  std::uint32_t running_priority() const;

 private:
  enum class Line { none, irq, fiq };

  std::uint32_t candidate() const;
  bool forwarded(const Interrupt& interrupt) const;
  bool preempts(const Interrupt& interrupt) const;
  Line signalled() const;
  std::uint32_t as_seen(std::uint32_t id) const;

  std::array<Interrupt, gic::id_count> interrupts_;
};

}  // namespace ps

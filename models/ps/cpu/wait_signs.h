#pragma once

#include <cstdint>
#include <string>

#include <ps/cpu/surroundings.h>

namespace ps {

/// What a program was last seen doing that looks like waiting, for the message when it does not
/// end: reading a register, polling it, or looping without a call of the HAL.
class WaitSigns {
 public:
  /// It read a register.
  void note_read(std::uint32_t address, std::uint32_t value) {
    if (by_ != By::read || address_ != address) {
      see(By::read, address, value, 0);
      return;
    }
    ++again_;
    changed_ |= value_ ^ value;
    value_ = value;
  }
  /// It waits for another value than `previous`, for up to `reads` reads.
  void note_poll(std::uint32_t address, std::uint32_t previous, std::uint32_t reads) {
    see(By::poll, address, previous, reads);
  }
  /// The poll saw another value.
  void end_poll(std::uint32_t address, std::uint32_t value) { see(By::read, address, value, 0); }
  /// Time passes because of a loop without a call of the HAL, or no longer.
  void set_loops(bool loops) { loops_ = loops; }

  bool loops() const { return loops_; }
  /// It read one value of one register so often that it likely waits for another one.
  bool sees_no_change() const;
  /// As the end of a message, "; it polls for …"; empty if there is no sign.
  std::string text(const Surroundings& surroundings, bool irq_masked) const;

 private:
  enum class By : std::uint8_t { none, read, poll };

  void see(By by, std::uint32_t address, std::uint32_t value, std::uint64_t again) {
    by_ = by;
    address_ = address;
    value_ = value;
    again_ = again;
    changed_ = 0;
  }

  std::uint32_t address_ = 0, value_ = 0;  ///< of the register that it read last
  By by_ = By::none;
  bool loops_ = false;
  std::uint64_t again_ = 0;    ///< reads of it, one after the other, since the first, or to come
  std::uint32_t changed_ = 0;  ///< bits that differed between two of them
};

}  // namespace ps

#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <systemc>
#include <tlm>
#include <vector>

#include <vp/clock_scheduler.h>
#include <vp/register_description.h>

namespace vp {

class RegisterBank;

/// One register of a bank: its value, what software may do with it, and what happens then.
///
/// A device names its registers as members, in the order and with the names of the datasheet:
///
///   vp::RegisterBank s_axi_lite{"s_axi_lite", axi_dma::registers, options, scheduler};
///   vp::Register& mm2s_dmacr = s_axi_lite[axi_dma::MM2S_DMACR];
///
/// and says in its constructor what is special: `mm2s_dmacr.after_write([this](std::uint32_t word)
/// { … });`
class Register {
 public:
  explicit Register(const RegisterInfo& info);

  const RegisterInfo& info() const { return info_; }

  std::uint32_t value() const { return value_; }
  operator std::uint32_t() const { return value_; }
  bool any(std::uint32_t mask) const { return (value_ & mask) != 0; }

  /// What the hardware does to it: no access policy, no effects.
  void set(std::uint32_t value) { value_ = value; }
  Register& operator=(std::uint32_t value) {
    value_ = value;
    return *this;
  }
  void set_bits(std::uint32_t mask) { value_ |= mask; }
  void clear_bits(std::uint32_t mask) { value_ &= ~mask; }
  void reset() { value_ = reset_; }

  /// Build options: another reset value (which applies at once), fewer writable bits, no such
  /// register at all (reads 0, ignores writes).
  void set_reset_value(std::uint32_t value);
  void set_writable(std::uint32_t mask) { writable_ = mask; }
  void remove();
  bool removed() const { return removed_; }
  std::uint32_t reset_value() const { return reset_; }

  /// Software reads what `compute` returns, not value(). No side effects: debug accesses call it
  /// too.
  void computed_by(std::function<std::uint32_t()> compute) { compute_ = std::move(compute); }
  /// Called after software read `word`.
  void after_read(std::function<void(std::uint32_t word)> effect) {
    after_read_ = std::move(effect);
  }
  /// Called after software wrote `word` and the access policy was applied to value().
  void after_write(std::function<void(std::uint32_t word)> effect) {
    after_write_ = std::move(effect);
  }

  /// Reads return what a read now would before the time that `until` tells (in ps), if the inputs
  /// of the device stay as they are. A poll may then skip reads: it credits them to use(), but
  /// after_read() is not called for them.
  void stable_until(std::function<std::uint64_t()> until) { stable_until_ = std::move(until); }

  /// What software did with the register, for the coverage report.
  struct Use {
    std::uint64_t reads = 0;
    std::uint64_t writes = 0;
    std::uint32_t read_ones = 0;      ///< bits that were read as 1
    std::uint32_t read_zeros = 0;     ///< bits that were read as 0
    std::uint32_t written_ones = 0;   ///< bits that were written as 1
    std::uint32_t written_zeros = 0;  ///< bits that were written as 0
  };
  const Use& use() const { return use_; }

 private:
  friend class RegisterBank;
  friend class RegisterRoute;

  std::uint64_t stable_until_ps() const { return stable_until_ && !removed_ ? stable_until_() : 0; }
  void credit_reads(std::uint64_t reads, std::uint32_t word) {
    use_.reads += reads;
    use_.read_ones |= word;
    use_.read_zeros |= ~word;
  }
  std::uint32_t seen() const;
  std::uint32_t read();
  void write(std::uint32_t word);
  void apply_policy(std::uint32_t word);
  /// A write of the current value is not reported: drivers write back what they read.
  bool ignores(std::uint32_t word) const {
    return info_.access == Access::read_only && word != seen();
  }

  const RegisterInfo& info_;
  std::uint32_t value_;
  std::uint32_t reset_;
  std::uint32_t writable_;
  bool removed_ = false;
  std::function<std::uint32_t()> compute_;
  std::function<void(std::uint32_t)> after_read_;
  std::function<void(std::uint32_t)> after_write_;
  std::function<std::uint64_t()> stable_until_;
  Use use_;
};

/// A table of registers, as an IP's register header declares it.
struct RegisterTable {
  template <std::size_t N>
  constexpr RegisterTable(const RegisterInfo (&table)[N]) : first(table), count(N) {}
  const RegisterInfo* first;
  std::size_t count;
};

/// How a bank answers what is not a plain access to a register.
struct RegisterBankOptions {
  enum class Holes {
    error,        ///< TLM_ADDRESS_ERROR_RESPONSE
    acknowledge,  ///< reads return 0, writes are ignored; warned of
  };
  enum class ByteEnables {
    error,   ///< a partial access gets TLM_BYTE_ENABLE_ERROR_RESPONSE
    ignore,  ///< all four bytes are written
  };
  Holes holes = Holes::error;
  ByteEnables byte_enables = ByteEnables::error;
  unsigned address_bits = 12;  ///< decoded; the registers repeat above them. 2 to 20
};

/// A bus target made of registers. 32-bit aligned accesses only (others: TLM_BURST_ERROR_RESPONSE).
///
/// An access happens when the initiator's annotated delay has passed, at the state that the
/// device's clocked part has then: all clock edges up to and including that time have run. It takes
/// no time of its own; the time of a bus access belongs to the bus. A write that the hardware
/// ignores is warned of, and any access where no register is. Debug accesses cause no effects, use
/// no time and are not counted; DMI is never given.
class RegisterBank : public sc_core::sc_module {
 public:
  /// `scheduler` of the device's clock; null if the device has none.
  RegisterBank(sc_core::sc_module_name name, RegisterTable table,
               const RegisterBankOptions& options = {}, ClockScheduler* scheduler = nullptr);
  const char* kind() const override { return "vp::RegisterBank"; }

  tlm_utils::simple_target_socket<RegisterBank> socket;

  /// The register at `offset`. Throws std::logic_error if the table has none.
  Register& operator[](std::uint32_t offset);
  /// All registers, in the table's order.
  const std::deque<Register>& registers() const { return registers_; }

  /// Called before software reads or writes a register: a model whose state follows from the time
  /// brings it up to date.
  void before_access(std::function<void()> effect) { before_access_ = std::move(effect); }

  /// An access by software, now: reads or writes `word`. All clock edges up to now have run.
  /// `address` is for messages.
  tlm::tlm_response_status access(Register& target, bool read, std::uint64_t address,
                                  std::uint32_t& word);
  /// What software would read at `offset` now, without effects. Throws std::logic_error if no
  /// register is there.
  std::uint32_t peek(std::uint32_t offset);
  /// Sets every register to its reset value; no effects.
  void reset();
  /// While held, registers stay at their reset values and an access is warned of and answered with
  /// TLM_GENERIC_ERROR_RESPONSE (on the chip the bus hangs).
  void hold_in_reset(bool hold);
  bool held_in_reset() const { return held_in_reset_; }

 private:
  void pass(const sc_core::sc_time& time);
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);
  tlm::tlm_response_status access(tlm::tlm_generic_payload& payload);
  Register* find(std::uint64_t address) const;
  bool all_bytes_enabled(const tlm::tlm_generic_payload& payload) const;
  tlm::tlm_response_status access_removed(Register& target, bool read, std::uint64_t address,
                                          std::uint32_t& word);
  tlm::tlm_response_status refuse_in_reset(std::uint64_t address) const;
  void warn_of_ignored_write(const Register& target, std::uint32_t word) const;
  void warn_of_missing_register(bool read, std::uint64_t address) const;
  void synchronise() const;

  RegisterBankOptions options_;
  ClockScheduler* scheduler_;
  bool held_in_reset_ = false;
  std::function<void()> before_access_;
  std::deque<Register> registers_;
  std::vector<Register*> by_word_;  ///< decode: word offset to register, null for a hole
};

inline tlm::tlm_response_status RegisterBank::access(Register& target, bool read,
                                                     std::uint64_t address, std::uint32_t& word) {
  if (held_in_reset_) return refuse_in_reset(address);
  if (before_access_) before_access_();
  if (target.removed_) return access_removed(target, read, address, word);
  if (read) {
    word = target.read();
  } else {
    if (target.ignores(word)) warn_of_ignored_write(target, word);
    target.write(word);
  }
  return tlm::TLM_OK_RESPONSE;
}

}  // namespace vp

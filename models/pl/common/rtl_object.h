#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include <pl/common/rtl_interface.h>
#include <vp/clock.h>
#include <vp/ip.h>

namespace pl {

/// Id of the report with which RTL that ends itself ends the simulation.
inline constexpr const char* rtl_ended = "/markervp/rtl/ended";

/// Clocks for which RTL is held in reset before time 0: that of the peripherals by Processor System
/// Reset (PG164).
inline constexpr unsigned rtl_reset_clocks = 16;

/// Loads a shared object with Verilated RTL once; it stays loaded. Throws vp::InputError for one
/// that is no RTL or has another interface, vp::ProtocolError for one that is damaged.
const RtlDescriptor& open_rtl(const std::string& file);

/// One model of such an object, which evaluates it and reports how it ends.
class RtlObject {
 public:
  /// `instance`: the name of the module that shows it. Registers without reset start as `seed` says
  /// (rtl_interface.h). `clock` is for messages.
  RtlObject(const std::string& file, std::uint64_t seed, const std::string& instance,
            const vp::Clock& clock);

  const RtlDescriptor& descriptor() const { return rtl_; }
  const std::string& file() const { return file_; }
  const std::string& instance() const { return instance_; }
  /// Where the value of a port is kept.
  void* pin(std::uint32_t port) const { return rtl_.pin(model_.get(), port); }
  /// The port of a name; null: the RTL has no such port.
  const RtlPort* find(const std::string& name) const;

  /// Logic and registers follow the pins.
  void evaluate() const {
    if (const RtlEnd* end = rtl_.eval(model_.get())) ended(*end);
  }
  /// Its last word, behind the last edge.
  void finish() const {
    if (const RtlEnd* end = rtl_.finish(model_.get())) ended(*end);
  }
  /// Whether its assertions are checked from here on.
  void check(bool on) const {
    if (rtl_.check) rtl_.check(model_.get(), on ? 1 : 0);
  }
  /// All clocks are low again; only if lowers().
  void lower() const { rtl_.lower(model_.get()); }
  bool lowers() const { return rtl_.lower != nullptr; }
  /// What its next evaluation depends on: descriptor().state_bytes bytes.
  const void* state() const { return rtl_.state(model_.get()); }
  /// Nothing for RTL that counts none.
  void write_coverage(const std::string& file) const {
    if (rtl_.write_coverage) rtl_.write_coverage(model_.get(), file.c_str());
  }
  /// Where registers without reset start: "0", "1", "random values (seed 1000)".
  std::string start() const;
  /// What it is built from.
  vp::IpEstimate::Foreign foreign() const;

 private:
  /// Throws sc_core::sc_report while the simulation runs, otherwise vp::ProtocolError.
  [[noreturn]] void ended(const RtlEnd& end) const;

  const std::string file_;
  const std::uint64_t seed_;
  const std::string instance_;
  const vp::Clock& clock_;
  const RtlDescriptor& rtl_;
  const std::unique_ptr<void, void (*)(void*)> model_;
};

/// Writes `value` to a pin of up to 64 bits, which lies as rtl_interface.h says.
inline void store_pin(void* place, unsigned bits, std::uint64_t value) {
  if (bits <= 8) {
    *static_cast<std::uint8_t*>(place) = static_cast<std::uint8_t>(value);
  } else if (bits <= 16) {
    *static_cast<std::uint16_t*>(place) = static_cast<std::uint16_t>(value);
  } else if (bits <= 32) {
    *static_cast<std::uint32_t*>(place) = static_cast<std::uint32_t>(value);
  } else {
    *static_cast<std::uint64_t*>(place) = value;
  }
}
/// Reads a pin of up to 64 bits.
inline std::uint64_t load_pin(const void* place, unsigned bits) {
  if (bits <= 8) return *static_cast<const std::uint8_t*>(place);
  if (bits <= 16) return *static_cast<const std::uint16_t*>(place);
  if (bits <= 32) return *static_cast<const std::uint32_t*>(place);
  return *static_cast<const std::uint64_t*>(place);
}

}  // namespace pl

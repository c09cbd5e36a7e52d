#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "examples.h"
#include "temporary_files.h"
#include "vcd_check.h"

namespace appendix_c {

/// Runs one example and answers questions about its trace.
class TraceOf {
 public:
  explicit TraceOf(const std::string& name)
      : top_(name.substr(name.find('_') + 1) + "."), text_(make(name)), vcd_(text_) {}

  /// Value of a signal from an instant on. Throws std::out_of_range for an unknown signal.
  std::uint64_t at(const std::string& signal, std::uint64_t ps) const {
    return std::stoull(vcd_.value(top_ + signal, ps), nullptr, 2);
  }
  /// First time at which the signal has the value; throws std::runtime_error if it never has.
  std::uint64_t when(const std::string& signal, std::uint64_t value) const {
    for (const auto& [ps, digits] : vcd_.variable(top_ + signal).changes) {
      if (std::stoull(digits, nullptr, 2) == value) return ps;
    }
    throw std::runtime_error(top_ + signal + " is never " + std::to_string(value));
  }
  const std::string& text() const { return text_; }
  const VcdCheck& vcd() const { return vcd_; }

 private:
  static std::string make(const std::string& name) {
    const kit::TemporaryFolder folder;
    const std::filesystem::path file = folder / (name + ".vcd");
    write_trace(name, file);
    return VcdCheck::text_of(file.string());
  }

  std::string top_;
  std::string text_;
  VcdCheck vcd_;
};

}  // namespace appendix_c

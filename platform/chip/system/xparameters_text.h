#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace xparameters {

/// The lines "#define NAME value" of one device. A line of both flows is written as it is, one of a
/// single flow behind its condition.
class Section {
 public:
  /// `library`: what only the sources of the compatibility layer ask for.
  enum Flow : unsigned { classic = 1, sdt = 2, both = 3, library = 4 };

  /// `title`: a comment before it. Names begin with XPAR_, which is added.
  explicit Section(std::string title) : title_(std::move(title)) {}

  void number(Flow flow, const std::string& name, std::uint64_t value);
  /// A number as SDT writes all of them.
  void hex(Flow flow, const std::string& name, std::uint32_t value);
  void address(Flow flow, const std::string& name, std::uint32_t value);
  void words(Flow flow, const std::string& name, const std::string& text);
  /// What does not begin with XPAR_.
  void plain(Flow flow, const std::string& name, const std::string& value);

  std::string text() const;

 private:
  struct Line {
    std::string name, value;
    unsigned flows;
  };
  void add(Flow flow, const std::string& name, const std::string& value);
  /// `interrupts`: of SDT's lines, those of interrupts or the rest.
  std::string lines_of(unsigned flows, bool interrupts = false) const;

  std::string title_;
  std::vector<Line> lines_;
  std::unordered_map<std::string, std::size_t> by_text_;  ///< name and value to place in lines_
};

/// What the interrupt of a device is in a device tree (bsp-facts of the vendor's generator): number
/// within its kind, sense, and which kind.
std::uint32_t sdt_interrupt(std::uint32_t id);

/// The lines of the processing system's own devices: `uarts` as Platform has them.
std::string processing_system(std::uint64_t cpu_hz, const std::vector<std::uint32_t>& uarts);

}  // namespace xparameters

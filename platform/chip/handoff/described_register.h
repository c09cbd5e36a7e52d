#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <chip/handoff/register_file.h>

namespace platform::handoff {

inline constexpr std::size_t most_registers = 65'536;  ///< of one file

/// A register as a file describes it, of up to 64 bits.
struct DescribedRegister {
  struct Field {
    std::string name;
    unsigned low = 0, bits = 1;
    std::string access, documentation;
    std::uint64_t reset = 0;
  };
  std::string name;
  std::uint64_t offset = 0;
  unsigned bits = 32;
  std::uint64_t reset = 0;
  std::string access = "rw", documentation;
  std::vector<Field> fields;
};

/// Adds its words of 32 bits; the upper ones are called NAME_HI. `place` is for messages: throws
/// vp::InputError for what cannot be a register, and for too many of them.
void add_register(RegisterMap& map, DescribedRegister described, const std::string& place);

/// "0x1F", "31", "8'h1F", "'b1_1111"; throws vp::InputError at `place` for anything else.
std::uint64_t register_number(const std::string& text, const std::string& place);

// The kinds of files, by their texts. `origin` names the file.
std::vector<RegisterMap> registers_of_component(const std::string& text, const std::string& origin);
std::vector<RegisterMap> registers_of_header(const std::string& text, const std::string& origin);
std::vector<RegisterMap> registers_of_rdl(const std::string& text, const std::string& origin);

}  // namespace platform::handoff

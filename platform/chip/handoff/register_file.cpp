#include <chip/handoff/register_file.h>

#include <chip/handoff/described_register.h>
#include <strings.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace platform::handoff {

namespace {

using facts::HardwareMap;

constexpr std::uint64_t largest_file = 1 << 26;
constexpr unsigned word_bits = 32, bits_per_byte = 8;

std::uint32_t mask_of(unsigned low, unsigned bits) {
  return static_cast<std::uint32_t>(((std::uint64_t{1} << bits) - 1) << low);
}

/// The part of a field that lies in the word of bits `low` on; none: 0 bits.
HardwareMap::Field field_in(const DescribedRegister::Field& field, unsigned low) {
  const unsigned first = std::max(field.low, low);
  const unsigned end = std::min(field.low + field.bits, low + word_bits);
  if (first >= end) return {};
  const std::uint32_t mask = mask_of(first - low, end - first);
  const auto reset =
      static_cast<std::uint32_t>(field.reset >> (first - field.low)) & mask_of(0, end - first);
  return {field.name, mask, field.access, reset, field.documentation};
}

HardwareMap::Register word_of(const DescribedRegister& described, unsigned low) {
  HardwareMap::Register word;
  word.name = described.name + (low == 0 ? "" : "_HI");
  word.offset = static_cast<std::uint32_t>(described.offset + low / bits_per_byte);
  word.access = described.access;
  word.documentation = described.documentation;
  word.reset = static_cast<std::uint32_t>(described.reset >> low);
  if (described.access != "ro")
    word.writable = mask_of(0, std::min(described.bits - low, word_bits));
  std::uint32_t writable = 0;
  for (const DescribedRegister::Field& field : described.fields) {
    const HardwareMap::Field part = field_in(field, low);
    if (part.mask == 0) continue;
    if (part.access != "ro") writable |= part.mask;
    word.fields.push_back(part);
  }
  if (!described.fields.empty()) word.writable = writable;
  word.declared_reset = word.at_start = word.reset;
  return word;
}

}  // namespace

std::uint64_t register_number(const std::string& text, const std::string& place) {
  std::string digits = text;
  int base = 10;
  const std::size_t tick = digits.find('\'');
  if (tick != std::string::npos && tick + 1 < digits.size()) {
    const char kind = static_cast<char>(std::tolower(static_cast<unsigned char>(digits[tick + 1])));
    base = kind == 'h' ? 16 : kind == 'b' ? 2 : kind == 'o' ? 8 : kind == 'd' ? 10 : 0;
    digits = digits.substr(tick + 2);
  } else if (digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X')) {
    base = 16;
    digits = digits.substr(2);
  }
  digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());
  char* end = nullptr;
  errno = 0;
  const bool plain =
      base != 0 && !digits.empty() && std::isxdigit(static_cast<unsigned char>(digits[0]));
  const std::uint64_t value = plain ? std::strtoull(digits.c_str(), &end, base) : 0;
  if (!plain || *end != '\0' || errno != 0)
    throw vp::InputError(place + ": '" + vp::excerpt(vp::visible(text)) + "' is no number");
  return value;
}

void add_register(RegisterMap& map, DescribedRegister described, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    throw vp::InputError(place + ": register '" + vp::excerpt(described.name) + "' " + why);
  };
  if (described.bits == 0 || described.bits > 2 * word_bits)
    refuse("has " + std::to_string(described.bits) + " bits: 1 to 64 are read");
  if (described.offset > std::numeric_limits<std::uint32_t>::max() - 2 * word_bits)
    refuse("lies at " + vp::hex(described.offset) + ", beyond what the processor can address");
  for (const DescribedRegister::Field& field : described.fields) {
    if (field.bits == 0 || field.low >= described.bits || field.bits > described.bits - field.low)
      refuse("of " + std::to_string(described.bits) + " bits has field '" +
             vp::excerpt(field.name) + "' of " + std::to_string(field.bits) + " from bit " +
             std::to_string(field.low) + " on");
  }
  std::stable_sort(described.fields.begin(), described.fields.end(),
                   [](const auto& a, const auto& b) { return a.low < b.low; });
  for (unsigned low = 0; low < described.bits; low += word_bits)
    map.registers.push_back(word_of(described, low));
  if (map.registers.size() > most_registers)
    refuse("is one too many: more than " + std::to_string(most_registers) + " in one file");
}

std::vector<RegisterMap> read_registers(const std::string& file) {
  const std::string text = vp::read_text(file, "description of registers", largest_file);
  const std::string ending = std::filesystem::path(file).extension().string();
  std::vector<RegisterMap> maps;
  if (ending == ".xml") {
    maps = registers_of_component(text, file);
  } else if (ending == ".rdl") {
    maps = registers_of_rdl(text, file);
  } else if (ending == ".h") {
    maps = registers_of_header(text, file);
  } else {
    throw vp::InputError(
        file + ": registers are read from .xml (IP-XACT), .rdl (SystemRDL) and .h (Vitis HLS)");
  }
  for (RegisterMap& map : maps) {
    std::stable_sort(map.registers.begin(), map.registers.end(),
                     [](const auto& a, const auto& b) { return a.offset < b.offset; });
  }
  return maps;
}

// Vitis calls the interface s_axi_control in ports, and control in its header.
const std::vector<HardwareMap::Register>* registers_behind(const std::vector<RegisterMap>& maps,
                                                           const std::string& interface,
                                                           bool only) {
  for (const RegisterMap& map : maps) {
    const std::size_t size = map.interface.size();
    const bool ends =
        size != 0 && interface.size() > size && interface[interface.size() - size - 1] == '_' &&
        ::strcasecmp(interface.c_str() + interface.size() - size, map.interface.c_str()) == 0;
    if (ends || ::strcasecmp(map.interface.c_str(), interface.c_str()) == 0) return &map.registers;
  }
  return only && maps.size() == 1 ? &maps.front().registers : nullptr;
}

}  // namespace platform::handoff

#include <zynq/register_coverage.h>

#include <vp/register_bank.h>
#include <vp/text.h>
#include <zynq/hardware_map.h>
#include <systemc>

namespace platform {

namespace {

/// "-" if the register was not used so.
std::string bits(std::uint64_t accesses, std::uint32_t mask) {
  return accesses == 0 ? "-" : vp::hex(mask);
}

std::string row(const vp::Register& r) {
  const vp::Register::Use& use = r.use();
  std::string text = "| " + std::string(r.info().name);
  text += " | " + std::to_string(use.reads) + " | " + std::to_string(use.writes);
  text += " | " + bits(use.reads, use.read_ones) + " | " + bits(use.reads, use.read_zeros);
  text += " | " + bits(use.writes, use.written_ones) + " | " + bits(use.writes, use.written_zeros);
  return text + " |\n";
}

std::string section(const std::string& device, const vp::RegisterBank& bank) {
  std::string rows, untouched;
  std::size_t used = 0, built = 0;
  for (const vp::Register& r : bank.registers()) {
    const bool touched = r.use().reads + r.use().writes != 0;
    if (r.removed() && !touched) continue;
    ++built;
    used += touched ? 1 : 0;
    if (touched) {
      rows += row(r);
    } else {
      untouched += (untouched.empty() ? "" : ", ") + std::string(r.info().name);
    }
  }
  std::string text = "\n## " + device + ": " + std::to_string(used) + " of " +
                     std::to_string(built) + " registers\n\n";
  if (!rows.empty()) {
    text +=
        "| Register | Reads | Writes | Read as 1 | Read as 0 | Written 1 | Written 0 |\n"
        "|---|---|---|---|---|---|---|\n" +
        rows + "\n";
  }
  if (!untouched.empty()) text += "Never touched: " + untouched + "\n";
  return text;
}

}  // namespace

std::string register_coverage(Zynq& zynq) {
  std::string text =
      "# Registers that the program used\n\nMasks show the bits that were seen or written with "
      "that value at least once.\n";
  for (const auto& device : hardware_map(zynq).devices) {
    const auto* bank =
        dynamic_cast<const vp::RegisterBank*>(sc_core::sc_find_object(device.path.c_str()));
    if (bank) text += section(device.name, *bank);
  }
  return text;
}

}  // namespace platform

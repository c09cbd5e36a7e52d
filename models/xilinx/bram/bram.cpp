#include <xilinx/bram/bram.h>

#include <string>

#include <vp/hex.h>
#include <vp/report.h>

namespace xilinx {

namespace {

constexpr std::uint32_t word_bytes = 4;
constexpr std::uint32_t largest_depth = 1u << 20;  // words: 4 MiB, more than any Zynq-7000 has

}  // namespace

Bram::Bram(sc_core::sc_module_name name, std::uint32_t default_depth_a)
    : sc_module(name),
      depth_a("depth_a", default_depth_a, vp::Unit::none, {1, largest_depth}, vp::Source::published,
              "words of 32 bit at port A (thesis table 4.3)"),
      bytes_(std::size_t{depth_a} * word_bytes, 0) {}

void Bram::write_a(std::uint32_t address, std::uint32_t word) {
  if (address >= depth_a) {
    ++out_of_range;
    vp::warn(*this, "/markervp/bram/out_of_range",
             "write at word " + vp::hex(address) + ", the memory has " + std::to_string(depth_a) +
                 " words");
    return;
  }
  ++writes_a;
  for (std::uint32_t lane = 0; lane < word_bytes; ++lane) {
    bytes_[std::size_t{address} * word_bytes + lane] =
        static_cast<std::uint8_t>(word >> (8 * lane));
  }
}

std::uint8_t Bram::refuse_read(std::uint32_t address) {
  ++out_of_range;
  vp::warn(*this, "/markervp/bram/out_of_range",
           "read at byte " + vp::hex(address) + ", the memory has " +
               std::to_string(bytes_.size()) + " bytes");
  return 0;
}

}  // namespace xilinx

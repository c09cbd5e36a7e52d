#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include <vp/counter.h>
#include <vp/parameter.h>

namespace xilinx {

/// Block memory as simple dual-port RAM (thesis table 4.3): port A writes 32-bit words, port B
/// reads bytes. Little endian: byte address 4w + i of port B is bits 8i+7:8i of word w of port A,
/// so the leftmost pixel of a word is in bits 7:0.
///
/// A plain memory: the module at port B models its latency of one clock. An access out of range is
/// a fault of the module at the port: it is warned of, a write is dropped, a read returns 0.
class Bram : public sc_core::sc_module {
 public:
  /// Depth of port A in words; 76 800 for 640 × 480 pixels.
  explicit Bram(sc_core::sc_module_name name, std::uint32_t depth_a = 76'800);
  const char* kind() const override { return "xilinx::Bram"; }

  vp::Parameter<std::uint32_t> depth_a;

  vp::Counter writes_a{"writes_a", "words written at port A"};
  vp::Counter reads_b{"reads_b", "bytes read at port B"};
  vp::Counter out_of_range{"out_of_range", "accesses at an address that is not in the memory"};

  std::uint32_t size_b() const { return static_cast<std::uint32_t>(bytes_.size()); }

  /// Port A. `address` counts words.
  void write_a(std::uint32_t address, std::uint32_t word);
  /// Port B. `address` counts bytes.
  std::uint8_t read_b(std::uint32_t address) {
    if (address >= bytes_.size()) return refuse_read(address);
    ++reads_b;
    return bytes_[address];
  }

  /// All bytes in port B's order, for loading an image without bus traffic and for tests. Not
  /// counted.
  std::vector<std::uint8_t>& contents() { return bytes_; }

 private:
  std::uint8_t refuse_read(std::uint32_t address);

  std::vector<std::uint8_t> bytes_;
};

}  // namespace xilinx

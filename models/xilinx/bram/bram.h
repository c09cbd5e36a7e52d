#pragma once

#include <cstdint>
#include <systemc>
#include <vector>

#include <vp/counter.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/rule_reports.h>

namespace xilinx {

/// Block memories of 36 kbit that a simple dual-port RAM of `depth` words of `width` bits takes in
/// the 7 series, in halves (a block is two of 18 kbit): the fewest over the aspect ratios of UG473
/// (32K × 1, 16K × 2, 8K × 4, 4K × 9, 2K × 18, 1K × 36, 512 × 72), as the Block Memory Generator's
/// minimum-area choice. `parity` false: the ninth bits are not used, as where the two ports differ
/// in width.
double block_ram_36(std::uint64_t depth, std::uint32_t width, bool parity = true);

/// Block memory as simple dual-port RAM (thesis table 4.3): port A writes 32-bit words, port B
/// reads bytes. Little endian: byte address 4w + i of port B is bits 8i+7:8i of word w of port A,
/// so the leftmost pixel of a word is in bits 7:0.
///
/// A plain memory: the module at port B models its latency of one clock. An access out of range is
/// a fault of the module at the port: it breaks a rule, a write is dropped, a read returns 0. So is
/// a write to the word that port B reads on the same edge: on the chip what is read is unknown
/// (UG473, address collision), here it is what is written.
class Bram : public sc_core::sc_module, public vp::Ip, public virtual sc_core::sc_interface {
 public:
  /// A model at port B that reads many bytes at once: called for accesses of port A.
  class Reader {
   public:
    virtual ~Reader() = default;
    /// Whether it looks at the memory now, so that words must come at their own times.
    virtual bool reads() = 0;
    /// Whether it reads one of the bytes `first` to `first` + `count` - 1 at this instant.
    virtual bool reads_now(std::uint32_t first, std::uint32_t count) = 0;
    /// Bytes `first` to `first` + `count` - 1 are about to be written.
    virtual void before_write(std::uint32_t first, std::uint32_t count) = 0;
    /// They were written.
    virtual void after_write(std::uint32_t first, std::uint32_t count) = 0;
  };
  /// A model at port A that writes many words at once.
  class Writer {
   public:
    virtual ~Writer() = default;
    /// Writes what has come up to now.
    virtual void settle() = 0;
  };

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
  /// Port A, `count` words one after the other.
  void write_a(std::uint32_t address, const std::uint32_t* words, std::uint32_t count);
  /// Port B. `address` counts bytes.
  std::uint8_t read_b(std::uint32_t address) {
    if (address >= bytes_.size()) return refuse_read(address);
    ++reads_b;
    return bytes_[address];
  }

  /// Writes bytes in port B's order from address 0 on, without bus traffic. Not counted.
  void load(const std::vector<std::uint8_t>& bytes);
  /// All bytes in port B's order, for tests.
  std::vector<std::uint8_t>& contents() { return bytes_; }

  /// Returns the present memory without moving it; the Bram continues with a copy.
  std::vector<std::uint8_t> fork();

  // At most one of each; null for none.
  void set_reader(Reader* reader) { reader_ = reader; }
  Reader* reader() const { return reader_; }
  void set_writer(Writer& writer) { writer_ = &writer; }
  bool is_read() const { return reader_ && reader_->reads(); }
  /// Before a reader starts.
  void settle() {
    if (writer_) writer_->settle();
  }

 private:
  void end_of_simulation() override { reports_.finish(); }
  vp::IpEstimate own_estimate() const override;
  void store(std::uint32_t address, const std::uint32_t* words, std::uint32_t count);
  void report_collision(std::uint32_t address, std::uint32_t count);
  void refuse_write(std::uint32_t address);
  std::uint8_t refuse_read(std::uint32_t address);

  static constexpr std::uint32_t word_bytes = 4;  ///< of port A

  vp::RuleReports reports_{*this};
  std::vector<std::uint8_t> bytes_;
  Reader* reader_ = nullptr;
  Writer* writer_ = nullptr;
};

}  // namespace xilinx

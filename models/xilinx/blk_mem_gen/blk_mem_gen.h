#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <vector>

#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/ip.h>
#include <vp/signal.h>

namespace xilinx {

class AxiBramCtrl;

/// Build options of one port of a block memory, as Vivado asks for them.
struct BlkMemPortBuild {
  enum class WriteMode { write_first, read_first, no_change };

  std::uint32_t width = 32;     ///< bits of a word, 1 to 64
  std::uint32_t depth = 2048;   ///< words
  unsigned lane_bits = 0;       ///< that a bit of WE is for; 0: WE has one bit
  bool byte_addresses = false;  ///< as a BRAM controller counts
  bool has_enable = true;       ///< EN exists; left open it is 0
  bool writes = true, reads = true;
  WriteMode write_mode = WriteMode::write_first;
  unsigned latency = 1;  ///< clocks from an address to its word: registers at the output
  std::uint64_t reset_value = 0;
};

struct BlkMemGenBuild {
  /// One or two ports, without those that a BRAM controller is connected to.
  std::vector<BlkMemPortBuild> ports;
  std::uint32_t word_bits = 32;         ///< of its contents
  std::uint64_t words = 0;              ///< of this width, in all
  std::vector<std::uint64_t> contents;  ///< from address 0 on
  double bram36 = 0;                    ///< as the tool says; 0: estimated
};

/// Block Memory Generator v8.4 (PG058) with native ports of up to 64 bits, without ECC.
///
/// Ports of other widths see the same bits, lowest address in the lowest ones. Of two accesses to a
/// word on one edge, one of them a write, the order is open here as what is read is on the chip
/// (PG058, collisions). Its memory may be that of a BRAM controller: software sees what the ports
/// write, and they read what it wrote.
class BlkMemGen : public sc_core::sc_module, public vp::Ip {
 public:
  /// `clocks`: of each port; without ports of the memory. Throws vp::InputError for ports that do
  /// not fit together.
  BlkMemGen(sc_core::sc_module_name name, const std::vector<vp::Clock*>& clocks,
            const BlkMemGenBuild& build);
  const char* kind() const override { return "xilinx::BlkMemGen"; }

  class Port : public vp::Clocked {
   public:
    Port(sc_core::sc_module_name name, vp::Clock& clock, BlkMemGen& memory,
         const BlkMemPortBuild& build);
    const char* kind() const override { return "xilinx::BlkMemGenPort"; }

    // May be left open: 0, and REGCE as EN.
    vp::In<bool> en{"en", this}, rst{"rst", this}, regce{"regce", this};
    vp::In<std::uint64_t> we{"we", this}, addr{"addr", this}, din{"din", this};
    vp::Signal<std::uint64_t> dout;
    vp::Signal<bool> rst_busy{"rst_busy"};  ///< as RST, a clock later (assumed)

    vp::Counter accesses{"accesses", "clocks on which the port was enabled"};

   private:
    void edge() override;
    void before_end_of_elaboration() override;
    void end_of_elaboration() override {}  // pins may be left open
    void on_change(vp::SignalBase& signal, std::uint32_t id) override;
    bool enabled() const;
    void access();
    std::uint64_t written(std::uint64_t old) const;

    BlkMemGen& memory_;
    const BlkMemPortBuild build_;
    std::deque<std::uint64_t> stages_;  ///< the memory's own register first, the output last
    unsigned quiet_ = 0;                ///< edges since an input changed
  };
  Port& port(std::size_t number) { return ports_.at(number); }

  /// The memory is that of a controller, which has the contents of this one at its start; before
  /// the simulation. A further controller shares the first one's.
  void share(AxiBramCtrl& controller);

  /// A word at an address of a port with this width; 0 beyond the memory.
  std::uint64_t read(std::uint64_t address, std::uint32_t width) const;
  void write(std::uint64_t address, std::uint32_t width, std::uint64_t word);

 private:
  vp::IpEstimate own_estimate() const override;
  /// Whether a port may read something else while its inputs stay as they are.
  bool changes() const { return controller_ || (ports_.size() > 1 && is_written_); }

  BlkMemGenBuild build_;
  std::vector<unsigned char> own_;
  std::vector<unsigned char>* bytes_ = &own_;
  AxiBramCtrl* controller_ = nullptr;
  bool is_written_ = false;  ///< by one of the ports
  std::deque<Port> ports_;
  bool warned_ = false;
};

}  // namespace xilinx

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <chip/system/zynq.h>
#include <ps/cpu/line_guard.h>
#include <ps/memory/memory.h>
#include <xilinx/axi_dma/memory_port.h>

namespace platform {

/// Warns of a program that does not wait for a DMA: it reads what the DMA was ordered to write and
/// has not written yet, or ends meanwhile.
///
/// A program that waits by looking reads one address by one instruction, or one function
/// where it was optimised, until it changes. So a read is a mistake where the same then reads
/// another address of what is ordered, or reads none again until the end of the run. Rings and
/// frames that go round on purpose are looked at in their first round only. What runs without an
/// end, or sends, is named when the program ends, and the run with it: on the chip it runs on.
class EarlyReads {
 public:
  /// Of DMA engines below `zynq`'s logic, which outlives it, and so does `guard`.
  EarlyReads(Zynq& zynq, ps::LineGuard& guard, std::uint64_t first, std::uint64_t end);
  ~EarlyReads();
  EarlyReads(const EarlyReads&) = delete;
  EarlyReads& operator=(const EarlyReads&) = delete;

  /// A device wrote there, inside the memory.
  void written(std::uint64_t address, std::uint64_t bytes);
  /// The run is over: warns of what is left.
  void finish();

 private:
  enum Mark : unsigned char {
    ordered = 1,  ///< to be written
    has_data = 2  ///< was written once
  };
  /// The instruction that read, and the program's that led there; or 0 and a function.
  using Place = std::pair<std::uintptr_t, std::string>;
  /// Where the program read too early.
  struct Read {
    std::uint64_t address = 0;
    std::string place;
    std::uint64_t ps = 0;
    std::string orderer;
    bool polls = false;
  };

  void change(const xilinx::WriteOrders& orders, const xilinx::WriteOrders::Order& order,
              bool begins);
  bool program_reads(std::uint64_t address, std::uintptr_t instruction);
  bool is_candidate(std::uint64_t line) const;
  void forget(std::uint64_t first_line, std::uint64_t end_line);
  void warn(const Read& read, bool later);
  Place place_of(std::uintptr_t instruction, const std::string& text) const;
  std::string orderer_of(std::uint64_t address) const;
  void look_at_end(const xilinx::MemoryPort& port);
  void name_engines() const;

  Zynq& zynq_;
  ps::LineGuard& guard_;
  const std::uint64_t first_, end_;
  std::vector<xilinx::MemoryPort*> ports_;
  ps::SparseArray<unsigned char> lines_;
  std::map<Place, Read> reads_;
  bool is_over_ = false;  ///< it was warned of a read
};

}  // namespace platform

#pragma once

#include <cstdint>

#include <string>
#include <vector>

#include <vp/mm_link.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <zynq/zynq.h>

namespace platform {

/// Warns, once, of a loop that reads memory which a DMA writes, or wrote since the program's last
/// barrier or cache operation: here it sees the new data by chance, on the chip perhaps never.
///
/// Only loops are noticed that run for long without a HAL call. What they read is found with
/// ps::MemoryWatch, so a loop that waits for something else is none.
class SpinWatch : private vp::MmObserver {
 public:
  explicit SpinWatch(Zynq& zynq);
  ~SpinWatch() override;
  SpinWatch(const SpinWatch&) = delete;
  SpinWatch& operator=(const SpinWatch&) = delete;

  /// Reports what was found last: a frame or the run is over.
  void finish() { look_at(); }

 private:
  struct Buffer {
    std::uint64_t first = 0, end = 0;
    bool empty() const { return first == end; }
    bool has(std::uint64_t address) const { return address >= first && address < end; }
  };
  /// A DMA that writes memory.
  struct Writer {
    xilinx::AxiDma* dma;
    Buffer written;  ///< since the program's last barrier
    // When the last loop was noticed:
    Buffer watched_armed;
    Buffer watched_written;
  };

  bool needs_transactions() const override { return false; }
  void after(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override;
  void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override;
  void loop_noticed(ps::MemoryWatch& memory);
  void look_at();
  void forget_what_was_made_visible();
  Buffer armed(xilinx::AxiDma& dma) const;
  Buffer clipped(std::uint64_t first, std::uint64_t end) const;

  Zynq& zynq_;
  std::vector<Writer> writers_;
  std::uint64_t barriers_ = 0;  ///< of the program, until the last write
  std::string where_;
  const ps::MemoryWatch* memory_ = nullptr;
  bool warned_ = false;
};

}  // namespace platform

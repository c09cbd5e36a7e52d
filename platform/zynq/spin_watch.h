#pragma once

#include <cstdint>

#include <vp/mm_link.h>
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

  bool needs_transactions() const override { return false; }
  void after(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override;
  void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override;
  void loop_noticed(ps::MemoryWatch& memory);
  void look_at();
  void forget_what_was_made_visible();
  Buffer armed() const;
  Buffer clipped(std::uint64_t first, std::uint64_t end) const;
  std::uint32_t peek(std::uint32_t offset) const;

  Zynq& zynq_;
  std::uint32_t dma_base_ = 0;
  Buffer written_;              ///< since the program's last barrier
  std::uint64_t barriers_ = 0;  ///< of the program, until then
  // When the last loop was noticed:
  Buffer watched_armed_;
  Buffer watched_written_;
  std::string where_;
  const ps::MemoryWatch* memory_ = nullptr;
  bool warned_ = false;
};

}  // namespace platform

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <vp/mm_link.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <zynq/zynq.h>

namespace platform {

/// Warns of DMA buffers that work here, where no cache is simulated, and fail on the chip: a device
/// reads memory that the program never flushed, or wrote after it was flushed; or the program
/// publishes a result while memory that a device wrote was never invalidated. Once each. And of
/// each transfer that begins in a buffer of hal_dma_allocate() and ends behind it.
///
/// It keeps what the memory behind the caches holds, byte for byte: what was flushed there, or
/// written by a device. So it sees what the program wrote when a device comes to read it; what the
/// program reads it does not see.
class CacheContract {
 public:
  explicit CacheContract(Zynq& zynq);
  ~CacheContract();
  CacheContract(const CacheContract&) = delete;
  CacheContract& operator=(const CacheContract&) = delete;

  /// The test bench placed something there, flushed: what the program then makes of it is not
  /// looked at, which would cost a tenth of the speed with images.
  void placed(std::uint64_t address, std::uint64_t bytes) { mark(address, bytes, current | given); }
  /// The program publishes a result.
  void published();

 private:
  /// What is known of a cache line.
  enum Mark : unsigned char {
    current = 1,      ///< memory was up to date once: flushed, or written by a device
    written = 2,      ///< by a device
    invalidated = 4,  ///< by the program
    given = 8,        ///< placed by the test bench, and not flushed by the program since
  };
  class Watch : public vp::MmObserver {
   public:
    Watch(CacheContract& contract, vp::MmLink& link);
    ~Watch() override { link_.remove_observer(*this); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    bool needs_transactions() const override { return false; }
    void after(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override;
    void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override;

   private:
    CacheContract& contract_;
    vp::MmLink& link_;
  };

  void check_transfers();
  void flushed(std::uint64_t address, std::uint64_t bytes);
  void device_wrote(std::uint64_t address, std::uint64_t bytes);
  void mark(std::uint64_t address, std::uint64_t bytes, unsigned marks, unsigned cleared = 0);
  bool watches(std::uint64_t address, std::uint64_t bytes) const;
  void copy(std::uint64_t address, std::uint64_t bytes);
  std::optional<std::uint64_t> first_stale(std::uint64_t address, std::uint64_t bytes) const;
  void device_reads(std::uint64_t address, std::uint64_t bytes);

  Zynq& zynq_;
  std::uint64_t first_;
  std::uint64_t end_;
  std::vector<unsigned char> lines_;   ///< grows to the last line used
  std::vector<unsigned char> memory_;  ///< behind the caches; as long as lines_ says
  bool warned_of_read_ = false;
  bool warned_of_write_ = false;
  std::deque<Watch> watches_;  ///< of every memory master in the PL
};

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

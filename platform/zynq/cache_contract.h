#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include <vp/mm_link.h>
#include <zynq/zynq.h>

namespace platform {

/// Warns of DMA buffers that work here, where no cache is simulated, and fail on the chip: a device
/// reads memory that the program never flushed, or the program publishes a result while memory that
/// a device wrote was never invalidated. Once each.
///
/// What the program itself reads and writes cannot be seen: a buffer that was flushed once, and
/// written again, is taken as flushed.
class CacheContract {
 public:
  explicit CacheContract(Zynq& zynq);
  ~CacheContract();
  CacheContract(const CacheContract&) = delete;
  CacheContract& operator=(const CacheContract&) = delete;

  /// The test bench placed an image there, flushed.
  void placed(std::uint64_t address, std::uint64_t bytes) { mark(address, bytes, current); }
  /// The program publishes a result.
  void published();

 private:
  /// What is known of a cache line.
  enum Mark : unsigned char {
    current = 1,      ///< memory was up to date once: flushed, or written by a device
    written = 2,      ///< by a device
    invalidated = 4,  ///< by the program
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

  void mark(std::uint64_t address, std::uint64_t bytes, unsigned marks);
  void device_reads(std::uint64_t address, std::uint64_t bytes);

  Zynq& zynq_;
  std::uint64_t first_;
  std::uint64_t end_;
  std::vector<unsigned char> lines_;  ///< grows to the last line used
  bool warned_of_read_ = false;
  bool warned_of_write_ = false;
  std::deque<Watch> watches_;  ///< of every memory master in the PL
};

}  // namespace platform

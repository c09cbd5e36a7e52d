#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include <chip/system/zynq.h>
#include <chip/watch/early_reads.h>
#include <ps/cpu/line_guard.h>
#include <ps/memory/memory.h>
#include <vp/mm_link.h>

namespace platform {

/// Warns of DMA buffers that work here, where no cache is simulated, and fail on the chip, once
/// each:
///
/// * a device reads memory that the program never flushed, or wrote after it was flushed;
/// * a device is about to write memory that the program wrote and never flushed: what the cache
///   writes back later comes over the new data;
/// * the program reads memory that a device wrote, and has not invalidated it since;
/// * the program reads what it wrote, and invalidated before it was flushed;
/// * the program does not wait for a device: EarlyReads.
///
/// And of each transfer that begins in a buffer of hal_dma_allocate() and ends behind it.
///
/// It keeps what the memory behind the caches holds, byte for byte: what was flushed there, or
/// written by a device. So it sees what the program wrote when a device or an invalidation comes.
/// What the program reads it learns from ps::LineGuard.
class CacheContract {
 public:
  explicit CacheContract(Zynq& zynq);
  ~CacheContract();
  CacheContract(const CacheContract&) = delete;
  CacheContract& operator=(const CacheContract&) = delete;

  /// What a program calls to maintain caches, for messages.
  void name_calls(std::string flush, std::string invalidate) {
    flush_call_ = std::move(flush);
    invalidate_call_ = std::move(invalidate);
  }
  /// The test bench placed something there, flushed: what the program then makes of it is not
  /// looked at, which would cost a tenth of the speed with inputs.
  void placed(std::uint64_t address, std::uint64_t bytes) { mark(address, bytes, current | given); }

  /// The run is over, however it ended.
  void finish() { early_reads_.finish(); }

  /// Asked of each access of a device to the DDR until it finds one: what is wrong with its place,
  /// as the end of a sentence; "" if nothing is.
  void check_owners(std::function<std::string(std::uint64_t address, std::uint64_t bytes)> check) {
    owner_problem_ = std::move(check);
  }

 private:
  /// What is known of a cache line.
  enum Mark : unsigned char {
    current = 1,      ///< memory was up to date once: flushed, or written by a device
    invalidated = 2,  ///< by the program, once
    given = 4,        ///< placed by the test bench, and not flushed by the program since
    dropped = 8,      ///< what the program wrote there was invalidated, unflushed
    uncached = 16,    ///< the program's accesses go past the caches
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

  void leave_alone();
  void check_owner(tlm::tlm_command command, std::uint64_t address, std::uint64_t bytes);
  void check_transfers();
  void take(ps::Cpu::CacheCall call, std::uint64_t address, std::uint64_t bytes);
  template <class Action>
  void for_each_used(Action action);
  void flush_all();
  void flushed(std::uint64_t address, std::uint64_t bytes);
  void invalidate(std::uint64_t address, std::uint64_t bytes);
  void device_reads(std::uint64_t address, std::uint64_t bytes);
  void device_will_write(std::uint64_t address, std::uint64_t bytes);
  void device_wrote(std::uint64_t address, std::uint64_t bytes);
  void program_reads(std::uint64_t address);
  void mark(std::uint64_t address, std::uint64_t bytes, unsigned marks, unsigned cleared = 0);
  bool watches(std::uint64_t address, std::uint64_t bytes) const;
  unsigned char& marks_at(std::uint64_t address);
  void copy(std::uint64_t address, std::uint64_t bytes);
  std::optional<std::uint64_t> first_dirty(std::uint64_t address, std::uint64_t bytes,
                                           unsigned but);
  std::optional<std::uint64_t> first_unflushed(std::uint64_t address, std::uint64_t bytes);
  bool is_flushed_piece(std::uint64_t address, std::uint64_t bytes);

  Zynq& zynq_;
  std::uint64_t first_;
  std::uint64_t end_;
  ps::SparseArray<unsigned char> lines_;
  ps::SparseArray<unsigned char> memory_;  ///< behind the caches
  const unsigned char* const written_;     ///< the same bytes as the program has them
  ps::LineGuard guard_;
  EarlyReads early_reads_;
  bool off_ = false;          ///< the data caches are
  bool all_current_ = false;  ///< all of the caches was flushed once: no line was never
  std::function<std::string(std::uint64_t, std::uint64_t)> owner_problem_;
  std::string flush_call_ = "call hal_cache_flush()";
  std::string invalidate_call_ = "call hal_cache_invalidate()";
  bool warned_of_read_ = false;
  bool warned_of_write_ = false;
  std::deque<Watch> watches_;  ///< of every memory master in the PL
};

}  // namespace platform

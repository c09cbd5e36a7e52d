#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <systemc>
#include <tlm>
#include <type_traits>
#include <vector>

#include <vp/counter.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>

namespace vp {
class Clock;
}

namespace ps {

/// The first mapping of this process that lies in [first, end): "/usr/bin/x at 0x400000 to
/// 0x452000"; empty if none does.
std::string occupant(std::uint64_t first, std::uint64_t end);

/// Zeroed host memory at chosen host addresses, for as long as the object lives, and a second view
/// of it elsewhere. Pages take memory when first touched. Where the host allows a file without a
/// name of that size, it is one, which other processes may map, too.
///
/// Programs that are loaded there (ps::Resident) stay: their variables become part of the memory,
/// with what is in them, and get pages of their own again at the end. Their code is not part of it.
class FixedMapping {
 public:
  /// `first` and `size` are multiples of 4096. Throws vp::InputError that names `what` needs the
  /// memory, and what occupies the range, or the program that is larger than it.
  FixedMapping(const std::string& what, std::uint64_t first, std::uint64_t size);
  ~FixedMapping();
  FixedMapping(const FixedMapping&) = delete;
  FixedMapping& operator=(const FixedMapping&) = delete;

  unsigned char* data() const { return data_; }
  /// The same bytes at other addresses, where they stay accessible when pages of data() lose their
  /// access rights (ps::LineGuard).
  unsigned char* second_view() const { return second_view_; }
  std::uint64_t size() const { return size_; }
  /// The file; -1: none.
  int descriptor() const { return descriptor_; }
  /// Gives all pages back: the memory reads 0 again.
  void clear();
  /// In a process that was forked: a copy of its own in place of the memory that both have.
  /// Addresses and access rights stay. Throws vp::HostError if the host has no room.
  void leave_to_parent();
  /// Makes it what a new one for `what` would be: zeroed and accessible, but for the variables of
  /// programs, which keep what is in them. False, without any change: other programs are loaded
  /// now, or there is no file.
  bool renew(const std::string& what);

 private:
  /// Pages of data() that are mapped.
  struct Piece {
    std::uint64_t first, end;
    bool of_program;  ///< variables of a program

    bool operator==(const Piece& other) const {
      return first == other.first && end == other.end && of_program == other.of_program;
    }
  };
  std::vector<Piece> pieces_in(const std::string& what) const;
  void map(const std::string& what, const Piece& piece);
  void unmap(const Piece& piece);
  unsigned char* behind(std::uint64_t address) const {
    return second_view_ + (address - reinterpret_cast<std::uintptr_t>(data_));
  }

  unsigned char* data_;
  unsigned char* second_view_ = nullptr;
  std::uint64_t size_;
  int descriptor_;
  std::vector<Piece> pieces_;
};

/// The FixedMapping of a platform. In a process that builds one after the other, the next takes
/// over the last one's: to map megabytes of variables anew takes as long as to simulate a frame.
class PlatformMapping {
 public:
  /// As FixedMapping.
  PlatformMapping(const std::string& what, std::uint64_t first, std::uint64_t size);
  ~PlatformMapping();
  PlatformMapping(const PlatformMapping&) = delete;
  PlatformMapping& operator=(const PlatformMapping&) = delete;

  FixedMapping* operator->() const { return mapping_.get(); }

  /// Whether mappings stay from here on when their platform ends, in this process, not in those
  /// that it forks. At the start they do not.
  static void keep(bool wanted);
  /// Ends those that no platform has: something else wants their addresses.
  static void end_unused();

 private:
  std::unique_ptr<FixedMapping> mapping_;
};

/// `count` zeroed values, of which those take memory that were touched, page by page.
template <class T>
class SparseArray {
  static_assert(std::is_trivially_copyable_v<T>, "its bytes are zero at the start");

 public:
  explicit SparseArray(std::size_t count) : bytes_(count * sizeof(T)) {
    void* const got = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (got == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<T*>(got);
  }
  ~SparseArray() { munmap(data_, bytes_); }
  SparseArray(const SparseArray&) = delete;
  SparseArray& operator=(const SparseArray&) = delete;

  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* data() { return data_; }
  const T* data() const { return data_; }

 private:
  std::size_t bytes_;
  T* data_;
};

/// Hands out memory for DMA buffers from one range of bus addresses, front to back; nothing is
/// given back one by one.
class DmaAllocator {
 public:
  /// The CPU's cache line: buffers never share one, so that cache maintenance of one cannot affect
  /// another.
  static constexpr std::uint32_t cache_line = 32;

  /// The range [first, end).
  DmaAllocator(std::uint64_t first, std::uint64_t end) : first_(first), end_(end), next_(first) {}

  /// Bus address of `size` bytes, aligned to `alignment` (a power of two; at least a cache line).
  /// Empty if the range is used up or the alignment is no power of two.
  std::optional<std::uint32_t> allocate(std::size_t size, std::size_t alignment);
  /// All of it is free again.
  void reset() {
    next_ = first_;
    buffers_.clear();
  }

  /// A buffer as it was asked for: [first, end).
  struct Buffer {
    std::uint64_t first, end;
  };
  /// The buffer that `address` lies in, if it lies in one.
  std::optional<Buffer> buffer_at(std::uint64_t address) const;

  std::uint64_t first() const { return first_; }
  std::uint64_t end() const { return end_; }
  std::uint64_t used() const { return next_ - first_; }

 private:
  std::uint64_t first_;
  std::uint64_t end_;
  std::uint64_t next_;
  std::vector<Buffer> buffers_;  ///< by address
};

/// The DDR memory: host memory at the same numeric addresses as on the chip, so that a pointer of
/// the program and a bus address are one number. Map it with vp::Router::Addresses::absolute.
///
/// Accesses take no time here: the latency from a port to the memory belongs to the port (it is
/// published for the whole path).
class Ddr : public vp::MemoryTarget {
 public:
  explicit Ddr(sc_core::sc_module_name name);
  const char* kind() const override { return "ps::Ddr"; }

  /// First byte: the lowest megabyte belongs to the on-chip memory (UG585 4.1).
  static constexpr std::uint64_t base = 0x0010'0000;

  vp::Parameter<std::uint64_t> size;
  vp::Parameter<std::uint64_t> dma_base;

  vp::Counter reads{"reads", "read transactions, direct access included"};
  vp::Counter writes{"writes", "write transactions, direct access included"};
  vp::Counter bytes_read{"bytes_read", "bytes read by devices"};
  vp::Counter bytes_written{"bytes_written", "bytes written by devices"};

  using MemoryTarget::contains;
  /// One past the last address.
  using MemoryTarget::end;
  /// Host pointer of a bus address; the same number. Throws vp::ProtocolError if it is outside.
  unsigned char* at(std::uint32_t address, std::uint64_t bytes = 1) const;
  /// The same byte for accesses not by the program: devices and the test bench.
  unsigned char* behind(std::uint32_t address, std::uint64_t bytes = 1) const;
  /// A file with all of it, for another process to map; -1: the host allows none of that size.
  int descriptor() const { return memory_->descriptor(); }
  /// Counts one transaction that went through direct access.
  void account(tlm::tlm_command command, std::uint64_t bytes);

  /// Memory for DMA buffers: from `dma_base` to the end.
  DmaAllocator& dma_memory() { return dma_memory_; }
  /// All of it is 0 and free again.
  void clear();
  /// FixedMapping::leave_to_parent().
  void leave_to_parent() { memory_->leave_to_parent(); }

 private:
  void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;

  PlatformMapping memory_;
  DmaAllocator dma_memory_;
};

/// Memory for the stacks of programs, at the end of the addresses of DDR: no address that a program
/// names lies there on a board with less.
class StackMemory : public vp::MemoryTarget {
 public:
  /// `bytes` of it, a multiple of 4096.
  StackMemory(sc_core::sc_module_name name, std::uint64_t bytes);
  const char* kind() const override { return "ps::StackMemory"; }

  static constexpr std::uint64_t ddr_end = 0x4000'0000;  // UG585 table 4-1
  using MemoryTarget::end;
  /// FixedMapping::leave_to_parent().
  void leave_to_parent() { memory_->leave_to_parent(); }

 private:
  void answered(const tlm::tlm_generic_payload&, sc_core::sc_time&) override {}

  PlatformMapping memory_;
};

/// The on-chip memory, 256 KiB at the top of the address space, as boot code leaves it (UG585
/// chapter 29). Map it with relative addresses.
///
/// An access takes its latency for the first 8 bytes and a CPU cycle for each further 8.
class Ocm : public vp::MemoryTarget {
 public:
  static constexpr std::uint64_t base = 0xFFFC'0000;
  static constexpr std::uint64_t size = 0x4'0000;

  Ocm(sc_core::sc_module_name name, const vp::Clock& cpu_clock);
  const char* kind() const override { return "ps::Ocm"; }

  vp::Parameter<std::uint32_t> read_cycles;
  vp::Parameter<std::uint32_t> write_cycles;

  vp::Counter reads{"reads", "read transactions"};
  vp::Counter writes{"writes", "write transactions"};

  /// The bytes, for loading and for tests.
  std::vector<unsigned char>& contents() { return memory_; }
  /// Where its quarters are (OCM_CFG.RAM_HI: a bit for each, 1 is at the top). Without it all are
  /// at the top.
  void follow(std::function<std::uint32_t()> at_top) { at_top_ = std::move(at_top); }
  /// The quarter with the byte at `offset` is at the top.
  bool is_at_top(std::uint64_t offset) const;

 private:
  friend class OcmLow;
  void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;
  void take_time(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  sc_core::sc_time latency(bool read) const override;

  const vp::Clock& cpu_clock_;
  std::vector<unsigned char> memory_;
  std::function<std::uint32_t()> at_top_;
  bool warned_ = false;
};

/// The quarters of the on-chip memory that are at address 0, as all but the last are after boot
/// (UG585 chapter 29). Map it with relative addresses.
class OcmLow : public vp::MemoryTarget {
 public:
  OcmLow(sc_core::sc_module_name name, Ocm& ocm);
  const char* kind() const override { return "ps::OcmLow"; }

 private:
  tlm::tlm_response_status check(const tlm::tlm_generic_payload& payload) const override;
  void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;
  /// Software moves it: every access is looked at.
  bool get_direct_mem_ptr(tlm::tlm_generic_payload&, tlm::tlm_dmi&) override { return false; }

  Ocm& ocm_;
};

}  // namespace ps

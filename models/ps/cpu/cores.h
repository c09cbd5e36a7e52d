#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <hal/hal.h>

namespace ps {

class Cpu;

/// Finds accesses of two cores to the same memory that nothing orders: no lock, no event, no
/// exclusive access, no start, no software interrupt lies between them (vector clocks). Whether
/// they come one after the other in this run does not matter.
class RaceDetector {
 public:
  static constexpr unsigned cores = 2;

  /// A core that acquires `key` later sees what `core` did until now.
  void release(unsigned core, const volatile void* key);
  void acquire(unsigned core, const volatile void* key);

  struct Access {
    unsigned core = 0;
    bool write = false;
    std::uint64_t ps = 0;
    std::vector<std::uintptr_t> calls;  ///< under way in the program
  };
  /// An access to [first, end). Returns one of the other core that it races with, if there is one.
  std::optional<Access> access(std::uintptr_t first, std::uintptr_t end, const Access& access);

 private:
  using Clocks = std::array<std::uint64_t, cores>;  ///< by core: how far its course is known
  struct Seen {
    std::uint64_t clock = 0;  ///< of the core that made the access; 0: there was none
    Access access;
  };
  /// The last accesses to bytes up to `end`.
  struct Cell {
    std::uintptr_t end = 0;
    std::array<Seen, cores> reads, writes;
  };
  using Cells = std::map<std::uintptr_t, Cell>;

  void split(std::uintptr_t at);

  std::array<Clocks, cores> clocks_{Clocks{1, 0}, Clocks{0, 1}};
  std::map<const volatile void*, Clocks> released_;
  Cells cells_;  ///< by first byte; none overlaps another
};

/// The exclusive monitor of a core: whether the word that it reserved may have been written since.
class ExclusiveMonitor {
 public:
  /// Reserves `word`, which held `value`.
  void reserve(const volatile std::uint32_t* word, std::uint32_t value) {
    word_ = word;
    value_ = value;
  }
  void clear() { word_ = nullptr; }
  /// A core wrote `word`: a reservation of the same cache line is lost.
  void note_write(const volatile std::uint32_t* word) {
    if (word_ && line_of(word_) == line_of(word)) clear();
  }
  /// `word` is reserved, and holds what it did then: stores outside the HAL, which are not
  /// observed, show only as a changed word. Ends the reservation.
  bool take(const volatile std::uint32_t* word) {
    return std::exchange(word_, nullptr) == word && value_ == *word;
  }

 private:
  static std::uintptr_t line_of(const volatile std::uint32_t* word) {
    constexpr std::uintptr_t granule = 32;
    return reinterpret_cast<std::uintptr_t>(word) / granule;
  }

  const volatile std::uint32_t* word_ = nullptr;  ///< null: nothing is reserved
  std::uint32_t value_ = 0;
};

/// What the cores of a processor share.
struct Cores {
  std::vector<Cpu*> all;  ///< by number
  RaceDetector races;
  std::set<std::pair<std::uintptr_t, std::uintptr_t>> told_races;  ///< by calls
  bool told_start = false;  ///< that core 1 is started where no code is
  /// A lock that is taken.
  struct Holder {
    Cpu* core;
    std::uint64_t since_ps;
  };
  std::map<const hal_lock*, Holder> holders;
};

}  // namespace ps

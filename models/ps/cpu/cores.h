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

/// What the cores of a processor share.
struct Cores {
  std::vector<Cpu*> all;  ///< by number
  RaceDetector races;
  std::set<std::pair<std::uintptr_t, std::uintptr_t>> told_races;  ///< by calls
  /// A lock that is taken.
  struct Holder {
    Cpu* core;
    std::uint64_t since_ps;
  };
  std::map<const hal_lock*, Holder> holders;
};

}  // namespace ps

#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ps {

/// Code of a program as it is mapped, which is x86-64 here; of other hosts' nothing is known.
class MachineCode {
 public:
  /// Bytes [first, end), readable.
  MachineCode(std::uintptr_t first, std::uintptr_t end) : first_(first), end_(end) {}

  bool contains(std::uintptr_t address) const { return first_ <= address && address < end_; }

  /// Where a basic block begins: behind its call of the tracer.
  struct Block {
    std::uintptr_t start;
    /// What it takes on a Cortex-A9, in units of 1/4 cycle, at least 1.
    std::uint32_t cost;
  };
  static constexpr unsigned units_per_cycle = 4;

  /// All blocks that call `tracer` (-fsanitize-coverage=trace-pc), by address. What lies between
  /// two calls belongs to the first, what a function does before its first call to that one.
  std::vector<Block> blocks(std::uintptr_t tracer) const;

  /// Behind a call of the tracer there are no-ops, which with it make room for `charged_bytes`.
  static bool has_room(std::uintptr_t start);
  /// Of what takes its place, CodeCharge, and how it begins: a subtraction from memory.
  static constexpr std::size_t charged_bytes = 17;
  static constexpr unsigned char charged_begin[] = {0x48, 0x81, 0x2D};

  /// Where a function may get to.
  enum class Reach {
    returns,   ///< a return, or something that cannot be followed
    loops,     ///< it loops for ever, whatever its conditions say
    straight,  ///< it loops for ever, without any condition
  };
  /// Of the function that contains `from`, once it continues there. A call is taken to return.
  Reach reach(std::uintptr_t from) const;

 private:
  std::uintptr_t first_, end_;
};

}  // namespace ps

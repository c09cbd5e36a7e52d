#pragma once

#include <cstdint>

namespace ps {

/// An instruction of the program that loads or stores a register of a device through a pointer, and
/// the processor's state before it. It is carried out outside of the signal handler: an access
/// takes simulated time, in which other processes run. x86-64 only.
struct PointerAccess {
  std::uint64_t registers[16];  ///< by the number that instructions give them
  std::uint64_t instruction, flags;
  unsigned char vectors[16][16];  ///< xmm0 to xmm15
  std::uintptr_t address;         ///< that it accesses

  /// What the instruction does: moves `bytes` bytes (1, 2, 4, 8 or 16).
  struct Move {
    bool store;
    unsigned bytes;
    unsigned char data[16];  ///< of a store
  };
  /// Why it cannot be carried out; null: it can, and `move` says what it does.
  const char* decode(Move& move) const;
  /// A register of vectors or real numbers takes part. After decode().
  bool is_vector() const;
  /// Completes a load of `move.data`, or a store: changes the state to that behind the instruction.
  void complete(const Move& move);

  /// Lets the code that faulted at `context` (a ucontext_t) continue in `make`, on its own stack,
  /// instead of the instruction. `make` ends with resume(). False: not on this host.
  static bool divert(void* context, std::uintptr_t address, void (*make)(PointerAccess&));
  /// Continues with the state of this object.
  [[noreturn]] void resume() const;
};

}  // namespace ps

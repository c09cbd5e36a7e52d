// Copies to and from registers. The C library copies with the widest instructions that this
// computer has; on the board, and here, a device sees words, lowest address first.
#include <string.h>

#include <cstdint>

#include "client.h"

namespace shim {

namespace {

using Byte = unsigned char;
/// Four bytes at any address, in one access.
using Word = std::uint32_t __attribute__((aligned(1), may_alias));

/// Bytes of the next access on a device's side: whole words as far as they go.
std::size_t next_size(const void* device, std::size_t size) {
  const bool is_whole = reinterpret_cast<std::uintptr_t>(device) % sizeof(Word) == 0;
  return is_whole && size >= sizeof(Word) ? sizeof(Word) : 1;
}

void move_one(Byte* to, const Byte* from, std::size_t size) {
  if (size == sizeof(Word)) {
    *reinterpret_cast<volatile Word*>(to) = *reinterpret_cast<const volatile Word*>(from);
  } else {
    *const_cast<volatile Byte*>(to) = *const_cast<const volatile Byte*>(from);
  }
}

void copy(void* target, const void* source, std::size_t size) {
  auto* to = static_cast<Byte*>(target);
  const auto* from = static_cast<const Byte*>(source);
  const bool is_target = are_registers(target);
  while (size != 0) {
    const std::size_t one = next_size(is_target ? to : from, size);
    move_one(to, from, one);
    to += one;
    from += one;
    size -= one;
  }
}

/// The same from the end on, for what would be written before it is read.
void copy_back(void* target, const void* source, std::size_t size) {
  auto* to = static_cast<Byte*>(target);
  const auto* from = static_cast<const Byte*>(source);
  while (size != 0) {
    const std::size_t whole = size >= sizeof(Word) ? sizeof(Word) : 1;
    const std::size_t one = next_size(to + size - whole, whole) == whole ? whole : 1;
    size -= one;
    move_one(to + size, from + size, one);
  }
}

void fill(void* target, int value, std::size_t size) {
  constexpr std::uint32_t in_each_byte = 0x01010101;
  const std::uint32_t word = in_each_byte * static_cast<Byte>(value);
  auto* to = static_cast<Byte*>(target);
  while (size != 0) {
    const std::size_t one = next_size(to, size);
    move_one(to, reinterpret_cast<const Byte*>(&word), one);
    to += one;
    size -= one;
  }
}

}  // namespace

}  // namespace shim

using shim::are_registers;

#pragma GCC visibility push(default)
extern "C" {

void* memcpy(void* to, const void* from, size_t size) noexcept {
  if (!are_registers(to) && !are_registers(from)) return REAL(memcpy)(to, from, size);
  shim::copy(to, from, size);
  return to;
}

void* memmove(void* to, const void* from, size_t size) noexcept {
  if (!are_registers(to) && !are_registers(from)) return REAL(memmove)(to, from, size);
  const auto target = reinterpret_cast<std::uintptr_t>(to);
  const auto source = reinterpret_cast<std::uintptr_t>(from);
  if (source < target && target < source + size) {
    shim::copy_back(to, from, size);
  } else {
    shim::copy(to, from, size);
  }
  return to;
}

void* memset(void* to, int value, size_t size) noexcept {
  if (!are_registers(to)) return REAL(memset)(to, value, size);
  shim::fill(to, value, size);
  return to;
}

// Those of programs that are compiled with _FORTIFY_SOURCE: the C library ends those that write too
// much.
void* __memcpy_chk(void*, const void*, size_t, size_t) noexcept;
void* __memcpy_chk(void* to, const void* from, size_t size, size_t room) noexcept {
  const bool is_ours = size <= room && (are_registers(to) || are_registers(from));
  return is_ours ? memcpy(to, from, size) : REAL(__memcpy_chk)(to, from, size, room);
}

void* __memmove_chk(void*, const void*, size_t, size_t) noexcept;
void* __memmove_chk(void* to, const void* from, size_t size, size_t room) noexcept {
  const bool is_ours = size <= room && (are_registers(to) || are_registers(from));
  return is_ours ? memmove(to, from, size) : REAL(__memmove_chk)(to, from, size, room);
}

void* __memset_chk(void*, int, size_t, size_t) noexcept;
void* __memset_chk(void* to, int value, size_t size, size_t room) noexcept {
  const bool is_ours = size <= room && are_registers(to);
  return is_ours ? memset(to, value, size) : REAL(__memset_chk)(to, value, size, room);
}

}  // extern "C"
#pragma GCC visibility pop

#pragma once

#include <limits.h>

#include <cstdint>

namespace shim {

/// An open file description of the platform's.
struct Open {
  enum class Kind : std::uint8_t { none, memory, uio, buffer, attribute };
  Kind kind;
  bool sync;  ///< O_SYNC or O_DSYNC
  std::uint32_t number;
  std::uint64_t base, size;
  unsigned descriptors;  ///< that refer to it
  // Of an uio: an event that is set as long as there are interrupts that were not read.
  int event;
  bool is_set;
  bool silent;         ///< it has no interrupt: poll() finds an error at once, as with uio.c
  std::uint32_t seen;  ///< interrupts
  // Of an attribute: a file without a name, which takes what is written.
  char name[NAME_MAX + 1];
};

constexpr int most_open = 64;
using Opens = Open[most_open];
Opens& opens();

/// Null: another file.
Open* open_at(int descriptor);
Open& new_open(Open::Kind kind);
void give(int descriptor, Open& open);
void forget(int descriptor);

/// Where the number of a descriptor is kept that the application did not open; null: it is its own.
int* hidden(int descriptor);
/// A copy of a descriptor, with a number that applications do not come to by themselves.
int copy_out_of_the_way(int descriptor);

}  // namespace shim

#pragma once

#include <stdint.h>

// What a shared object with Verilated RTL (cmake: markervp_add_rtl) says of itself: plain C, so
// that it may be built with any compiler and Verilator.

#define RTL_INTERFACE 5
#define RTL_SYMBOL "markervp_rtl"

struct RtlPort {
  const char* name;
  uint32_t bits;      // kept in the smallest of 8, 16, 32 or 64 bits that holds them; more than
                      // 64: in words of 32 bits, the lowest first
  int output;         // as the module sees it
  const char* place;  // file:line
};

struct RtlParameter {
  const char* name;
  uint64_t value;
};

// What is said of a port. `what`: "info" and "parameter" are the values of X_INTERFACE_INFO and
// X_INTERFACE_PARAMETER in the source; "interface" is an entry of INTERFACES, of which `port` may
// be the prefix of several; "unseen" is a clock that lower() lowers; "registered", without a port,
// says that no input reaches an output but through an edge, and "edge" is an input beside the
// clocks whose own edges count; "signals", without a port, is how many bits the signals inside
// have.
struct RtlNote {
  const char* what;
  const char* port;
  const char* text;
};

// How the RTL ended itself.
struct RtlEnd {
  const char* why;    // "$finish", "Assertion failed in top.x: too many"
  const char* place;  // file:line; "" if unknown
};

struct RtlDescriptor {
  uint32_t interface;  // RTL_INTERFACE; the rest holds only if it is the same
  const char* ip;      // the IP that it replaces; "": a part of a design
  const char* top;     // its module
  const char* place;   // file:line
  uint32_t port_count;
  const RtlPort* ports;
  uint32_t parameter_count;
  const RtlParameter* parameters;
  uint32_t note_count;
  const RtlNote* notes;

  // Registers without reset start at 0 (seed 0), at 1 (seed 1), or at random. Inputs start at 0.
  void* (*create)(const char* name, uint64_t seed);
  void (*destroy)(void* model);
  // Null, unless the RTL ended itself: it can only be destroyed then.
  const struct RtlEnd* (*eval)(void* model);
  // Whether its assertions are checked from here on; at first they are. Null: it was built without.
  void (*check)(void* model, int on);
  // Its `final` blocks, at the end of a simulation. As eval().
  const struct RtlEnd* (*finish)(void* model);
  // All clocks are low again, as behind an eval() with them low, which is not needed: nothing in
  // the RTL waits for a clock to fall. Null: that is not known.
  void (*lower)(void* model);
  void* (*pin)(void* model, uint32_t port);  // where the value of a port is kept

  // All bytes that eval() depends on, pins included: while they stay the same, so does what it
  // does. 0 bytes: not all of them are known, and state() is not asked.
  uint64_t state_bytes;
  const void* (*state)(void* model);

  // SHA-256 of each source, 64 hexadecimal digits: figures of synthesis are those of the same ones.
  uint32_t source_count;
  const char* const* sources;

  // Writes what was counted of lines and toggles, as verilator_coverage reads it. Null: it was
  // built without.
  void (*write_coverage)(void* model, const char* file);
};

#ifdef VL_PRINTF
// Inside the object: what Verilator's runtime prints with.
int VL_PRINTF(const char* format, ...);
#endif

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace platform {

/// One thing that goes wrong in a run, as `inject` of the configuration lists it:
///
///   inject:
///     - {what: slverr, where: ps.interconnect_gp0.axi_dma_0, access: 3}
///     - {what: flip, address: 0x43000000, bit: 5, at: 1.2 ms}
///
/// Times are of the simulation. What a fault of a kind takes: docs/faults.md.
struct Fault {
  enum class What {
    slverr,    ///< a target answers an access with an error, after it did what was asked
    decerr,    ///< an access does not reach its target, and is answered with an error
    corrupt,   ///< a bit of what an access, or a beat of a stream, moves is wrong
    dropped,   ///< a beat of a stream is not seen by the slave
    repeated,  ///< a beat of a stream is seen twice by the slave
    tlast,     ///< TLAST of a beat is the opposite
    flip,      ///< a stored bit changes: memory, register
    stuck,     ///< a signal keeps a value, whatever its writer says
    lost,      ///< a rising edge of a signal is not seen: the signal stays low until it falls
    late,      ///< a rising edge of a signal is seen later
    spurious,  ///< a signal is high for a while, though its writer says low
    clock,     ///< a clock runs at another frequency from then on; 0: it stops
    input,     ///< bytes of an input are wrong
    torn,      ///< bytes of an input are those of the one before it
  };
  static constexpr std::uint64_t for_ever = ~std::uint64_t{0};

  What what = What::flip;
  std::string where = {};           ///< path in the hierarchy; "" for an address of the processor
  std::uint64_t at_ps = 0;          ///< it begins; accesses and edges count from then on
  std::uint64_t for_ps = for_ever;  ///< how long it lasts
  std::uint64_t by_ps = 0;          ///< `late`: how much
  std::uint64_t nth = 1;            ///< access, beat, edge or unit that meets it, from 1
  std::uint64_t count = 1;          ///< how many of these do; for_ever: all from then on
  enum class Of { accesses, reads, writes } of = Of::accesses;  ///< what `nth` counts
  bool has_address = false;
  std::uint64_t address = 0;  ///< the processor's, or a byte of a memory or an input
  bool has_bytes = false;
  std::uint64_t bytes = 0;  ///< `input`, `torn`: from `address` on; else all
  unsigned bit = 0;
  std::uint64_t value = 0;  ///< `stuck`: of the signal; `clock`: Hz; `input`: of each byte
  std::string text = {};    ///< as it was written, in one line

  bool is_of_input() const { return what == What::input || what == What::torn; }
  /// Whether it meets the n-th of what it counts.
  bool meets(std::uint64_t n) const { return n >= nth && (count == for_ever || n - nth < count); }
};

/// Reads the list of `inject`, "[{what: flip, …}, …]"; none for an empty text. Throws
/// vp::InputError "ORIGIN:line: …" for an unknown kind, a key that the kind does not take or lacks,
/// and a value out of range.
std::vector<Fault> parse_faults(const std::string& text, const std::string& origin);

}  // namespace platform

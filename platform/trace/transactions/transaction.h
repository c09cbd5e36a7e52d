#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace platform::trace {

/// What a bus is. The names are those of `--kind`.
enum class BusKind : std::uint8_t {
  axi4,
  axi4_lite,
  axi_stream,
  apb,
  wishbone,
  uart,
  i2c,
  spi,
  irq
};
constexpr std::size_t bus_kinds = 9;

/// "axi4-lite".
const char* bus_kind_name(BusKind kind);
/// Throws vp::InputError with the nearest name.
BusKind bus_kind_named(const std::string& name);

/// A rule that was broken, under the field's name for it: "AXI4_ERRM_ARVALID_STABLE".
struct Violation {
  std::string rule;
  std::uint64_t ps = 0;
  std::uint64_t cycle = 0;  ///< of the interface's clock, from 0; 0 without a clock
  std::string detail;       ///< "3 beats of 4"
};

/// One transfer on a bus: a burst of AXI, a packet of a stream, an access of APB, a byte of a UART.
/// All times of a clocked bus are those of its sampling edges.
struct Transaction {
  std::uint32_t interface = 0;  ///< place in Interfaces
  const char* operation = "";   ///< "read", "write", "packet", "byte", "interrupt", "transfer"
  std::optional<std::uint64_t> id, address;
  std::uint64_t beats = 0;                       ///< asked for; of a packet those it has
  std::uint64_t beats_done = 0;                  ///< that passed
  std::optional<std::uint64_t> size;             ///< bytes a beat
  const char* burst = "";                        ///< "FIXED", "INCR", "WRAP"
  std::uint64_t bytes = 0;                       ///< that passed: enabled ones
  std::vector<std::string> data;                 ///< the first beats, in hexadecimal
  std::uint64_t data_hash = 0xcbf29ce484222325;  ///< FNV-1a over the digits of all beats
  std::string strobe;         ///< of all beats, in hexadecimal; "mixed" if they differ; empty: none
  const char* response = "";  ///< the worst: "OKAY", "EXOKAY", "SLVERR", "DECERR", "ACK", "NACK" …

  std::uint64_t begin_ps = 0;                ///< the request is valid
  std::optional<std::uint64_t> accepted_ps;  ///< the request is accepted
  std::optional<std::uint64_t> first_data_ps, last_data_ps;
  std::optional<std::uint64_t> end_ps;  ///< the last response is accepted; none: open at the end
  std::uint64_t begin_cycle = 0, end_cycle = 0;
  std::uint64_t request_wait = 0, data_wait = 0, response_wait = 0;  ///< clocks of VALID alone
  std::uint64_t outstanding = 0;  ///< earlier ones of this interface and operation not yet over
  std::uint64_t overtakes = 0;    ///< of them those that were still not over when it was
  std::string note;
  std::vector<Violation> violations;

  void add_note(const std::string& text) { note += (note.empty() ? "" : "; ") + text; }
};

/// A channel that waits when the trace ends, or a request without an answer.
struct Wait {
  enum class State : std::uint8_t {
    wants,    ///< VALID without READY: the sender waits for the receiver
    starved,  ///< something is outstanding: the receiver waits for the sender
  };
  std::uint32_t interface = 0;
  State state = State::wants;
  std::string channel;       ///< "AR", "B", "T"
  bool for_manager = false;  ///< it is the manager that is waited for, else the subordinate
  std::string what;          ///< "ARREADY for the read of 0x6000"
  std::uint64_t since_ps = 0;
  std::uint64_t clocks = 0;                       ///< since then
  std::optional<std::uint64_t> idle_since_cycle;  ///< READY has been low since then
};

}  // namespace platform::trace

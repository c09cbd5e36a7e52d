#pragma once

#include <cstdint>
#include <functional>
#include <systemc>
#include <tlm>
#include <vector>

#include <axi/queue.h>
#include <axi/wires.h>
#include <tlm_utils/simple_target_socket.h>
#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/parameter.h>

namespace axi {

/// TLM-2.0 transactions as AXI4 or AXI4-Lite at the pins of a slave: the manager of the link.
///
/// A transaction becomes INCR bursts, split at 4 KiB and at the limit of beats only; a streaming
/// width that is a size of beats becomes FIXED bursts, another one a burst for each of its rounds.
/// An access within one word has the size of what it touches; one over several words reads whole
/// words. Least times: a read of n beats passes on clocks 2 to n + 1 behind the first edge at or
/// after its delay, a write is answered on clock n + 1. b_transport returns when the last response
/// has passed; an address of more bits than there are pins loses them, with a warning. The worst
/// one of all beats is the answer, DECERR as TLM_ADDRESS_ERROR_RESPONSE and SLVERR as
/// TLM_GENERIC_ERROR_RESPONSE.
///
/// The owner calls sample() before an edge of the clock and drive() behind it.
class TlmToPins final : public sc_core::sc_module {
 public:
  /// `begin`: called when a transaction has come, with whether an edge has just run: the pins
  /// change behind that one, so drive() is called at once; otherwise behind the next one.
  using Begin = std::function<void(bool behind_edge)>;
  TlmToPins(sc_core::sc_module_name name, const vp::Clock& clock, const Shape& shape, Wires& wires,
            Begin begin);
  const char* kind() const override { return "axi::TlmToPins"; }

  tlm_utils::simple_target_socket<TlmToPins> socket;

  vp::Parameter<std::uint32_t> time_limit{
      "time_limit",
      100'000,
      vp::Unit::cycles,
      {16, 1'000'000'000},
      vp::Source::assumed,
      "an access that is not answered in that time ends the run: on the chip the bus would hang"};

  vp::Counter bursts{"bursts", "bursts sent"};
  vp::Counter beats{"beats", "data beats passed"};
  vp::Counter stalls{"stalls", "edges on which VALID waited for READY"};

  void sample();
  void drive();
  /// No transaction is under way: edges change nothing.
  bool idle() const { return open_ == 0; }

 private:
  struct Request {
    tlm::tlm_generic_payload& payload;
    unsigned unanswered = 0;  ///< bursts
    Response response = Response::okay;
    bool done = false;
  };
  /// A burst, and which bytes of the payload it moves.
  struct Burst {
    Address address;
    unsigned offset, bytes;
    Request* request;
  };
  /// Bytes of one beat: lanes of the bus, and where they are in the payload.
  struct Span {
    unsigned lane, offset, bytes;
  };

  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);
  tlm::tlm_response_status objection(const tlm::tlm_generic_payload& payload) const;
  void check_address(const tlm::tlm_generic_payload& payload);
  void wait_for(Request& request);
  [[noreturn]] void report_hang(const Request& request) const;
  std::vector<Burst> split(Request& request) const;
  void add_linear(std::vector<Burst>& bursts, Request& request, unsigned offset,
                  unsigned bytes) const;
  void add_fixed(std::vector<Burst>& bursts, Request& request) const;
  Span span(const Burst& burst, unsigned beat) const;
  void answer(const Burst& burst, Response response);
  void sample_writes();
  void sample_reads();
  void drive_data();

  const vp::Clock& clock_;
  const Shape shape_;
  const Strobes all_lanes_;
  Wires& wires_;
  const Begin begin_;

  Queue<Burst> aw_, w_, b_, ar_, r_;  ///< bursts that wait for each channel, oldest first
  unsigned w_beat_ = 0, r_beat_ = 0;  ///< of the oldest one
  unsigned open_ = 0;                 ///< requests
  bool warned_ = false;               ///< of addresses beyond its pins
};

}  // namespace axi

#pragma once

#include <tlm_utils/simple_target_socket.h>
#include <cstdint>
#include <string>
#include <systemc>
#include <tlm>

#include <vp/mm_link.h>
#include <vp/register_route.h>

namespace vp {

class Clock;

/// A part of a bus with one way in and one way out, on which accesses take time: a port between two
/// clock domains, the way to the registers of a chip.
///
/// A derived class says how long an access takes. Both ways through it follow from that: the
/// transport call, in which the time passes, and the register route. Debug accesses pass at once.
/// Direct memory access is refused, as an access takes time.
class Bridge : public sc_core::sc_module, private BusStage {
 public:
  tlm_utils::simple_target_socket<Bridge> socket;
  MmLink link{"link"};  ///< bind link.socket to what lies behind

 protected:
  /// When a request leaves that is ready to: at once, or at the next edge of the clock.
  enum class Leaves { at_once, on_an_edge };

  /// The times of accesses follow from the frequency of `clock`.
  Bridge(sc_core::sc_module_name name, const Clock& clock, Leaves leaves);

  /// One access, in ps.
  struct Times {
    std::uint64_t request;  ///< until it is ready to leave
    std::uint64_t whole;    ///< from its start the answer takes at least that long,
    std::uint64_t rest;     ///< and from what lies behind at least that long
  };
  /// As the clock runs now. Asked again only when its frequency has changed.
  virtual Times times(bool read) const = 0;
  const Clock& clock() const { return clock_; }

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);

  void enter(bool read, std::uint64_t start_ps, Passage& passage) const final;
  std::uint64_t leaves(std::uint64_t earliest_ps) const final;
  std::uint64_t longest_wait_ps() const final;
  std::string obstacle() const final;

  const Clock& clock_;
  const Leaves leaves_;
  mutable Times read_{}, write_{};
  mutable std::uint64_t hertz_ = 0;  ///< for which these are
};

}  // namespace vp

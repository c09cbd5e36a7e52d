#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <tlm>
#include <vector>

#include <tlm_utils/multi_passthrough_target_socket.h>
#include <tlm_utils/simple_target_socket.h>
#include <vp/counter.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>
#include <vp/register_route.h>

namespace vp {

class Clock;

/// A memory-mapped interconnect: any number of initiators, and targets by address.
///
///   router.map("axi_gpio_0", 0x4120'0000, 0x1'0000).bind(axi_gpio_0.s_axi.socket);
///
/// A miss, and an access that leaves its region, are answered with TLM_ADDRESS_ERROR_RESPONSE (AXI:
/// DECERR). Each region has a named link below the router. The address of a payload is restored
/// after every call.
class Router : public sc_core::sc_module, private BusStage {
 public:
  /// What a target sees as address.
  enum class Addresses {
    relative,  ///< the offset from the region's base
    absolute,  ///< the address as the router got it
  };

  /// One entry of the address map.
  struct Region {
    std::string name;
    std::uint64_t base;
    std::uint64_t size;
    Addresses addresses;
    MmLink* link;

    std::uint64_t last() const { return base + size - 1; }
    std::uint64_t translation() const { return addresses == Addresses::relative ? base : 0; }
  };

  /// The latencies count cycles of `clock`; without clock they are 0 and not configurable.
  explicit Router(sc_core::sc_module_name name, const Clock* clock = nullptr);
  ~Router() override;
  const char* kind() const override { return "vp::Router"; }

  tlm_utils::multi_passthrough_target_socket<Router> socket;

  Counter decode_errors{"decode_errors", "transactions to an address where nothing is mapped"};

  /// Maps `size` bytes from `base`. Returns the socket to bind to the target. Throws InputError if
  /// the region overlaps another, is empty, or passes the end of the 64-bit address space.
  virtual tlm_utils::simple_initiator_socket<MmLink>& map(
      const std::string& region_name, std::uint64_t base, std::uint64_t size,
      Addresses addresses = Addresses::relative);

  /// The address map, by address.
  const std::vector<Region>& regions() const { return regions_; }
  /// The region that holds `address`, or null.
  const Region* find(std::uint64_t address) const;

 private:
  void before_end_of_elaboration() override;
  void b_transport(int initiator, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  unsigned transport_dbg(int initiator, tlm::tlm_generic_payload& payload);
  bool get_direct_mem_ptr(int initiator, tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);
  void invalidate(const MmLink& link, std::uint64_t first, std::uint64_t last);
  void enter(bool read, std::uint64_t start_ps, Passage& passage) const override;
  bool takes_time() const;
  std::uint64_t access_time_ps(bool read) const;

  const Clock* clock_;
  std::unique_ptr<Parameter<std::uint32_t>> read_latency_;
  std::unique_ptr<Parameter<std::uint32_t>> write_latency_;
  std::vector<Region> regions_;
  std::vector<std::unique_ptr<MmLink>> links_;
};

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
  [[gnu::noinline]] void follow_clock() const;
  std::uint64_t leaves(std::uint64_t earliest_ps) const final;
  std::uint64_t longest_wait_ps() const final;
  std::string obstacle() const final;

  const Clock& clock_;
  const Leaves leaves_;
  mutable Times read_{}, write_{};
  mutable std::uint64_t hertz_ = 0;  ///< for which these are
};

}  // namespace vp

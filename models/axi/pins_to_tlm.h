#pragma once

#include <cstdint>
#include <deque>
#include <systemc>
#include <tlm>
#include <vector>

#include <axi/queue.h>
#include <axi/wires.h>
#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/parameter.h>
#include <xilinx/axi_dma/memory_port.h>

namespace axi {

/// AXI4 or AXI4-Lite at the pins of a master as TLM-2.0 transactions: the subordinate of the link.
///
/// A burst is one transaction, of a WRAP burst that begins inside its block two. A FIXED burst has
/// the bytes of a beat as its streaming width; strobes become byte enables. The target is called
/// when the last write beat, or the read address, has passed, once for each burst; its error is the
/// response of each beat that it concerns: TLM_ADDRESS_ERROR_RESPONSE as DECERR, every other one as
/// SLVERR. Bursts of one direction are answered in their order, which is legal for all IDs. An
/// exclusive access is answered with OKAY: it has not succeeded.
///
/// The owner calls sample() before an edge of the clock and drive() behind it.
class PinsToTlm final : public sc_core::sc_module {
 public:
  PinsToTlm(sc_core::sc_module_name name, const vp::Clock& clock, const Shape& shape, Wires& wires);
  const char* kind() const override { return "axi::PinsToTlm"; }

  /// The way to the memory, for each direction one.
  xilinx::MemoryPort read, write;

  vp::Parameter<std::uint32_t> read_latency{
      "read_latency",
      20,
      vp::Unit::cycles,
      {1, 10'000},
      vp::Source::measured,
      "read address to first data; DDR through a high performance port, 100 MHz "
      "(pynqz2-ram-tester: about 21 for bursts of 16)"};
  vp::Parameter<std::uint32_t> write_latency{
      "write_latency",     20,
      vp::Unit::cycles,    {1, 10'000},
      vp::Source::assumed, "last write data to write response; as for reads"};
  vp::Parameter<std::uint32_t> outstanding{
      "outstanding",
      8,
      vp::Unit::none,
      {1, 64},
      vp::Source::assumed,
      "bursts of each direction that wait for their answer; READY is low then"};
  vp::Parameter<std::uint32_t> early_data{
      "early_data",        32,
      vp::Unit::none,      {1, 1024},
      vp::Source::assumed, "write beats that are taken before their address; WREADY is low then"};

  vp::Counter bursts{"bursts", "bursts received"};
  vp::Counter beats{"beats", "data beats passed"};
  vp::Counter stalls{"stalls", "edges on which the master's VALID waited for READY"};

  void sample();
  void drive();
  /// Nothing is under way: edges change nothing until the master sends something.
  bool idle() const {
    return requests_.empty() && early_.empty() && reads_.empty() && writes_.empty();
  }

 private:
  struct WriteBeat {
    Data data;
    Strobes strobes;
  };
  /// A transaction of a burst: `bytes` of its data from `offset` on.
  struct Part {
    std::uint64_t address;
    unsigned offset, bytes, width;
  };
  struct Burst {
    explicit Burst(const Address& request);
    Address address;
    std::vector<Part> parts;
    std::vector<unsigned char> data;
    std::vector<unsigned char> enables;   ///< of a write with strobes that are not all set
    std::vector<Response> responses;      ///< of each part that is over
    bool called = false;                  ///< the next part is at the target
    unsigned beat = 0;                    ///< that passes next
    std::uint64_t begins = 0, ready = 0;  ///< edges: of the first beat; of the answer
    bool over() const { return responses.size() == parts.size(); }
    Response response_of(unsigned beat) const;
  };

  Address whole(Address request) const;
  void sample_requests(std::uint64_t cycle);
  void take_write_beats(std::uint64_t cycle);
  void take(const WriteBeat& beat, std::uint64_t cycle);
  void copy(Burst& burst, const WriteBeat& beat) const;
  void call_targets();
  void call(std::deque<Burst>& bursts, xilinx::MemoryPort& port, tlm::tlm_command command);
  void drive_read(std::uint64_t cycle);
  void tell_of_nothing(tlm::tlm_command command, std::uint64_t address);

  const vp::Clock& clock_;
  const Shape shape_;
  const Strobes all_lanes_;
  Wires& wires_;

  std::deque<Burst> requests_;  ///< writes whose data are not complete
  Queue<WriteBeat> early_;      ///< write beats before their address
  std::deque<Burst> writes_, reads_;
  bool told_of_nothing_ = false;  ///< of an address without memory: once
};

}  // namespace axi

#pragma once

#include <cstdint>
#include <systemc>
#include <tlm>
#include <vector>

#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/mm_link.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace xilinx {

/// Build options of an AXI BRAM controller, as Vivado asks for them; the defaults of its
/// parameters.
struct AxiBramCtrlBuild {
  std::uint32_t memory_size = 8192;  ///< bytes
  bool axi4_lite = false;            ///< single words only
  bool single_port = false;          ///< reads and writes share a port of the memory
  std::uint32_t data_bytes = 4;      ///< of a beat: 4 to 128, a power of two
};

/// AXI BRAM controller v4.1 (PG078) with its memory, 32 to 1024 bits wide, without ECC.
///
/// A burst takes the latency and a clock a beat. The controller works on one burst at a time for
/// each port of the memory: the next one begins when it is free. Bursts obey AXI: at most 256
/// beats, none across a 4 KiB boundary; others are answered with TLM_BURST_ERROR_RESPONSE. Time is
/// annotated, never waited for. Direct access (DMI) is given, with latencies.
class AxiBramCtrl : public vp::MemoryTarget, public vp::SignalListener {
 public:
  /// Throws vp::InputError if the memory's size is no power of two.
  AxiBramCtrl(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
              const AxiBramCtrlBuild& build = {});
  const char* kind() const override { return "xilinx::AxiBramCtrl"; }

  vp::Parameter<std::uint32_t> memory_size;
  vp::Parameter<bool> axi4_lite;
  vp::Parameter<bool> single_port;
  vp::Parameter<std::uint32_t> read_latency;
  vp::Parameter<std::uint32_t> write_latency;

  tlm_utils::simple_target_socket<MemoryTarget>& s_axi = socket;
  vp::In<bool> s_axi_aresetn{"s_axi_aresetn"};  ///< may be left open

  vp::Counter reads{"reads", "read bursts"};
  vp::Counter writes{"writes", "write bursts"};
  vp::Counter beats{"beats", "words moved, direct access excluded"};

  /// The bytes, for loading and for tests. A reset of the controller leaves them alone.
  std::vector<unsigned char>& contents() { return memory_; }
  /// The memory has this many bytes at least, of which software reaches `memory_size`; before the
  /// simulation.
  void extend(std::size_t bytes);
  /// The memory is that of another controller, at another port of it; before the simulation.
  void share(AxiBramCtrl& other);

 private:
  void before_end_of_elaboration() override;
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  bool in_reset() const { return s_axi_aresetn.bound() && !s_axi_aresetn; }
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;
  tlm::tlm_response_status check(const tlm::tlm_generic_payload& payload) const override;
  void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;
  sc_core::sc_time latency(bool read) const override;
  bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) override;
  std::uint64_t take_port(bool read, std::uint64_t earliest_ps, std::uint64_t burst_beats);

  std::uint64_t beats_of(std::uint64_t address, std::uint64_t bytes) const;

  vp::Clock& clock_;
  const std::uint32_t data_bytes_;
  std::vector<unsigned char> memory_;
  std::uint64_t read_free_ps_ = 0;   ///< from when the reading side is free
  std::uint64_t write_free_ps_ = 0;  ///< the same for writing; one port: equal
};

}  // namespace xilinx

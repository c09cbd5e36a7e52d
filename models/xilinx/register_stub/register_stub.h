#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <systemc>
#include <tlm>
#include <utility>

#include <tlm_utils/simple_target_socket.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/counter.h>
#include <vp/ip.h>
#include <vp/signal.h>

namespace xilinx {

/// What is in the place of an IP that has neither model nor RTL: each read of its registers gives
/// 0, writes are taken, streams swallow what comes and send nothing, outputs are 0. The first
/// access to each address is warned of. What it takes of the chip and how fast it is are unknown.
class RegisterStub : public sc_core::sc_module, public vp::Ip {
 public:
  /// One of its register interfaces.
  class Slave : public sc_core::sc_module {
   public:
    Slave(sc_core::sc_module_name name, RegisterStub& stub);

    tlm_utils::simple_target_socket<Slave> socket;

   private:
    void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned transport_dbg(tlm::tlm_generic_payload& payload);

    RegisterStub& stub_;
  };

  /// `ip` names what is missing: its VLNV.
  RegisterStub(sc_core::sc_module_name name, vp::Clock& clock, std::string ip);
  const char* kind() const override { return "xilinx::RegisterStub"; }

  const std::string& ip() const { return ip_; }
  /// Whether software used it, or a stream ran into it: results rest on it then.
  bool used() const;

  vp::Counter reads{"reads", "reads of its registers, which gave 0"};
  vp::Counter writes{"writes", "writes to its registers"};

  /// Its registers behind an interface: one call for each.
  Slave& add_slave(const std::string& interface);
  /// An output, which stays 0: the same one for every call with its name.
  vp::Signal<std::uint64_t>& output(const std::string& pin);
  /// A clock that it would make. Call it once for each.
  vp::Clock& add_clock(const std::string& pin, std::uint64_t hertz);
  /// A stream that ends in it, or begins there; `clock` is that of the other end.
  void take_stream(vp::AxiStream& link, vp::Clock& clock);
  void offer_stream(vp::AxiStream& link, vp::Clock& clock);

 private:
  /// Gives a clock its name.
  struct Oscillator : sc_core::sc_module {
    Oscillator(sc_core::sc_module_name name, vp::ClockScheduler& scheduler, std::uint64_t hertz)
        : sc_module(name), clk("clk", scheduler, hertz) {}
    vp::Clock clk;
  };

  vp::IpEstimate own_estimate() const override;
  void note(const Slave& slave, std::uint64_t address, bool read);

  vp::ClockScheduler& scheduler_;
  std::string ip_;
  std::deque<Oscillator> clocks_;
  std::deque<Slave> slaves_;
  std::deque<vp::Signal<std::uint64_t>> outputs_;
  std::deque<vp::StreamSink> sinks_;
  std::deque<vp::StreamSource> sources_;
  std::set<std::pair<const Slave*, std::uint64_t>> warned_;
};

}  // namespace xilinx

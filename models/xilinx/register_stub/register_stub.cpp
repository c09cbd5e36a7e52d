#include <xilinx/register_stub/register_stub.h>

#include <vp/report.h>
#include <vp/text.h>

#include <algorithm>
#include <cstring>

namespace xilinx {

namespace {

/// Addresses of one stub that are warned of; more are counted only.
constexpr std::size_t most_warnings = 32;

void answer(tlm::tlm_generic_payload& payload) {
  if (payload.is_read()) std::memset(payload.get_data_ptr(), 0, payload.get_data_length());
}

}  // namespace

RegisterStub::Slave::Slave(sc_core::sc_module_name name, RegisterStub& stub)
    : sc_module(name), socket("socket"), stub_(stub) {
  socket.register_b_transport(this, &Slave::b_transport);
  socket.register_transport_dbg(this, &Slave::transport_dbg);
}

void RegisterStub::Slave::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  answer(payload);
  stub_.note(*this, payload.get_address(), payload.is_read());
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

unsigned RegisterStub::Slave::transport_dbg(tlm::tlm_generic_payload& payload) {
  answer(payload);
  return payload.get_data_length();
}

RegisterStub::RegisterStub(sc_core::sc_module_name name, vp::Clock& clock, std::string ip)
    : sc_module(name), Ip(&clock), scheduler_(clock.scheduler()), ip_(std::move(ip)) {}

bool RegisterStub::used() const {
  const bool streamed = std::any_of(sinks_.begin(), sinks_.end(),
                                    [](const vp::StreamSink& sink) { return !sink.beats.empty(); });
  return streamed || reads.get() + writes.get() != 0;
}

RegisterStub::Slave& RegisterStub::add_slave(const std::string& interface) {
  const vp::HierarchyScope scope(*this);
  return slaves_.emplace_back(interface.c_str(), *this);
}

vp::Signal<std::uint64_t>& RegisterStub::output(const std::string& pin) {
  for (vp::Signal<std::uint64_t>& known : outputs_)
    if (known.basename() == pin) return known;
  const vp::HierarchyScope scope(*this);
  return outputs_.emplace_back(pin.c_str(), 64u);
}

vp::Clock& RegisterStub::add_clock(const std::string& pin, std::uint64_t hertz) {
  const vp::HierarchyScope scope(*this);
  return clocks_.emplace_back(pin.c_str(), scheduler_, hertz).clk;
}

void RegisterStub::take_stream(vp::AxiStream& link, vp::Clock& clock) {
  const vp::HierarchyScope scope(*this);
  sinks_.emplace_back((std::string(link.basename()) + "_sink").c_str(), clock).s_axis(link);
}

void RegisterStub::offer_stream(vp::AxiStream& link, vp::Clock& clock) {
  const vp::HierarchyScope scope(*this);
  sources_.emplace_back((std::string(link.basename()) + "_source").c_str(), clock).m_axis(link);
}

vp::IpEstimate RegisterStub::own_estimate() const {
  vp::IpEstimate estimate;
  estimate.known = false;
  estimate.source = "a stub is in the place of " + ip_;
  estimate.active_clocks = [] { return std::uint64_t{0}; };
  return estimate;
}

void RegisterStub::note(const Slave& slave, std::uint64_t address, bool read) {
  if (read) {
    ++reads;
  } else {
    ++writes;
  }
  if (warned_.size() >= most_warnings || !warned_.emplace(&slave, address).second) return;
  vp::warn(*this, "/markervp/register_stub/access",
           std::string(read ? "a read" : "a write") + " at offset " + vp::hex(address) + " of " +
               slave.basename() + ": " + ip_ +
               " has neither model nor RTL here, so reads give 0 and writes do nothing");
}

}  // namespace xilinx

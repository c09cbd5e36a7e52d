#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>

#include <algorithm>
#include <string>

#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/text.h>

namespace xilinx {

namespace {

constexpr std::uint64_t most_beats = 256;
constexpr std::uint64_t boundary = 4096;  // AXI: a burst never crosses it

}  // namespace

AxiBramCtrl::AxiBramCtrl(sc_core::sc_module_name name, vp::Clock& s_axi_aclk,
                         const AxiBramCtrlBuild& build)
    : MemoryTarget(name, "s_axi"),
      memory_size("memory_size", build.memory_size, vp::Unit::bytes, {2048, 4u << 20},
                  vp::Source::published, "bytes behind the controller, a power of two (PG078)"),
      axi4_lite("axi4_lite", build.axi4_lite, vp::Source::published,
                "build option AXI Protocol AXI4LITE: single words only (PG078)"),
      single_port("single_port", build.single_port, vp::Source::published,
                  "build option Number of BRAM Interfaces 1: reads and writes take turns (PG078)"),
      read_latency("read_latency", 3, vp::Unit::cycles, {1, 64}, vp::Source::assumed,
                   "clocks from the address to the first word"),
      write_latency("write_latency", 2, vp::Unit::cycles, {1, 64}, vp::Source::assumed,
                    "clocks from the address to the first word, and response"),
      clock_(s_axi_aclk),
      data_bytes_(build.data_bytes),
      memory_(memory_size, 0) {
  if ((memory_size & (memory_size - 1)) != 0) {
    throw vp::InputError(std::string(memory_size.name()) + " = " + std::to_string(memory_size) +
                         " B: must be a power of two");
  }
  show(memory_.data(), 0, memory_.size());
}

void AxiBramCtrl::extend(std::size_t bytes) {
  if (bytes > memory_.size()) memory_.resize(bytes);
  show(memory_.data(), 0, memory_size);
}

void AxiBramCtrl::share(AxiBramCtrl& other) {
  other.extend(memory_size);
  show(other.memory_.data(), 0, memory_size);
}

void AxiBramCtrl::before_end_of_elaboration() {
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this);
}

void AxiBramCtrl::on_change(vp::SignalBase&, std::uint32_t) {
  read_free_ps_ = write_free_ps_ = 0;
  if (in_reset()) s_axi->invalidate_direct_mem_ptr(0, memory_.size() - 1);
}

std::uint64_t AxiBramCtrl::beats_of(std::uint64_t address, std::uint64_t bytes) const {
  return (address % data_bytes_ + bytes + data_bytes_ - 1) / data_bytes_;
}

tlm::tlm_response_status AxiBramCtrl::check(const tlm::tlm_generic_payload& payload) const {
  const std::uint64_t address = payload.get_address();
  const std::uint64_t length = payload.get_data_length();
  const std::uint64_t span = std::min<std::uint64_t>(length, payload.get_streaming_width());
  const bool fits = length != 0 && beats_of(address, length) <= (axi4_lite ? 1 : most_beats) &&
                    address % boundary + span <= boundary;
  return fits ? tlm::TLM_OK_RESPONSE : tlm::TLM_BURST_ERROR_RESPONSE;
}

// Contention is arithmetic: a burst starts when the controller is free. Returns its end.
std::uint64_t AxiBramCtrl::take_port(bool read, std::uint64_t earliest_ps,
                                     std::uint64_t burst_beats) {
  std::uint64_t& free = read ? read_free_ps_ : write_free_ps_;
  const std::uint64_t start = clock_.edge_at_or_after(std::max(earliest_ps, free));
  const std::uint32_t latency = read ? read_latency : write_latency;
  const double cycles = static_cast<double>(latency) + static_cast<double>(burst_beats) - 1;
  free = start + clock_.duration_ps(cycles);
  if (single_port) read_free_ps_ = write_free_ps_ = free;
  return free;
}

void AxiBramCtrl::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  if (in_reset() || clock_.frequency_hz() == 0) {
    vp::warn(*this, "/markervp/axi_bram_ctrl/in_reset",
             vp::hex(payload.get_address()) + " accessed while the controller is " +
                 (in_reset() ? "held in reset" : "without clock") + ": it cannot answer");
    payload.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
    return;
  }
  MemoryTarget::b_transport(payload, delay);
}

void AxiBramCtrl::answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  if (!payload.is_response_ok()) return;
  const std::uint64_t burst_beats = beats_of(payload.get_address(), payload.get_data_length());
  beats.add(burst_beats);
  ++(payload.is_read() ? reads : writes);
  const std::uint64_t now = clock_.scheduler().now_ps();
  const std::uint64_t end = take_port(payload.is_read(), now + vp::to_ps(delay), burst_beats);
  delay = vp::from_ps(end - now);
}

sc_core::sc_time AxiBramCtrl::latency(bool read) const {
  return vp::from_ps(clock_.duration_ps(read ? read_latency : write_latency));
}

bool AxiBramCtrl::get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi) {
  if (!in_reset()) return MemoryTarget::get_direct_mem_ptr(payload, dmi);
  dmi.init();
  dmi.set_start_address(payload.get_address());
  dmi.set_end_address(payload.get_address());
  return false;
}

}  // namespace xilinx

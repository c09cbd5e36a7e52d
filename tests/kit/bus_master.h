#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <systemc>
#include <tlm>
#include <utility>

namespace kit {

/// A bus master that runs a script in a thread.
class BusMaster : public sc_core::sc_module {
 public:
  explicit BusMaster(sc_core::sc_module_name name) : sc_module(name), socket("socket") {
    SC_HAS_PROCESS(BusMaster);
    SC_THREAD(run);
    socket.register_invalidate_direct_mem_ptr(this, &BusMaster::invalidate);
  }

  tlm_utils::simple_initiator_socket<BusMaster> socket;

  /// Runs `script` from time 0, ends the simulation with it, and returns.
  void simulate(std::function<void()> script) {
    script_ = [script = std::move(script)] {
      script();
      sc_core::sc_stop();
    };
    sc_core::sc_start();
  }
  /// What this master does while another one's script is simulated.
  void set_script(std::function<void()> script) { script_ = std::move(script); }

  std::uint32_t read(std::uint64_t address) {
    std::uint32_t word = 0xDEADBEEF;
    access(tlm::TLM_READ_COMMAND, address, &word);
    return word;
  }
  void write(std::uint64_t address, std::uint32_t word) {
    access(tlm::TLM_WRITE_COMMAND, address, &word);
  }
  tlm::tlm_response_status response() const { return payload.get_response_status(); }

  /// One access with whatever the caller changed in `payload` and `delay` before.
  void access(tlm::tlm_command command, std::uint64_t address, std::uint32_t* word) {
    prepare(command, address, word, sizeof *word);
    send();
  }
  void prepare(tlm::tlm_command command, std::uint64_t address, void* data, unsigned length) {
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(static_cast<unsigned char*>(data));
    payload.set_data_length(length);
    payload.set_streaming_width(length);
    payload.set_byte_enable_ptr(nullptr);
    payload.set_byte_enable_length(0);
    payload.set_dmi_allowed(false);
    payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  }
  void send() {
    socket->b_transport(payload, delay);
    if (delay != sc_core::SC_ZERO_TIME) sc_core::wait(delay);
    delay = sc_core::SC_ZERO_TIME;
  }
  unsigned debug(tlm::tlm_command command, std::uint64_t address, void* data, unsigned length) {
    prepare(command, address, data, length);
    return socket->transport_dbg(payload);
  }

  /// Waits until the simulation time is `ps`.
  static void wait_until(std::uint64_t ps) {
    sc_core::wait(sc_core::sc_time::from_value(ps) - sc_core::sc_time_stamp());
  }

  tlm::tlm_generic_payload payload;
  sc_core::sc_time delay;
  std::function<void(std::uint64_t, std::uint64_t)> invalidated;

 private:
  void run() {
    if (script_) script_();
  }
  void invalidate(sc_dt::uint64 first, sc_dt::uint64 last) {
    if (invalidated) invalidated(first, last);
  }

  std::function<void()> script_;
};

}  // namespace kit

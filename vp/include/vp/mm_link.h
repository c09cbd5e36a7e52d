#pragma once

#include <cstdint>
#include <functional>
#include <systemc>
#include <tlm>
#include <vector>

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>
#include <vp/counter.h>
#include <vp/payload_checker.h>

namespace vp {

/// Bytes at the end of a bus: transactions of whole bytes of any length, with byte enables and
/// streaming width, debug access and direct access (DMI). A derived class says which bytes, and
/// how long an access takes.
///
/// Answers: TLM_COMMAND_ERROR_RESPONSE for what is neither read nor write, TLM_BURST_ERROR_RESPONSE
/// for a streaming width of 0, TLM_ADDRESS_ERROR_RESPONSE beyond the memory,
/// TLM_BYTE_ENABLE_ERROR_RESPONSE for byte enables of length 0.
class MemoryTarget : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<MemoryTarget> socket;

 protected:
  explicit MemoryTarget(sc_core::sc_module_name name, const char* socket_name = "socket");

  /// `size` bytes, which stay there, at addresses from `first` on.
  void show(unsigned char* bytes, std::uint64_t first, std::uint64_t size);
  std::uint64_t first() const { return first_; }
  std::uint64_t end() const { return first_ + size_; }
  bool contains(std::uint64_t address, std::uint64_t bytes) const {
    return address >= first_ && address <= end() && bytes <= end() - address;
  }

  /// Rules of its own for a transaction that lies inside the memory.
  virtual tlm::tlm_response_status check(const tlm::tlm_generic_payload&) const {
    return tlm::TLM_OK_RESPONSE;
  }
  /// Called when a transaction was answered and its status is set: counts it, and adds its time to
  /// `delay`.
  virtual void answered(const tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) = 0;
  /// For users of direct access; 0 if the memory does not count its time.
  virtual sc_core::sc_time latency(bool /*read*/) const { return sc_core::SC_ZERO_TIME; }

  virtual void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  virtual bool get_direct_mem_ptr(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);

 private:
  unsigned transport_dbg(tlm::tlm_generic_payload& payload);
  tlm::tlm_response_status access(tlm::tlm_generic_payload& payload);
  void move(tlm::tlm_generic_payload& payload);

  unsigned char* bytes_ = nullptr;
  std::uint64_t first_ = 0;
  std::uint64_t size_ = 0;
};

class MmLink;

/// Watches or alters what passes a link: a transaction log, a protocol checker, a fault injector.
class MmObserver {
 public:
  virtual ~MmObserver() = default;
  /// True: direct memory access is refused, so that every access is a transaction. False: for
  /// observers that only need to know what was accessed.
  virtual bool needs_transactions() const { return true; }
  virtual void before(MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& /*delay*/) {}
  virtual void after(MmLink&, tlm::tlm_generic_payload&, sc_core::sc_time& /*delay*/) {}
  /// One burst that went through direct memory access.
  virtual void direct(MmLink&, tlm::tlm_command, std::uint64_t /*address*/,
                      std::uint64_t /*bytes*/) {}
};

/// One memory-mapped connection to a target: a named object that counts what passes it.
///
/// An initiator or an interconnect owns it and sends through it; `socket` is bound to the target.
/// What passes it is held to IEEE 1666's rules of payloads.
class MmLink : public sc_core::sc_module {
 public:
  explicit MmLink(sc_core::sc_module_name name);
  const char* kind() const override { return "vp::MmLink"; }

  tlm_utils::simple_initiator_socket<MmLink> socket;

  Counter reads{"reads", "read transactions"};
  Counter writes{"writes", "write transactions"};
  Counter bytes_read{"bytes_read", "bytes read without error"};
  Counter bytes_written{"bytes_written", "bytes written without error"};
  Counter errors{"errors", "transactions that were answered with an error"};

  /// A transaction, from an SC_THREAD.
  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  /// A debug access; returns the bytes done.
  unsigned transport_debug(tlm::tlm_generic_payload& payload);
  /// Asks for direct access to the target's memory. Allowed accesses do not pass the link:
  /// account() for them.
  bool direct_memory(tlm::tlm_generic_payload& payload, tlm::tlm_dmi& dmi);
  /// Counts one burst that went through direct access.
  void account(tlm::tlm_command command, std::uint64_t address, std::uint64_t bytes);

  /// Called when the target takes direct access back for its addresses first … last.
  void on_invalidate(std::function<void(std::uint64_t first, std::uint64_t last)> callback);

  void add_observer(MmObserver& observer);
  void remove_observer(MmObserver& observer);

 private:
  friend class RegisterRoute;

  void start_of_simulation() override { watched_ = links_are_watched(); }
  void end_of_simulation() override { checker_.finish(); }
  void invalidate(sc_dt::uint64 first, sc_dt::uint64 last);
  void take_back();
  bool direct_allowed() const;
  void count(tlm::tlm_command command, std::uint64_t bytes, bool failed) {
    if (command == tlm::TLM_READ_COMMAND) {
      ++reads;
      if (!failed) bytes_read.add(bytes);
    } else if (command == tlm::TLM_WRITE_COMMAND) {
      ++writes;
      if (!failed) bytes_written.add(bytes);
    }
    if (failed) ++errors;
  }

  PayloadChecker checker_{*this};
  bool watched_ = true;
  std::vector<MmObserver*> observers_;
  std::function<void(std::uint64_t, std::uint64_t)> invalidated_;
};

}  // namespace vp

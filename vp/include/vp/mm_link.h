#pragma once

#include <tlm_utils/simple_initiator_socket.h>
#include <cstdint>
#include <functional>
#include <systemc>
#include <tlm>
#include <vector>

#include <vp/counter.h>

namespace vp {

class MmLink;

/// Watches or alters what passes a link: a transaction log, a protocol checker, a fault injector.
class MmObserver {
 public:
  virtual ~MmObserver() = default;
  /// True: direct memory access is refused, so that every access is a transaction. False: for those
  /// who only want to know what was accessed.
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

  std::vector<MmObserver*> observers_;
  std::function<void(std::uint64_t, std::uint64_t)> invalidated_;
};

}  // namespace vp

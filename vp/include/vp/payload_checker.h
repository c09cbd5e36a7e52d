#pragma once

#include <tlm>

#include <vp/rule_reports.h>

namespace vp {

/// Watches what IEEE 1666 asks of the payloads that pass one link (vp/protocol_rules.h). Of what is
/// right it costs some comparisons a transaction.
class PayloadChecker {
 public:
  explicit PayloadChecker(const sc_core::sc_object& link) : reports_(link) {}

  /// What a target has to leave as it is.
  struct Sent {
    explicit Sent(const tlm::tlm_generic_payload& payload)
        : command(payload.get_command()),
          data(payload.get_data_ptr()),
          length(payload.get_data_length()),
          width(payload.get_streaming_width()),
          enables(payload.get_byte_enable_ptr()),
          enable_length(payload.get_byte_enable_length()) {}
    bool operator==(const Sent& other) const {
      return command == other.command && data == other.data && length == other.length &&
             width == other.width && enables == other.enables &&
             enable_length == other.enable_length;
    }
    tlm::tlm_command command;
    const unsigned char* data;
    unsigned length, width;
    const unsigned char* enables;
    unsigned enable_length;
  };

  /// It leaves its initiator.
  Sent before(const tlm::tlm_generic_payload& payload) {
    const Sent sent(payload);
    const bool ready = payload.get_response_status() == tlm::TLM_INCOMPLETE_RESPONSE &&
                       !payload.is_dmi_allowed() && sent.data && sent.length != 0 &&
                       sent.width != 0 && !sent.enables;
    if (!ready) look_closer(payload, sent);
    return sent;
  }
  /// It has returned.
  void after(const Sent& sent, const tlm::tlm_generic_payload& payload) {
    if (payload.get_response_status() == tlm::TLM_INCOMPLETE_RESPONSE)
      broken(Rule::tlm_response, payload, "it returns with TLM_INCOMPLETE_RESPONSE");
    if (!(sent == Sent(payload)))
      broken(Rule::tlm_kept, payload, "the target has changed the payload");
  }
  /// Direct access was asked for and granted.
  void granted(const tlm::tlm_generic_payload& payload, const tlm::tlm_dmi& dmi);
  void finish() const { reports_.finish(); }

 private:
  void look_closer(const tlm::tlm_generic_payload& payload, const Sent& sent);
  void broken(Rule rule, const tlm::tlm_generic_payload& payload, const char* what);

  RuleReports reports_;
};

}  // namespace vp

#include <vp/payload_checker.h>

#include <algorithm>

#include <vp/text.h>

namespace vp {

void PayloadChecker::broken(Rule rule, const tlm::tlm_generic_payload& payload, const char* what) {
  const char* command = payload.is_read()    ? "read of "
                        : payload.is_write() ? "write to "
                                             : "ignored access to ";
  reports_.violate(rule, nullptr, command + hex(payload.get_address()) + ": " + what);
}

// A payload that is only to be ignored needs no data (IEEE 1666 14.7).
void PayloadChecker::look_closer(const tlm::tlm_generic_payload& payload, const Sent& sent) {
  if (payload.get_response_status() != tlm::TLM_INCOMPLETE_RESPONSE)
    broken(Rule::tlm_response, payload, "it leaves with the response of another one");
  if (payload.is_dmi_allowed()) broken(Rule::tlm_dmi_hint, payload, "the hint is set");
  const bool moves = payload.is_read() || payload.is_write();
  if (moves && (!sent.data || sent.length == 0))
    broken(Rule::tlm_data, payload, sent.data ? "its length is 0" : "its data pointer is null");
  if (sent.width == 0) broken(Rule::tlm_streaming_width, payload, "its streaming width is 0");
  if (!sent.enables) return;
  const bool legal = std::all_of(
      sent.enables, sent.enables + sent.enable_length,
      [](unsigned char one) { return one == TLM_BYTE_ENABLED || one == TLM_BYTE_DISABLED; });
  if (sent.enable_length == 0) {
    broken(Rule::tlm_byte_enables, payload, "its byte enables have length 0");
  } else if (!legal) {
    broken(Rule::tlm_byte_enables, payload, "a byte enable is neither 0x00 nor 0xFF");
  }
}

void PayloadChecker::granted(const tlm::tlm_generic_payload& payload, const tlm::tlm_dmi& dmi) {
  const std::uint64_t address = payload.get_address();
  if (!dmi.get_dmi_ptr())
    broken(Rule::tlm_dmi_range, payload, "direct access is granted without a pointer");
  else if (address < dmi.get_start_address() || address > dmi.get_end_address())
    broken(Rule::tlm_dmi_range, payload, "the range granted is another one");
}

}  // namespace vp

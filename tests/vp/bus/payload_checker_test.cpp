// The rules of payloads: each is broken once, by the initiator or by the target.
#include <boost/test/unit_test.hpp>

#include <simulation.h>

#include <functional>
#include <sstream>
#include <string>

#include <tlm_utils/simple_target_socket.h>
#include <vp/mm_link.h>
#include <vp/report.h>

namespace {

/// Does what a test says.
struct Target : sc_core::sc_module {
  explicit Target(sc_core::sc_module_name name) : sc_module(name) {
    socket.register_b_transport(this, &Target::b_transport);
    socket.register_get_direct_mem_ptr(this, &Target::get_direct_mem_ptr);
  }
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time&) { answer(payload); }
  bool get_direct_mem_ptr(tlm::tlm_generic_payload&, tlm::tlm_dmi& dmi) {
    dmi.init();
    dmi.set_dmi_ptr(bytes);
    dmi.set_start_address(0);
    dmi.set_end_address(last);
    dmi.allow_read_write();
    return true;
  }
  tlm_utils::simple_target_socket<Target> socket{"socket"};
  std::function<void(tlm::tlm_generic_payload&)> answer = [](tlm::tlm_generic_payload& payload) {
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  };
  unsigned char bytes[16] = {};
  std::uint64_t last = 15;
};

struct Bench : kit::Simulation {
  Bench() {
    reports.redirect(text);
    link.socket.bind(target.socket);
    payload.set_command(tlm::TLM_WRITE_COMMAND);
    payload.set_address(8);
    payload.set_data_ptr(word);
    payload.set_data_length(sizeof word);
    payload.set_streaming_width(sizeof word);
  }
  /// The rules that one transaction breaks.
  std::string broken() {
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    sc_core::sc_time delay;
    link.transport(payload, delay);
    return names();
  }
  std::string names() const {
    std::string found;
    const std::string rule = "/markervp/rule/";
    for (const vp::Warning& warning : reports.warnings())
      if (warning.id.rfind(rule, 0) == 0) found += warning.id.substr(rule.size()) + " ";
    return found;
  }

  std::ostringstream text;
  vp::ReportRouter reports;
  vp::MmLink link{"link"};
  Target target{"target"};
  tlm::tlm_generic_payload payload;
  unsigned char word[4] = {}, enables[4] = {0xFF, 0, 0xFF, 0};
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_plain_transaction_is_silent, Bench) {
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(legal_byte_enables_are_silent, Bench) {
  payload.set_byte_enable_ptr(enables);
  payload.set_byte_enable_length(4);
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(a_target_may_set_the_hint_of_direct_access, Bench) {
  target.answer = [](tlm::tlm_generic_payload& sent) {
    sent.set_dmi_allowed(true);
    sent.set_response_status(tlm::TLM_OK_RESPONSE);
  };
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(a_target_that_does_not_answer, Bench) {
  target.answer = [](tlm::tlm_generic_payload&) {};
  BOOST_TEST(broken() == "TLM2_RESPONSE ");
  BOOST_TEST(text.str().find("link: TLM2_RESPONSE: write to 0x00000008") != std::string::npos,
             text.str());
}
BOOST_FIXTURE_TEST_CASE(a_payload_with_the_answer_of_another_one, Bench) {
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  BOOST_TEST(broken() == "TLM2_RESPONSE ");
}
BOOST_FIXTURE_TEST_CASE(a_payload_without_data, Bench) {
  payload.set_data_ptr(nullptr);
  BOOST_TEST(broken() == "TLM2_DATA ");
}
BOOST_FIXTURE_TEST_CASE(a_payload_of_no_length, Bench) {
  payload.set_data_length(0);
  BOOST_TEST(broken() == "TLM2_DATA ");
}
BOOST_FIXTURE_TEST_CASE(an_ignored_payload_needs_no_data, Bench) {
  payload.set_command(tlm::TLM_IGNORE_COMMAND);
  payload.set_data_ptr(nullptr);
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(a_streaming_width_of_0, Bench) {
  payload.set_streaming_width(0);
  BOOST_TEST(broken() == "TLM2_STREAMING_WIDTH ");
}
BOOST_FIXTURE_TEST_CASE(byte_enables_of_no_length, Bench) {
  payload.set_byte_enable_ptr(enables);
  BOOST_TEST(broken() == "TLM2_BYTE_ENABLES ");
}
BOOST_FIXTURE_TEST_CASE(a_byte_enable_of_1, Bench) {
  enables[1] = 1;
  payload.set_byte_enable_ptr(enables);
  payload.set_byte_enable_length(4);
  BOOST_TEST(broken() == "TLM2_BYTE_ENABLES ");
}
BOOST_FIXTURE_TEST_CASE(a_target_that_changes_the_payload, Bench) {
  target.answer = [](tlm::tlm_generic_payload& sent) {
    sent.set_data_length(2);
    sent.set_response_status(tlm::TLM_OK_RESPONSE);
  };
  BOOST_TEST(broken() == "TLM2_KEPT ");
}
BOOST_FIXTURE_TEST_CASE(a_hint_that_was_not_cleared, Bench) {
  payload.set_dmi_allowed(true);
  BOOST_TEST(broken() == "TLM2_DMI_HINT ");
}
BOOST_FIXTURE_TEST_CASE(direct_access_to_the_address_is_silent, Bench) {
  tlm::tlm_dmi dmi;
  BOOST_TEST(link.direct_memory(payload, dmi));
  BOOST_TEST(names() == "");
}
BOOST_FIXTURE_TEST_CASE(direct_access_to_other_addresses, Bench) {
  target.last = 7;
  tlm::tlm_dmi dmi;
  link.direct_memory(payload, dmi);
  BOOST_TEST(names() == "TLM2_DMI_RANGE ");
}

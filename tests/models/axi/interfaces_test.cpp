// Interfaces among the ports of RTL: what families of cores call them, and what is refused.
#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

#include <axi/interfaces.h>
#include <vp/error.h>

namespace {

/// A module of such ports: "i clk", "o data 32".
class Module {
 public:
  explicit Module(std::vector<std::string> ports) : texts_(std::move(ports)) {
    for (std::string& text : texts_) {
      const std::size_t end = text.find(' ', 2);
      const auto bits =
          end == text.npos ? 1u : static_cast<std::uint32_t>(std::stoul(text.substr(end)));
      const int output = text.front() == 'o' ? 1 : 0;
      text = text.substr(2, end == text.npos ? end : end - 2);
      ports_.push_back({text.c_str(), bits, output, "core.v:3"});
    }
  }
  Module& note(const char* what, const char* port, const char* text) {
    notes_.push_back({what, port, text});
    return *this;
  }
  std::vector<axi::Interface> find() {
    RtlDescriptor rtl{};
    rtl.top = "core";
    rtl.place = "core.v:1";
    rtl.port_count = static_cast<std::uint32_t>(ports_.size());
    rtl.ports = ports_.data();
    rtl.note_count = static_cast<std::uint32_t>(notes_.size());
    rtl.notes = notes_.data();
    return axi::find_interfaces(rtl);
  }
  /// "AXI4 s_axi in clk; …": kind, name, direction, clock.
  std::string text() {
    std::string all;
    for (const axi::Interface& one : find()) {
      all += (all.empty() ? "" : "; ") + std::string(to_string(one.kind)) + " " + one.name +
             (one.slave ? " in" : " out") + (one.active_low ? " low" : "") +
             (one.edge ? " edge" : "") + (one.clock.empty() ? "" : " " + one.clock);
    }
    return all;
  }
  std::string refusal() {
    try {
      find();
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::vector<std::string> texts_;
  std::vector<RtlPort> ports_;
  std::vector<RtlNote> notes_;
};

/// The ports of a whole AXI4-Lite interface, seen from the slave.
std::vector<std::string> lite(const std::string& prefix, bool capitals = false) {
  std::vector<std::string> ports;
  for (std::string port :
       {"i awaddr 6", "i awvalid", "o awready", "i wdata 32", "i wstrb 4", "i wvalid", "o wready",
        "o bresp 2", "o bvalid", "i bready", "i araddr 6", "i arvalid", "o arready", "o rdata 32",
        "o rresp 2", "o rvalid", "i rready"}) {
    std::string name = port.substr(2);
    if (capitals)
      for (char& c : name) c = static_cast<char>(std::toupper(c));
    ports.push_back(port.substr(0, 2) + prefix + name);
  }
  return ports;
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

using Ports = std::vector<std::string>;

void check_says(const std::string& refusal, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    BOOST_TEST(refusal.find(part) != std::string::npos, "'" << refusal << "' without " << part);
}

}  // namespace

BOOST_AUTO_TEST_CASE(cores_of_high_level_synthesis) {
  Module hls(Ports{"i ap_clk", "i ap_rst_n", "o interrupt"} + lite("s_axi_control_", true) +
             Ports{"i in_r_TDATA 32", "i in_r_TVALID", "o in_r_TREADY"});
  BOOST_TEST(hls.text() ==
             "clock ap_clk in; reset ap_rst_n in low ap_clk; interrupt interrupt out ap_clk; "
             "AXI4-Lite s_axi_control in ap_clk; AXI4-Stream in_r in ap_clk");
}

BOOST_AUTO_TEST_CASE(the_template_of_the_vendor) {
  Module peripheral(Ports{"i s00_axi_aclk", "i s00_axi_aresetn"} + lite("s00_axi_") +
                    Ports{"i m00_axis_aclk", "o m00_axis_tvalid", "o m00_axis_tdata 32"});
  BOOST_TEST(peripheral.text() ==
             "clock s00_axi_aclk in; reset s00_axi_aresetn in low s00_axi_aclk; AXI4-Lite s00_axi "
             "in s00_axi_aclk; clock m00_axis_aclk in; AXI4-Stream m00_axis out m00_axis_aclk");
}

// s00_axi begins as many characters of s00_axis_aclk as of its own clock.
BOOST_AUTO_TEST_CASE(whole_words_choose_the_clock) {
  Module peripheral(Ports{"i s00_axis_aclk", "i s00_axis_tvalid", "i s00_axis_tdata 32",
                          "i s00_axi_aclk", "i s00_axi_aresetn"} +
                    lite("s00_axi_"));
  BOOST_TEST(peripheral.text() ==
             "clock s00_axis_aclk in; AXI4-Stream s00_axis in s00_axis_aclk; clock s00_axi_aclk "
             "in; reset s00_axi_aresetn in low s00_axi_aclk; AXI4-Lite s00_axi in s00_axi_aclk");
  Module unclear(Ports{"i s00_axis_aclk", "i s00_axiom_aclk"} + lite("s00_axi_"));
  check_says(unclear.refusal(), {"'s00_axi' may belong to s00_axis_aclk or s00_axiom_aclk"});
}

BOOST_AUTO_TEST_CASE(a_signal_of_axi_has_its_width) {
  const auto with = [](const std::string& signal, const std::string& other) {
    Ports ports = Ports{"i clk"} + lite("s_");
    for (std::string& port : ports)
      if (port.substr(2).rfind("s_" + signal, 0) == 0) port = port.substr(0, 2) + other;
    return Module(ports).refusal();
  };
  check_says(with("awvalid", "s_awvalid 2"),
             {"core.v:3", "'s_awvalid' has 2 bits", "AWVALID of AXI has 1"});
  check_says(with("bresp", "s_bresp 3"), {"'s_bresp' has 3 bits", "BRESP of AXI has 2"});
  check_says(Module({"i clk", "i s_tdata 8", "i s_tvalid", "i s_tlast 4"}).refusal(),
             {"TLAST of AXI has 1"});
  BOOST_TEST(with("awvalid", "s_awvalid") == "");
}

BOOST_AUTO_TEST_CASE(resets_of_high_level_synthesis_that_are_high) {
  Module core({"i ACLK", "i ARESET", "i ap_rst", "i s_areset"});
  BOOST_TEST(core.text() ==
             "clock ACLK in; reset ARESET in ACLK; reset ap_rst in ACLK; reset s_areset in ACLK");
  Module unclear({"i clk", "i my_rst"});
  check_says(unclear.refusal(), {"reset 'my_rst' does not say at which level"});
}

BOOST_AUTO_TEST_CASE(a_suffix_for_the_direction_is_ignored) {
  Module core({"i clk_i", "i rst_ni", "i tdata_i 32", "i tvalid_i", "o tready_o", "o led_o 4"});
  BOOST_TEST(core.text() ==
             "clock clk_i in; reset rst_ni in low clk_i; AXI4-Stream axis in clk_i; wire led_o out "
             "clk_i");
}

BOOST_AUTO_TEST_CASE(attributes_win_over_names) {
  Module core({"i c", "i r", "i p", "i x 32", "i v", "o done"});
  core.note("info", "c", "xilinx.com:signal:clock:1.0 c CLK")
      .note("parameter", "c", "XIL_INTERFACENAME c, ASSOCIATED_BUSIF pix:other, FREQ_HZ 100")
      .note("info", "r", "xilinx.com:signal:reset:1.0 r RST")
      .note("parameter", "r", "POLARITY ACTIVE_LOW")
      .note("info", "x", "xilinx.com:interface:axis:1.0 pix TDATA")
      .note("info", "v", "xilinx.com:interface:axis:1.0 pix TVALID")
      .note("info", "done", "xilinx.com:signal:interrupt:1.0 done INTERRUPT")
      .note("parameter", "done", "SENSITIVITY EDGE_RISING");
  BOOST_TEST(core.text() ==
             "clock c in; reset r in low c; wire p in c; AXI4-Stream pix in c; interrupt done out "
             "edge c");
}

BOOST_AUTO_TEST_CASE(the_user_wins_over_all) {
  Module core({"i clk", "i rst", "i a_clk", "i s_tdata 32", "i s_tvalid"});
  core.note("interface", "rst", "reset high")
      .note("interface", "a_clk", "wire")
      .note("interface", "s", "wire");
  BOOST_TEST(core.text() ==
             "clock clk in; reset rst in clk; wire a_clk in clk; wire s_tdata in clk; wire "
             "s_tvalid in clk");
}

BOOST_AUTO_TEST_CASE(a_wire_may_belong_to_a_clock) {
  Module core({"i a_clk", "i b_clk", "i level"});
  core.note("interface", "level", "clock b_clk");
  BOOST_TEST(core.text() == "clock a_clk in; clock b_clk in; wire level in b_clk");
}

BOOST_AUTO_TEST_CASE(signals_of_bursts_make_it_axi4) {
  BOOST_TEST(Module(Ports{"i aclk"} + lite("s_axi_") + Ports{"i s_axi_awlen 8"}).text() ==
             "clock aclk in; AXI4 s_axi in aclk");
  Module reads({"i aclk", "o m_araddr 32", "o m_arlen 8", "o m_arvalid", "i m_arready",
                "i m_rdata 64", "i m_rlast", "i m_rvalid", "o m_rready"});
  BOOST_TEST(reads.text() == "clock aclk in; AXI4 m out aclk");
}

BOOST_AUTO_TEST_CASE(half_an_interface_is_refused) {
  Ports ports = Ports{"i clk"} + lite("s_axi_");
  ports.erase(ports.begin() + 10);  // bready
  check_says(Module(ports).refusal(), {"core.v:3", "half an interface", "'s_axi'", "'bready'"});
  check_says(Module({"i clk", "i s_tvalid"}).refusal(), {"'tdata'"});
  Ports turned = Ports{"i clk"} + lite("s_axi_");
  turned[3] = "i s_axi_awready";
  check_says(Module(turned).refusal(), {"'s_axi_awready'", "must be an output"});
}

BOOST_AUTO_TEST_CASE(a_reset_of_unknown_polarity_is_asked_for) {
  check_says(Module({"i clk", "i rst"}).refusal(),
             {"core.v:3", "'rst'", "reset high", "reset low"});
}

BOOST_AUTO_TEST_CASE(an_interface_of_two_clocks_is_asked_for) {
  Module core({"i a_clk", "i b_clk", "i s_tdata 32", "i s_tvalid"});
  check_says(core.refusal(), {"'s'", "a_clk", "b_clk", "clock <port>"});
  core.note("interface", "s", "clock b_clk");
  BOOST_TEST(core.text() == "clock a_clk in; clock b_clk in; AXI4-Stream s in b_clk");
  check_says(Module({"i s_tdata 32", "i s_tvalid"}).refusal(), {"has no clock"});
}

BOOST_AUTO_TEST_CASE(two_clocks_for_one_interface_are_refused) {
  Module both({"i a_clk", "i b_clk", "i s_tdata 32", "i s_tvalid"});
  both.note("parameter", "a_clk", "ASSOCIATED_BUSIF s")
      .note("parameter", "b_clk", "ASSOCIATED_BUSIF s");
  check_says(both.refusal(), {"'s'", "a_clk", "b_clk", "clock <port>"});
  both.note("interface", "s", "clock b_clk");
  BOOST_TEST(both.text() == "clock a_clk in; clock b_clk in; AXI4-Stream s in b_clk");
  both.note("interface", "S", "clock a_clk");
  check_says(both.refusal(), {"'S' twice"});
  check_says(Module({"i a_clk", "i b_clk", "i s_tdata 32", "i s_tvalid"})
                 .note("interface", "s", "clock a_clk clock b_clk")
                 .refusal(),
             {"'s' more than one clock"});
}

BOOST_AUTO_TEST_CASE(notes_about_nothing_are_refused) {
  check_says(Module({"i clk"}).note("interface", "q", "wire").refusal(), {"'q'", "no such port"});
  check_says(Module({"i clk"}).note("interface", "clk", "watch").refusal(),
             {"'watch'", "interrupt"});
  check_says(
      Module({"i clk", "i s_tdata 32", "i s_tvalid"}).note("interface", "s", "clock no").refusal(),
      {"'no'"});
}

// Opening a trace in a viewer by its control protocol, against one that is played here.
#include <boost/test/unit_test.hpp>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <trace/viewer_control.h>
#include <unistd.h>

#include <thread>

#include "waves.h"

using namespace platform::trace;

namespace {

using Strings = std::vector<std::string>;

/// Listens on a port of its own; to each message that it gets it says the next of `answers`.
class PlayedViewer {
 public:
  explicit PlayedViewer(Strings answers) : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    BOOST_REQUIRE(::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) == 0);
    BOOST_REQUIRE(::listen(listener_, 1) == 0);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port = ntohs(address.sin_port);
    thread_ = std::thread([this, answers = std::move(answers)] { play(answers); });
  }
  ~PlayedViewer() {
    finish();
    ::close(listener_);
  }
  /// What it was told.
  Strings heard() {
    finish();
    return heard_;
  }

  std::uint16_t port = 0;

 private:
  void play(const Strings& answers) {
    const int client = ::accept(listener_, nullptr, nullptr);
    std::string received;
    char byte = 0;
    for (auto next = answers.begin(); ::recv(client, &byte, 1, 0) == 1;) {
      if (byte != '\0') {
        received += byte;
        continue;
      }
      heard_.push_back(std::exchange(received, {}));
      if (next == answers.end()) continue;
      ::send(client, next->data(), next->size(), MSG_NOSIGNAL);
      if (*next++ == "") break;
    }
    ::close(client);
  }
  void finish() {
    if (thread_.joinable()) thread_.join();
  }

  int listener_;
  Strings heard_;
  std::thread thread_;
};

std::string message(const std::string& json) {
  return json + '\0';
}

const std::string greeting = message(R"({"type":"greeting","version":"0","commands":["load"]})");
const std::string ack = message(R"({"type":"response","command":"ack"})");
const std::string loaded = message(R"({"type":"event","event":"waveforms_loaded","source":"x"})");
const std::string unknown = message(R"({"type":"error","error":"?","message":"no such command"})");

}  // namespace

BOOST_AUTO_TEST_SUITE(viewer_control)

BOOST_AUTO_TEST_CASE(a_viewer_opens_the_file_and_goes_to_the_moment) {
  // The file may be there before the answer, or behind it.
  for (const std::string& opened : {ack + loaded, loaded + ack}) {
    PlayedViewer viewer({greeting, opened, ack, ack, ack});
    const Strings undone = show_in_viewer({"/tmp/t.vcd", {"top.a", "top.b"}, 15}, viewer.port);
    BOOST_TEST(undone.empty());
    const Strings expected = {
        R"({"commands":["waveforms_loaded"],"type":"greeting","version":"0"})",
        R"({"command":"load","source":"/tmp/t.vcd","type":"command"})",
        R"({"command":"add_items","items":["top.a","top.b"],"recursive":false,"type":"command"})",
        R"({"command":"set_cursor","timestamp":15,"type":"command"})",
        R"({"command":"set_viewport_to","timestamp":15,"type":"command"})"};
    BOOST_TEST(viewer.heard() == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(what_an_older_viewer_cannot_do_is_said) {
  PlayedViewer viewer({greeting, ack + loaded, unknown, ack, unknown, ack});
  const Strings undone = show_in_viewer({"/tmp/t.vcd", {"top.a"}, 15}, viewer.port);
  BOOST_TEST(undone == Strings{"the viewer does not set its cursor: no such command"},
             boost::test_tools::per_element());
  BOOST_TEST(viewer.heard().at(3) ==
             R"({"command":"add_variables","type":"command","variables":["top.a"]})");
}

BOOST_AUTO_TEST_CASE(a_viewer_that_cannot_open_the_file_or_is_none_is_refused) {
  const auto refusal = [](Strings answers) {
    PlayedViewer viewer(std::move(answers));
    return complaint([&] { show_in_viewer({"/tmp/t.vcd", {}, {}}, viewer.port); });
  };
  BOOST_TEST(refusal({greeting, unknown}) ==
             "view: the viewer does not open '/tmp/t.vcd': no such command");
  BOOST_TEST(refusal({message(R"({"type":"greeting","version":"1"})")})
                 .find("speaks version 1 of the protocol") != std::string::npos);
  BOOST_TEST(refusal({message("HTTP/1.1 400")}).find("is it a waveform viewer?") !=
             std::string::npos);
  BOOST_TEST(refusal({message("[[[]]]")}).find("does not greet") != std::string::npos);
  BOOST_TEST(refusal({message(R"({"type":7})")}).find("does not greet") != std::string::npos);
  BOOST_TEST(refusal({""}).find("closed the connection") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(without_a_viewer_it_is_said_how_to_have_one) {
  std::uint16_t port = 0;
  {
    const PlayedViewer gone({""});
    port = gone.port;
    complaint([&] { show_in_viewer({"/tmp/t.vcd", {}, {}}, port); });
  }
  const std::string said = complaint([&] { show_in_viewer({"/tmp/t.vcd", {}, {}}, port); });
  BOOST_TEST(said.find("no viewer listens on port " + std::to_string(port)) != std::string::npos);
  BOOST_TEST(said.find("wcp_server_start") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

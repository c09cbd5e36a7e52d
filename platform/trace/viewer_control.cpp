#include <trace/viewer_control.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <vp/error.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <utility>

namespace platform::trace {

namespace {

using Json = nlohmann::json;
using HostClock = std::chrono::steady_clock;

/// A viewer answers at once; a large file it loads in its own time.
constexpr std::chrono::seconds patience_for_answer(10), patience_for_file(120);

[[noreturn]] void fail(const std::string& problem) {
  throw vp::InputError("view: the viewer " + problem);
}

std::string text_of(const Json& message, const char* key) {
  const auto found = message.is_object() ? message.find(key) : message.end();
  return found != message.end() && found->is_string() ? found->get<std::string>() : std::string();
}

class Connection {
 public:
  /// Of this machine. False in connected(): nothing listens there.
  explicit Connection(std::uint16_t port)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = socket_ >= 0 && ::connect(socket_, reinterpret_cast<const sockaddr*>(&address),
                                           sizeof address) == 0;
  }
  ~Connection() {
    if (socket_ >= 0) ::close(socket_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool connected() const { return connected_; }
  void send(const Json& message) {
    // A file's name may be in no encoding.
    std::string bytes = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    bytes += '\0';
    for (std::size_t done = 0; done < bytes.size();) {
      wait(POLLOUT, HostClock::now() + patience_for_answer);
      const ssize_t count =
          ::send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count <= 0) fail("closed the connection");
      done += static_cast<std::size_t>(count);
    }
  }
  Json receive(std::chrono::seconds patience) {
    constexpr std::size_t largest = 1 << 20;
    const auto deadline = HostClock::now() + patience;
    std::size_t end = std::string::npos;
    while ((end = received_.find('\0')) == std::string::npos) {
      if (received_.size() > largest) fail("says more than a message can hold");
      wait(POLLIN, deadline);
      char bytes[4096];
      const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
      if (count <= 0) fail("closed the connection");
      received_.append(bytes, static_cast<std::size_t>(count));
    }
    Json message = Json::parse(received_.substr(0, end), nullptr, false);
    received_.erase(0, end + 1);
    if (message.is_discarded()) fail("says what is no JSON: is it a waveform viewer?");
    return message;
  }

 private:
  void wait(short event, HostClock::time_point deadline) const {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - HostClock::now());
    pollfd one{socket_, event, 0};
    if (left.count() <= 0 || ::poll(&one, 1, static_cast<int>(left.count())) <= 0)
      fail("does not answer");
  }

  int socket_;
  bool connected_ = false;
  std::string received_;
};

/// A session of the protocol.
class Viewer {
 public:
  explicit Viewer(Connection& connection) : connection_(connection) {
    // The commands of a client are the events that it wants to hear of.
    connection.send({{"type", "greeting"}, {"version", "0"}, {"commands", {"waveforms_loaded"}}});
    const Json answer = connection.receive(patience_for_answer);
    if (text_of(answer, "type") != "greeting") fail("does not greet: is it a waveform viewer?");
    const std::string version = text_of(answer, "version");
    if (version != "0") fail("speaks version " + version + " of the protocol, not version 0");
  }

  /// Why it did not do it; empty if it did.
  std::string ask(const char* command, Json message) {
    message["type"] = "command";
    message["command"] = command;
    connection_.send(message);
    for (;;) {
      const Json answer = connection_.receive(patience_for_answer);
      const std::string type = text_of(answer, "type");
      if (type == "event") note(answer);
      if (type == "response") return {};
      if (type != "error") continue;
      const std::string why = text_of(answer, "message");
      return why.empty() ? "it gives no reason" : why;
    }
  }
  void wait_for_file() {
    while (!loaded_) note(connection_.receive(patience_for_file));
  }

 private:
  void note(const Json& event) {
    loaded_ = loaded_ || text_of(event, "event") == "waveforms_loaded";
  }

  Connection& connection_;
  bool loaded_ = false;
};

std::vector<std::string> show(const Viewing& viewing, Connection& connection) {
  Viewer viewer(connection);
  const std::string problem = viewer.ask("load", {{"source", viewing.file}});
  if (!problem.empty()) fail("does not open '" + viewing.file + "': " + problem);
  viewer.wait_for_file();
  std::vector<std::string> undone;
  const auto note = [&](const std::string& what, const std::string& why) {
    if (!why.empty()) undone.push_back("the viewer does not " + what + ": " + why);
  };
  if (!viewing.signals.empty()) {
    std::string why = viewer.ask("add_items", {{"items", viewing.signals}, {"recursive", false}});
    // Called so before the protocol was settled.
    if (!why.empty()) why = viewer.ask("add_variables", {{"variables", viewing.signals}});
    note("show the signals", why);
  }
  if (viewing.steps) {
    note("set its cursor", viewer.ask("set_cursor", {{"timestamp", *viewing.steps}}));
    note("go to the moment", viewer.ask("set_viewport_to", {{"timestamp", *viewing.steps}}));
  }
  return undone;
}

}  // namespace

std::vector<std::string> show_in_viewer(const Viewing& viewing, std::optional<std::uint16_t> port) {
  std::string tried;
  const auto asked = [&](std::uint16_t at,
                         const char* name) -> std::optional<std::vector<std::string>> {
    Connection connection(at);
    if (connection.connected()) return show(viewing, connection);
    tried += (tried.empty() ? "" : ", or ") + std::to_string(at) + name;
    return std::nullopt;
  };
  if (port) {
    if (const auto undone = asked(*port, "")) return *undone;
  } else {
    for (const ViewerPort& usual : usual_viewers) {
      const std::string name = std::string(" (") + usual.viewer + ")";
      if (const auto undone = asked(usual.port, name.c_str())) return *undone;
    }
  }
  throw vp::InputError(
      "view: no viewer listens on port " + tried +
      ": in Surfer press the space bar and type wcp_server_start; in VS Code with VaporView set "
      "vaporview.wcp.enabled");
}

}  // namespace platform::trace

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <vector>

#include <chip/system/zynq.h>
#include <vp/host_ticks.h>
#include <vp/signal.h>
#include <nlohmann/json.hpp>

namespace platform {

/// Lets a test outside of this process lead a run: it sends a line of JSON and gets one back, over
/// a socket. While it thinks, no simulated time passes; docs/program-tests.md has the commands.
///
/// Every answer has `time_ps`, `ended` and `console`, the lines printed since the last one; of a
/// mistake `error`, and the run continues. What a test does happens at the time that the run has
/// reached: where it sends the same commands, the run is the same.
///
/// A test that is gone, however it ended, ends the run, also in the middle of a command.
class RemoteControl final : public sc_core::sc_module,
                            private vp::SignalListener,
                            private vp::HostTicks::Listener {
 public:
  /// `socket`: an open file descriptor, which stays the caller's.
  RemoteControl(sc_core::sc_module_name name, Zynq& zynq, int socket);
  ~RemoteControl() override;

  /// A line that the program or an UART printed.
  void printed(const std::string& line);
  /// The simulation is over: answers what the test still asks, until it has finished. Throws
  /// vp::InputError if the test left without that.
  void finish();

 private:
  using Json = nlohmann::json;
  struct Condition;

  void lead();
  std::optional<Json> next_command();
  void answer(Json reply);
  Json obey(const Json& command);
  Json obey_in_time(const std::string& what, const Json& command);

  void pass(std::uint64_t ps);
  Json wait_for(const Json& command);
  Json wait_for_text(const Json& command);
  Json read(const Json& command);
  Json write(const Json& command);
  Json drive(const Json& command);
  Json interrupt(const Json& command);
  Json send(const Json& command);
  Json received(const Json& command);

  std::uint32_t word_at(std::uint32_t address);
  void on_change(vp::SignalBase& signal, std::uint32_t id) override;
  void on_host_tick(std::uint64_t spent_ns, void* context) override;
  void met();

  Zynq& zynq_;
  int socket_;
  std::uint64_t alone_ns_ = 0;            ///< since the test is gone
  std::string unread_;                    ///< of the socket
  std::vector<std::string> console_;      ///< since the last answer
  std::unique_ptr<Condition> condition_;  ///< that the test waits for
  std::string text_;                      ///< that it waits for on the console
  bool met_ = false;
  bool ended_ = false;
  bool busy_ = false;      ///< with a command that is not answered yet
  bool finished_ = false;  ///< the test lets the run go on alone
  bool left_ = false;      ///< it is gone, and had not said so
  sc_core::sc_event woken_{"woken"};
};

}  // namespace platform

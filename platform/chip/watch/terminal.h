#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <systemc>

#include <board/hosts.h>
#include <chip/system/zynq.h>
#include <host/guard.h>

namespace platform {

/// What `--terminal` asks for.
struct TerminalOptions {
  std::string uart;  ///< "uart0", "uart1", or an axi_uartlite of the design
  std::string link;  ///< a symbolic link to the terminal, made for the run; "": none

  /// Of "uart1" or "uart1=LINK". Throws vp::InputError.
  static TerminalOptions parse(const std::string& text);
};

/// A pseudo-terminal at the other end of an UART's line, for a terminal emulator or another
/// program.
///
/// What is typed arrives at the simulated time that the run has reached, so such a run is another
/// one each time; simulated time does not run ahead of the host's. What is not read is lost once
/// the host's buffer is full, as on a line.
class Terminal final : public sc_core::sc_module {
 public:
  /// Throws vp::InputError if the link is there already, for instance another run's, or there is no
  /// pseudo-terminal.
  Terminal(sc_core::sc_module_name name, Zynq& zynq, const TerminalOptions& options);
  ~Terminal() override;
  const char* kind() const override { return "platform::Terminal"; }

  /// "uart1 is the terminal /dev/pts/3, /tmp/board".
  std::string introduction() const;

 private:
  void open();
  void link();
  SC_HAS_PROCESS(Terminal);
  void serve();
  void type();
  void send(std::uint8_t byte);

  Zynq& zynq_;
  TerminalOptions options_;
  board::SerialHost& uart_;
  std::string path_;
  int line_ = -1;      ///< this end
  int terminal_ = -1;  ///< the other one: open, so that the line stays when its reader leaves
  std::optional<host::ScratchLink> link_;
  std::chrono::steady_clock::time_point started_;
};

}  // namespace platform

#include <chip/watch/terminal.h>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform {
namespace {

/// How often the run looks for what was typed, simulated: less than a character at 9600 baud.
constexpr std::uint64_t look_every_ps = 1'000'000'000;

/// A UART of the PS by its name, or a serial line of the PL by that of its part.
board::SerialHost& line_named(const std::string& name) {
  for (const char* start : {"ps.", "pl."}) {
    if (auto* found =
            dynamic_cast<board::SerialHost*>(sc_core::sc_find_object((start + name).c_str())))
      return *found;
  }
  throw vp::InputError("--terminal '" + vp::excerpt(name) +
                       "': give uart0 or uart1, or the name of an axi_uartlite of the design");
}

/// A link of a run that was killed leads nowhere any more.
bool leads_nowhere(const std::string& link) {
  struct stat found {};
  return lstat(link.c_str(), &found) == 0 && S_ISLNK(found.st_mode) &&
         stat(link.c_str(), &found) != 0;
}

}  // namespace

TerminalOptions TerminalOptions::parse(const std::string& text) {
  const std::size_t at = text.find('=');
  TerminalOptions options{text.substr(0, at), at == std::string::npos ? "" : text.substr(at + 1)};
  if (options.uart.empty() || (at != std::string::npos && options.link.empty())) {
    throw vp::InputError("--terminal '" + vp::excerpt(text) +
                         "': give uart0 or uart1, or the same with a link: uart1=FILE");
  }
  // The program may go to another folder.
  if (!options.link.empty()) options.link = std::filesystem::absolute(options.link);
  return options;
}

Terminal::Terminal(sc_core::sc_module_name name, Zynq& zynq, const TerminalOptions& options)
    : sc_module(name), zynq_(zynq), options_(options), uart_(line_named(options.uart)) {
  open();
  try {
    link();
  } catch (...) {
    close(line_);
    close(terminal_);
    throw;
  }
  uart_.on_transmit = [this, console = uart_.on_transmit](std::uint8_t byte) {
    if (console) console(byte);
    send(byte);
  };
  SC_THREAD(serve);
}

Terminal::~Terminal() {
  link_.reset();
  close(line_);
  close(terminal_);
}

void Terminal::open() {
  // Before there is another terminal, which may have the number of that run's.
  if (leads_nowhere(options_.link)) unlink(options_.link.c_str());
  std::array<char, 4096> path{};
  // Bytes pass as they are: no echo, no line ends changed.
  termios raw{};
  cfmakeraw(&raw);
  if (openpty(&line_, &terminal_, nullptr, &raw, nullptr) != 0 ||
      ttyname_r(terminal_, path.data(), path.size()) != 0) {
    throw vp::InputError("--terminal " + options_.uart +
                         ": no pseudo-terminal: " + std::strerror(errno) + vp::advice_for(errno));
  }
  path_ = path.data();
  for (const int end : {line_, terminal_}) fcntl(end, F_SETFD, FD_CLOEXEC);
  fcntl(line_, F_SETFL, O_NONBLOCK);
}

void Terminal::link() {
  if (options_.link.empty()) return;
  try {
    link_.emplace(path_, options_.link);
  } catch (const std::system_error& error) {
    const bool exists = error.code() == std::errc::file_exists;
    throw vp::InputError("--terminal " + options_.uart + ": cannot make the link '" +
                         options_.link + "': " + error.code().message() +
                         (exists ? ": if another run has it, give this one another name"
                                 : vp::advice_for(error.code().value())));
  }
}

std::string Terminal::introduction() const {
  return options_.uart + " is the terminal " + path_ + (link_ ? ", " + options_.link : "");
}

void Terminal::serve() {
  started_ = std::chrono::steady_clock::now();
  using State = ps::Cpu::State;
  const ps::Cpu& cpu = zynq_.ps.cpu;
  while (cpu.state() == State::waiting || cpu.state() == State::running) {
    type();
    wait(sc_core::sc_time::from_value(look_every_ps));
  }
}

/// Waits for the host's time, or for what is typed meanwhile.
void Terminal::type() {
  using std::chrono::microseconds;
  const microseconds reached(sc_core::sc_time_stamp().value() / 1'000'000);
  const auto ahead = std::chrono::duration_cast<std::chrono::milliseconds>(
      started_ + reached - std::chrono::steady_clock::now());
  pollfd typed{line_, POLLIN, 0};
  if (poll(&typed, 1, ahead.count() > 0 ? static_cast<int>(ahead.count()) : 0) <= 0) return;
  std::array<char, 256> bytes{};
  const ssize_t count = read(line_, bytes.data(), bytes.size());
  if (count > 0) uart_.receive({bytes.data(), static_cast<std::size_t>(count)});
}

void Terminal::send(std::uint8_t byte) {
  // A full buffer loses it.
  [[maybe_unused]] const ssize_t written = write(line_, &byte, 1);
}

}  // namespace platform

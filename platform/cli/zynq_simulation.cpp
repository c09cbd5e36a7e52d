#include <cli/zynq_simulation.h>

#include <exception>
#include <iostream>

#include <run/session.h>
#include <vp/output_file.h>
#include <zynq/bus_log.h>
#include <zynq/debugger.h>
#include <zynq/hardware_map.h>

namespace platform::cli {

namespace {

/// Prints what stands in the UARTs without line end, however the run ends.
struct ConsoleFlush {
  ProcessingSystem& ps;
  ~ConsoleFlush() {
    ps.uart0.console.flush();
    ps.uart1.console.flush();
  }
};

class ZynqSimulation : public Simulation {
 public:
  explicit ZynqSimulation(const SimulationOptions& options)
      : session_({options.program, options.trace, options.timeline_frames}), options_(options) {
    ProcessingSystem& ps = session_.zynq().ps;
    const auto print = [](const std::string& line) { std::cout << line << std::endl; };
    ps.cpu.console.connect(print);
    ps.uart0.console.connect(print, "uart0: ");
    ps.uart1.console.connect(print, "uart1: ");
  }

  input::ImageSize image_size() const override { return session_.image_size(); }
  report::RunFacts facts() const override { return session_.facts(); }
  report::HardwareMap map() override { return hardware_map(session_.zynq()); }
  report::Timeline timeline() const override { return session_.timeline(); }
  bool wrote_trace() const override { return session_.wrote_trace(); }
  void run(const NextFrame& next, const FrameDone& done) override {
    const ConsoleFlush flush{session_.zynq().ps};
    const Debugged debugged(session_.zynq());
    std::optional<vp::OutputFile> coverage;
    if (options_.register_coverage) coverage.emplace(*options_.register_coverage);
    std::optional<BusLog> log;
    if (options_.bus_log) {
      log.emplace(BusLogOptions{*options_.bus_log, options_.bus_log_filter}, session_.zynq());
    }
    std::exception_ptr error;
    try {
      session_.run(next, done);
    } catch (...) {
      error = std::current_exception();
    }
    // However the run ended.
    try {
      if (log) log->close();
      if (coverage) coverage->write(register_coverage(session_.zynq()));
      if (coverage) coverage->commit();
    } catch (const vp::OutputError&) {
      if (!error) error = std::current_exception();
    }
    if (error) std::rethrow_exception(error);
  }
  void interrupt() override { ps::Cpu::interrupt_program(); }

 private:
  Session session_;
  SimulationOptions options_;
};

}  // namespace

std::unique_ptr<Simulation> make_zynq_simulation(const SimulationOptions& options) {
  return std::make_unique<ZynqSimulation>(options);
}

}  // namespace platform::cli

#pragma once

#include <deque>
#include <exception>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <chip/cost/parts.h>
#include <chip/cost/zynq_power.h>
#include <chip/fault/injector.h>
#include <chip/linux_app/linux_run.h>
#include <chip/run/camera_timing.h>
#include <chip/run/cost_profile.h>
#include <chip/run/frame_bench.h>
#include <chip/run/software_options.h>
#include <chip/run/unit_watch.h>
#include <chip/system/zynq.h>
#include <chip/watch/bus_log.h>
#include <chip/watch/remote_control.h>
#include <chip/watch/stop_point.h>
#include <chip/watch/terminal.h>
#include <chip/watch/timeline_recorder.h>
#include <facts/result.h>
#include <host/process.h>
#include <ps/cpu/console.h>
#include <ps/cpu/program.h>
#include <vp/parameter.h>
#include <vp/report.h>
#include <vp/trace.h>

namespace platform {

/// What is asked of a simulation beside its configuration.
struct SimulationOptions {
  std::optional<std::string> program = {};     ///< file or name; none: that of the design
  std::optional<vp::TraceOptions> trace = {};  ///< waveforms to record
  std::uint32_t timeline_frames = 0;           ///< record a timeline of so many frames
  std::optional<BusLogOptions> bus_log = {};
  std::optional<std::string> transactions = {};       ///< file: what passes the buses
  std::optional<BusHistoryOptions> history = {};      ///< the run ends when its time is over
  std::optional<StopOptions> stop = {};               ///< the process stops there, for a debugger
  std::optional<std::string> register_coverage = {};  ///< file: which registers the program used
  std::optional<std::string> software_profile = {};   ///< file: where the program's time goes
  std::optional<int> control = {};                    ///< socket of a test that leads the run
  std::vector<TerminalOptions> terminals = {};        ///< one for an UART
  std::optional<LinuxOptions> linux_app = {};  ///< a Linux application, in place of a program
  bool is_only_shown = false;       ///< it will not run: what the software takes need not be known
  std::ostream* console = nullptr;  ///< gets what the program prints; null: it is dropped
};

/// The whole platform: hardware, PS program, and the test bench around them, elaborated and ready
/// to run once. There is one in a process at a time, since SystemC elaborates once.
class Simulation {
 public:
  /// Builds the platform with the current configuration (vp::Configuration::Scope). Throws
  /// vp::InputError for a wrong value, a design or program that cannot be loaded, or costs that do
  /// not cover it.
  explicit Simulation(const SimulationOptions& options);

  /// What the design takes for each unit of work.
  facts::InputNeed input() const { return zynq_->design().input(); }
  /// What it does.
  const facts::Work& work() const { return work_; }
  /// What runs; the configuration is left to the caller.
  facts::RunFacts facts() const;

  /// How long the software takes, and what that was fitted to. Not of one that is only shown.
  const profiles::CostProfile& costs() const { return *costs_; }

  /// Runs the program until `next` gives no more inputs; `done` takes each unit's report, in order,
  /// and says whether to continue. Neither throws. `index` in a report counts the inputs given, or
  /// the units of a design that takes none. Files are made here, not earlier, and are whole when
  /// this returns or throws. Throws vp::ProtocolError if hardware or software broke a rule,
  /// vp::OutputError if a file cannot be written, vp::InputError if a filter selects nothing; the
  /// reports until then were handed over.
  void run(FrameBench::NextFrame next, FrameBench::FrameDone done);

  /// Lets run() return soon, in the middle of a frame. May be called in a signal handler, at any
  /// time.
  static void interrupt() { ps::Cpu::interrupt_program(); }

  /// Of the first frames, as many as asked for.
  facts::Timeline timeline() const;
  /// Profiler::page_json() of the run; "" if no profile was asked for.
  const std::string& software_profile() const { return software_profile_; }

  /// BusHistory::lines() of the run.
  const std::vector<std::string>& history() const { return history_; }
  /// StopPoint::missed() of the run.
  const std::string& missed_stop() const { return missed_stop_; }

  /// There is a trace of the run: one was asked for, and its window or trigger kept something.
  bool wrote_trace() const { return wrote_trace_; }

  /// One more fault, before the run or from an action of injector(). As Injector::add().
  void inject(const Fault& fault, const std::string& origin);
  /// Before the run: keeps what inputs were, so that faults of them can be added later.
  void let_inputs_fail();
  Injector& injector() { return *injector_; }

  Zynq& zynq() { return *zynq_; }
  /// Energy of the run so far. Ask for its timeline before the run.
  ZynqPower& power() { return *power_; }
  /// By which its design knows its signals.
  const trace::Vocabulary& words() const { return design_->words(); }
  const vp::ReportRouter& reports() const { return reports_; }

 private:
  void build();
  void choose_design();
  void connect_consoles();
  void start();
  void run_until(std::uint64_t ps);
  static std::uint64_t progress(const void* simulation);
  /// "in frame 3": the unit that the program works on.
  std::string frame_text() const;
  /// The error that ended it; null for none.
  std::exception_ptr simulate(FrameBench::NextFrame next, FrameBench::FrameDone done);

  SimulationOptions options_;

  host::WorkingFolder folder_;  ///< before the program is loaded, and after it is gone
  vp::ReportRouter reports_;
  std::unique_ptr<vp::Parameter<std::string>> design_name_;
  const DesignInfo* design_ = nullptr;
  facts::Work work_;
  std::unique_ptr<LinuxRun> linux_run_;
  std::unique_ptr<ps::Program> program_;
  std::optional<profiles::CostProfile> costs_;
  std::unique_ptr<Zynq> zynq_;
  std::unique_ptr<vp::Parameter<std::string>> profile_name_;
  std::unique_ptr<CameraTiming> camera_;
  std::unique_ptr<SoftwareOptions> software_options_;
  std::unique_ptr<FrameBench> bench_;
  std::unique_ptr<UnitWatch> unit_watch_;  ///< null: the program tells of its units itself
  std::unique_ptr<ZynqPower> power_;
  std::unique_ptr<TimingClosure> timing_;
  std::unique_ptr<TimelineRecorder> recorder_;
  std::unique_ptr<vp::ListParameter> inject_;
  std::unique_ptr<Injector> injector_;
  std::unique_ptr<RemoteControl> control_;
  std::vector<std::unique_ptr<Terminal>> terminals_;
  std::deque<ps::Console> logic_consoles_;  ///< of serial lines of the PL
  bool wrote_trace_ = false;
  std::string software_profile_;
  std::vector<std::string> history_;
  std::string missed_stop_;
  std::vector<std::string> late_warnings_;  ///< that no frame's report has
};

}  // namespace platform

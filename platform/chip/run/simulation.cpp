#include <chip/run/simulation.h>

#include <chip/system/designs.h>
#include <chip/system/hardware_map.h>
#include <chip/watch/debugger.h>
#include <chip/watch/profiler.h>
#include <chip/watch/transaction_log.h>
#include <pl/common/rtl_pins.h>
#include <ps/cpu/program_watch.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/foreign_object.h>
#include <vp/ip.h>
#include <vp/systemc_pins.h>
#include <vp/unit.h>
#include <xilinx/axi_uartlite/axi_uartlite.h>
#include <algorithm>
#include <numeric>
#include <ostream>
#include <string_view>
#include <utility>

namespace platform {

namespace {

/// Prints what is in the UARTs without line end, however the run ends.
struct ConsoleFlush {
  ProcessingSystem& ps;
  std::deque<ps::Console>& of_the_logic;
  ~ConsoleFlush() {
    ps.uart0.console.flush();
    ps.uart1.console.flush();
    for (ps::Console& console : of_the_logic) console.flush();
  }
};

/// ", pc 0x1a2b edge(…) (median.cpp:12)": where the function of an object ended the process.
std::string place_in_object(const vp::Fault& fault) {
  const std::vector<std::uintptr_t> calls(fault.frames, fault.frames + fault.frame_count);
  const auto inside = std::find_if(calls.begin(), calls.end(), vp::foreign_object_at);
  if (inside == calls.end()) return {};
  const ps::CodeLocator code(reinterpret_cast<const void*>(*inside));
  return ", " + code.path(calls);
}

/// Of a design that names none, where it is only shown.
const hal_program no_program = {HAL_ABI, "none", [] { return 0; }, nullptr, 0,
                                nullptr, 0,      nullptr,          0};

/// What the user sets wins.
void set_defaults(const DesignInfo& design) {
  vp::Configuration* configuration = vp::Configuration::current();
  for (const auto& [path, value] : design.defaults) {
    if (configuration && !configuration->find(path))
      configuration->set(path, value, "design '" + design.name + "'");
  }
}

}  // namespace

// The design names the program, or the program its design.
void Simulation::choose_design() {
  if (options_.linux_app) {
    linux_run_ = std::make_unique<LinuxRun>(*options_.linux_app);
    program_ = linux_run_->program();
  } else if (options_.program) {
    program_ = ps::Program::load(program_file(*options_.program));
  }
  const DesignInfo& usual =
      program_ ? design_of_program(program_->name()) : *builtin_designs().front();
  design_name_ = std::make_unique<vp::Parameter<std::string>>(
      "design", usual.name, vp::Source::decision,
      "what is in the programmable logic: 'markervp designs' lists them");
  design_ = &design_named(*design_name_);
  set_defaults(*design_);
  if (!program_ && options_.is_only_shown && !has_usual_program(*design_))
    program_ = ps::Program::linked(no_program);
  if (!program_) program_ = ps::Program::load(usual_program(*design_));
}

void Simulation::connect_consoles() {
  if (!options_.console && !control_ && !unit_watch_) return;
  const auto print = [this](const std::string& line) {
    if (options_.console) *options_.console << line << std::endl;
    if (control_) control_->printed(line);
  };
  zynq_->ps.cpu.console.connect([this, print](const std::string& line) {
    print(line);
    if (unit_watch_) unit_watch_->printed(line);
  });
  zynq_->ps.uart0.console.connect(print, "uart0: ");
  zynq_->ps.uart1.console.connect(print, "uart1: ");
  for (auto* line : vp::all_below<xilinx::AxiUartlite>(zynq_->pl())) {
    ps::Console& console = logic_consoles_.emplace_back();
    console.connect(print, std::string(line->basename()) + ": ");
    line->on_transmit = [&console](std::uint8_t byte) {
      const char c = static_cast<char>(byte);
      console.write(&c, 1);
    };
  }
}

Simulation::Simulation(const SimulationOptions& options) : options_(options) {
  vp::call_objects([this] { build(); }, {});
}

void Simulation::build() {
  choose_design();
  folder_.restore();
  // Waveforms show what happens clock by clock, unless the user wants otherwise.
  zynq_ =
      std::make_unique<Zynq>(*design_, options_.trace ? pl::Fidelity::clocked : pl::Fidelity::tlm,
                             program_->may_start_core() ? 2 : 1);
  work_ = zynq_->design().work();
  if (work_.job.empty())
    throw vp::InputError("design '" + design_->name +
                         "' names no job: its work() says what each unit, or its program, must do");
  reports_.set_time_source([this] { return zynq_->scheduler.now_ps(); });
  reports_.set_place_source([this] { return zynq_->ps.cpu.place(); });
  profile_name_ = std::make_unique<vp::Parameter<std::string>>(
      "profile", "thesis", vp::Source::decision,
      "costs of the software: thesis (scaled to its measurements), a9-O0, a9-O2 (nothing fitted), "
      "or a file .json");
  camera_ = std::make_unique<CameraTiming>("camera");
  software_options_ =
      std::make_unique<SoftwareOptions>("sw", program_->description(), *profile_name_,
                                        zynq_->ps.cpu_clk.start_hz(), *camera_, zynq_->design());
  if (options_.is_only_shown) {
    profiles::check_cost_profile(*profile_name_, software_options_->optimisation());
  } else {
    costs_ = profiles::load_cost_profile(*profile_name_, software_options_->optimisation());
  }
  const hal_program& program = program_->description();
  for (std::uint32_t i = 0; i < program.option_count; ++i)
    zynq_->design().note_option(program.options[i].name, software_options_->value(i));
  zynq_->design().note_option("unoptimised", software_options_->is_unoptimised() ? 1 : 0);
  bench_ = std::make_unique<FrameBench>(*zynq_, *camera_, *software_options_, reports_);
  if (auto* source = dynamic_cast<UnitSource*>(&zynq_->design()))
    unit_watch_ = std::make_unique<UnitWatch>("unit_watch", *zynq_, *source, *bench_);
  power_ = std::make_unique<ZynqPower>(
      "power", *zynq_, design_->draws_power,
      camera_->has_rate() ? PowerMode::activity : PowerMode::vivado_default);
  timing_ = std::make_unique<TimingClosure>("timing", power_->parts(), zynq_->chip.data);
  recorder_ = std::make_unique<TimelineRecorder>(*zynq_, options_.timeline_frames);
  power_->record_timeline(recorder_->records());
  if (options_.trace && power_->is_known()) power_->follow();
  if (linux_run_) linux_run_->connect(*zynq_, bench_->cache_contract());
  if (costs_)
    zynq_->ps.cpu.load(*program_, linux_run_ ? linux_run_->costs(costs_->costs) : costs_->costs);
  zynq_->ps.cpu.connect(*bench_);
  injector_ = std::make_unique<Injector>(*zynq_, design_->words());
  inject_ = std::make_unique<vp::ListParameter>(
      "inject", vp::Source::decision,
      "faults of the run: [{what: slverr, where: axi_dma_0, access: 3}]; docs/faults.md");
  for (const Fault& fault : parse_faults(inject_->get(), inject_->origin()))
    inject(fault, inject_->origin());
  if (options_.control)
    control_ = std::make_unique<RemoteControl>("control", *zynq_, *options_.control);
  connect_consoles();
  for (const TerminalOptions& terminal : options_.terminals) {
    terminals_.push_back(
        std::make_unique<Terminal>(("terminal_" + terminal.uart).c_str(), *zynq_, terminal));
    if (options_.console) *options_.console << terminals_.back()->introduction() << std::endl;
  }
}

void Simulation::inject(const Fault& fault, const std::string& origin) {
  injector_->add(fault, origin);
  if (fault.is_of_input()) let_inputs_fail();
}

void Simulation::let_inputs_fail() {
  bench_->spoil_inputs([this](std::uint64_t unit, std::vector<std::uint8_t>& bytes) {
    injector_->spoil(unit, bytes);
  });
}

facts::RunFacts Simulation::facts() const {
  facts::RunFacts facts;
  facts.fidelity = zynq_->fidelity.text();
  facts.system = program_->name();
  facts.design = design_->name;
  facts.work = work_;
  facts.stubs = zynq_->design().used_stubs();
  facts.profile = costs_->costs.profile();
  const ps::Cpu& cpu = zynq_->ps.cpu;
  facts.warnings = late_warnings_;
  facts.injected = injector_->report();
  if (cpu.state() == ps::Cpu::State::finished) {
    facts.end = {cpu.exit_code(), cpu.end_ps(), cpu.reached_limit(), cpu.main_end_ps()};
    facts.unpublished = bench_->unpublished();
  }
  facts.camera = bench_->camera_report();
  if (power_->is_known()) facts.power = power_->power_report(zynq_->scheduler.now_ps());
  facts.resources = power_->resource_report();
  facts.timing = power_->timing_report(*timing_);
  facts.clocks = power_->clock_report();
  return facts;
}

facts::Timeline Simulation::timeline() const {
  facts::Timeline timeline = recorder_->timeline();
  facts::Timeline::Counter power{"Power", "W", 0, {}};
  for (const PowerTimeline::Point& point : power_->timeline().points) {
    power.points.push_back(
        {point.ps, std::accumulate(point.watts.begin(), point.watts.end(), 0.0)});
  }
  if (!power.points.empty()) timeline.counters.push_back(std::move(power));
  return timeline;
}

void Simulation::run(FrameBench::NextFrame next, FrameBench::FrameDone done) {
  const ConsoleFlush flush{zynq_->ps, logic_consoles_};
  const Debugged debugged(*zynq_);
  std::optional<vp::OutputFile> coverage;
  if (options_.register_coverage) coverage.emplace(*options_.register_coverage);
  std::optional<vp::OutputFile> profile_file;
  std::optional<Profiler> profiler;
  if (options_.software_profile) {
    profile_file.emplace(*options_.software_profile);
    profiler.emplace(*zynq_);
  }
  std::optional<BusLog> log;
  if (options_.bus_log) log.emplace(*options_.bus_log, *zynq_);
  std::optional<TransactionLog> transactions;
  if (options_.transactions) transactions.emplace(*options_.transactions, *zynq_);
  std::optional<BusHistory> history;
  if (options_.history) history.emplace(*options_.history, *zynq_);
  std::optional<StopPoint> stop;
  if (options_.stop) {
    stop.emplace(*options_.stop, *zynq_, reports_, stop_for_debugger);
  }
  std::exception_ptr error = simulate(std::move(next), std::move(done));
  if (history) history_ = history->lines();
  if (stop) missed_stop_ = stop->missed();
  // However the run ended.
  try {
    if (log) log->close();
    if (transactions) transactions->close();
    if (coverage) coverage->write(register_coverage(*zynq_));
    if (coverage) coverage->commit();
    if (profiler) {
      const double nj_per_cycle = power_->table().value("ps.core_cycle").nominal;
      software_profile_ = profiler->page_json(nj_per_cycle);
      profile_file->write(profiler->speedscope(nj_per_cycle));
      profile_file->commit();
    }
  } catch (const vp::OutputError&) {
    if (!error) error = std::current_exception();
  }
  if (error) std::rethrow_exception(error);
}

// Then the program ends where it is.
void Simulation::run_until(std::uint64_t ps) {
  const std::uint64_t most = sc_core::sc_max_time().value();
  if (ps < most) sc_core::sc_start(sc_core::sc_time::from_value(ps));
  if (ps < most && zynq_->ps.cpu.state() == ps::Cpu::State::running) interrupt();
}

void Simulation::start() {
  if (options_.history) run_until(options_.history->before_ps);
  sc_core::sc_start();
  if (control_) control_->finish();
  zynq_->ps.cpu.check();
  // Modules may have a last word: end_of_simulation().
  if (sc_core::sc_get_status() != sc_core::SC_STOPPED) sc_core::sc_stop();
}

// In a signal handler.
std::uint64_t Simulation::progress(const void* simulation) {
  return static_cast<const Simulation*>(simulation)->zynq_->scheduler.now_ps();
}

std::string Simulation::frame_text() const {
  if (work_.unit.empty()) return "in the run";
  return bench_->taken() == 0 ? "before the first " + work_.unit
                              : "in " + work_.unit + " " + std::to_string(bench_->taken());
}

std::exception_ptr Simulation::simulate(FrameBench::NextFrame next, FrameBench::FrameDone done) {
  bench_->start(
      [this] {
        folder_.restore();
        zynq_->settle();
        power_->frame_begins();
      },
      std::move(next),
      [this, done = std::move(done)](facts::UnitReport&& frame) {
        folder_.restore();
        power_->frame_ends(frame);
        recorder_->frame_done(frame);
        if (!recorder_->records()) power_->record_timeline(false);
        return done(std::move(frame));
      });
  // Not earlier: it opens its file, and the user may have got something else wrong.
  std::unique_ptr<vp::Tracer> tracer;
  std::optional<BusTrace> bus_trace;
  const auto& trace = options_.trace;
  if (trace && trace->level == vp::TraceLevel::everything) bus_trace.emplace(*zynq_);
  if (trace) tracer = std::make_unique<vp::Tracer>("tracer", zynq_->scheduler, *trace);
  std::exception_ptr error;
  try {
    vp::settle_foreign_modules();
    vp::call_objects([this] { start(); }, {&Simulation::progress, this, &Simulation::interrupt});
  } catch (const sc_core::sc_report& report) {  // of a model: vp::error()
    const bool ended = report.get_msg_type() == std::string_view(pl::rtl_ended);
    error = std::make_exception_ptr(
        vp::ProtocolError(report.get_msg() + (ended ? ", " + frame_text() : "")));
  } catch (const vp::ObjectEnd& end) {
    error = std::make_exception_ptr(
        vp::ProtocolError(std::string(end.what()) + place_in_object(end.fault()) + ", at " +
                          vp::format_time(zynq_->scheduler.now_ps()) + ", " + frame_text()));
  } catch (...) {
    error = std::current_exception();
  }
  reports_.finish();
  folder_.restore();
  if (tracer) wrote_trace_ = tracer->close();
  tracer.reset();
  late_warnings_ = bench_->finish();
  return error;
}

}  // namespace platform

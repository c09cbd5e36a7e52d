#include <unistd.h>

#include <cli/application.h>
#include <cli/commands.h>
#include <cli/diagram_page.h>
#include <cli/frame_runner.h>
#include <cli/program.h>
#include <cli/wave_page.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <result/console.h>
#include <result/page/report_page.h>
#include <result/result_json.h>
#include <result/verdict.h>
#include <study/contents.h>
#include <study/inputs.h>
#include <study/named_point.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace platform::cli {

namespace {

bool is_fidelity(const std::string& path) {
  return path == "fidelity" || path.rfind("pl.fidelity.", 0) == 0;
}

void refuse_doubles(const RunOptions& options) {
  const auto refuse = [](const std::string& option) {
    throw vp::InputError("--point names the " + option);
  };
  if (!options.inputs.empty()) refuse("inputs already: leave out INPUT");
  if (options.program) refuse("PS program already: leave out --program");
  for (const auto& [setting, unused] : options.input_settings) {
    if (study::is_file_setting(setting)) refuse(setting + " already: leave out --" + setting);
  }
}

RunOptions options_of(const study::Setup& setup, const RunOptions& options) {
  RunOptions result = options;
  result.inputs = setup.inputs;
  if (!setup.program.empty()) result.program = setup.program;
  for (const auto& setting : setup.input.settings) result.input_settings.insert(setting);
  if (!result.frames) result.frames = setup.input.frames;
  if (result.repeat == 1) result.repeat = setup.input.repeat;
  for (const auto& [path, value] : setup.settings) {
    if (is_fidelity(path) && (options.trace || options.fidelity)) continue;
    result.configuration.settings[path] = value;
  }
  return result;
}

}  // namespace

void warn_of_version(const study::NamedPoint& point, std::ostream& err) {
  if (point.asked.program != study::program_identity(program_version(), source_revision()))
    err << "markervp: warning: '" << point.name
        << "' was computed by another version of the program: results may differ" << std::endl;
}

RunOptions with_point(const RunOptions& options, std::ostream& err) {
  if (!options.point) return options;
  refuse_doubles(options);
  const study::NamedPoint point = study::named_point(*options.point);
  warn_of_version(point, err);
  return options_of(point.asked.setup, options);
}

namespace {

namespace fs = std::filesystem;
using HostClock = std::chrono::steady_clock;

vp::TraceLevel trace_level(const std::string& text) {
  if (text == "ports") return vp::TraceLevel::ports;
  return text == "registers" ? vp::TraceLevel::registers : vp::TraceLevel::everything;
}

vp::FrameTrigger trace_trigger(const RunOptions& options) {
  vp::FrameTrigger trigger;
  trigger.condition = vp::Expression(*options.trace_trigger, "--trace-trigger");
  trigger.frames_before = options.trace_before;
  trigger.buffer = options.trace_buffer << 20;
  trigger.expected = options.trace_trigger_expected;
  if (options.trace_frame) trigger.frame = *options.trace_frame;
  return trigger;
}

vp::TraceOptions trace_options(const RunOptions& options) {
  vp::TraceOptions trace;
  trace.file = *options.trace;
  if (!vp::is_wave_file_name(trace.file)) {
    throw vp::InputError("--trace '" + *options.trace +
                         "': the file's name must end in .vcd, .vcd.gz or .fst");
  }
  if (options.trace_window) {
    const TimeWindow window = parse_trace_window(*options.trace_window);
    trace.from_ps = window.from_ps;
    trace.to_ps = window.to_ps;
  }
  trace.filter = vp::TraceFilter(options.trace_filter);
  trace.level = trace_level(options.trace_level);
  trace.clocks = options.trace_clocks;
  if (options.trace_trigger) trace.trigger = trace_trigger(options);
  return trace;
}

BusHistoryOptions history_options(const HistoryOptions& options) {
  BusHistoryOptions result;
  result.at = options.at;
  result.count = options.count;
  result.writes_only = options.writes_only;
  if (options.before) result.before_ps = parse_moment(*options.before, "--before");
  return result;
}

StopOptions stop_options(const DebugOptions& options) {
  using When = StopOptions::When;
  if (options.at) return {When::at_time, parse_moment(*options.at, "--at"), {}, false, 1};
  if (options.at_register)
    return {When::access, 0, *options.at_register, options.writes_only, options.access};
  if (options.warning) return {When::warning, 0, {}, false, *options.warning};
  return {When::failure, 0, {}, false, 1};
}

/// The inputs are the application's arguments.
LinuxOptions linux_options(const RunOptions& options) {
  const auto refuse = [](const std::string& option) {
    throw vp::InputError("--linux with " + option +
                         ": a Linux application takes no inputs, and is no PS program; leave one "
                         "of the two out");
  };
  if (options.program) refuse("--program");
  if (!options.input_settings.empty()) refuse("--" + options.input_settings.begin()->first);
  if (options.rate) refuse("--rate");
  if (options.frames) refuse("--frames");
  if (options.repeat != 1) refuse("--repeat");
  if (options.point) refuse("--point");
  return {*options.linux_app, options.inputs};
}

SimulationOptions simulation_options(const RunOptions& options) {
  const bool traces = options.trace_window || !options.trace_filter.empty() ||
                      options.trace_clocks || options.trace_trigger;
  if (traces && !options.trace) {
    throw vp::InputError("options of the trace without one: name its file with --trace");
  }
  SimulationOptions result;
  result.program = options.program;
  if (options.linux_app) result.linux_app = linux_options(options);
  if (options.trace) result.trace = trace_options(options);
  if (!options.log_bus_filter.empty() && !options.log_bus) {
    throw vp::InputError("--log-bus-filter without a log: name its file with --log-bus");
  }
  result.timeline_frames = options.timeline_frames;
  if (options.log_bus) result.bus_log = {*options.log_bus, options.log_bus_filter};
  if (options.history) result.history = history_options(*options.history);
  if (options.debug) result.stop = stop_options(*options.debug);
  result.transactions = options.transactions;
  result.register_coverage = options.register_coverage;
  result.software_profile = options.software_profile;
  if (options.control && !host::is_socket(*options.control)) {
    throw vp::InputError("--control " + std::to_string(*options.control) +
                         ": no socket is open under this number: python/markervp.py opens one");
  }
  result.control = options.control;
  for (const std::string& text : options.terminals) {
    const TerminalOptions terminal = TerminalOptions::parse(text);
    for (const TerminalOptions& other : result.terminals) {
      if (other.uart == terminal.uart)
        throw vp::InputError("--terminal: " + terminal.uart + " is named twice");
    }
    result.terminals.push_back(terminal);
  }
  return result;
}

/// A Linux application has the inputs' words for arguments.
study::InputRequest input_request(const RunOptions& options, const Simulation& simulation) {
  study::InputRequest request{options.inputs, options.input_settings, simulation.input(),
                              options.repeat, options.frames};
  if (options.linux_app) request.names.clear();
  return request;
}

/// Without "." and a "/" at the end, so that two ways to write it are equal.
fs::path normal_folder(const fs::path& folder) {
  return (fs::absolute(folder) / "").lexically_normal().parent_path();
}

/// Throws if the trace could not be written when the time comes; makes nothing. The output folder
/// is made later.
void check_trace(const RunOptions& options) {
  if (!options.trace) return;
  const fs::path folder = normal_folder(fs::absolute(*options.trace).parent_path());
  std::error_code ignored;
  if (folder == normal_folder(options.output) && !fs::exists(folder, ignored)) return;
  const int problem = vp::output_problem(*options.trace);
  if (problem != 0) throw vp::OutputError(*options.trace, problem);
}

/// The files that a run writes beside its folder.
std::vector<std::string> other_outputs(const RunOptions& options) {
  std::vector<std::string> files;
  for (const auto& file : {options.trace, options.timeline, options.log_bus, options.transactions,
                           options.register_coverage, options.software_profile}) {
    if (file) files.push_back(*file);
  }
  return files;
}

/// Throws if one file would replace another. Devices and pipes take everything.
void check_outputs_differ(const RunOptions& options) {
  std::set<fs::path> paths;
  std::error_code ignored;
  for (const std::string& file : other_outputs(options)) {
    if (fs::is_other(file, ignored)) continue;
    if (!paths.insert(fs::weakly_canonical(fs::absolute(file), ignored)).second)
      throw vp::InputError("two outputs would be one file: '" + file + "'; name another for one");
  }
}

/// What `error` says; empty for none.
std::string message_of(const std::exception_ptr& error) {
  if (!error) return "";
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& exception) {
    return exception.what();
  } catch (...) {
    return "unknown error";
  }
}

bool is_input_error(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const vp::InputError&) {
    return true;
  } catch (...) {
    return false;
  }
}

/// The reason without folders, which belong into the provenance only.
std::optional<std::string> incomplete(const FrameRunner& runner) {
  if (runner.error()) return "stopped by an error";
  if (host::InterruptGuard::noted()) return "interrupted";
  return std::nullopt;
}

/// Prints each warning once.
class Warner {
 public:
  explicit Warner(std::ostream& err) : err_(err) {}

  void print(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
      if (std::find(seen_.begin(), seen_.end(), warning) != seen_.end()) continue;
      seen_.push_back(warning);
      err_ << "markervp: warning: " << warning << std::endl;
    }
  }
  const std::vector<std::string>& all() const { return seen_; }

 private:
  std::ostream& err_;
  std::vector<std::string> seen_;
};

/// What shows a run beside its result.
struct Views {
  vp::OutputFile* timeline;  ///< null: not wanted
  page::RunExtras* page;     ///< null: not wanted
  host::OutputFolder& folder;
  const vp::Configuration& configuration;
  const std::optional<std::string>& trace;
};

/// Writes them, after the result. One that cannot be written does not keep the other from it; the
/// first error is noted if there was none before. Returns whether there is a page.
bool write_views(const Views& views, Simulation& simulation, std::exception_ptr& error) {
  const auto attempt = [&](const auto& write) {
    try {
      write();
      return true;
    } catch (const vp::OutputError&) {
      if (!error) error = std::current_exception();
      return false;
    }
  };
  const facts::Timeline timeline = simulation.timeline();
  if (views.timeline) {
    attempt([&] {
      views.timeline->write(facts::trace_event_json(timeline));
      views.timeline->commit();
    });
  }
  if (!views.page) return false;
  if (!timeline.empty()) views.page->add_member("timeline", facts::page_json(timeline));
  const std::string& profile = simulation.software_profile();
  if (!profile.empty()) views.page->add_member("profile", profile);
  if (simulation.wrote_trace()) views.page->add_member("waves", waves_of_run(*views.trace));
  add_diagram(*views.page, simulation.zynq(), views.configuration, views.folder.path());
  return attempt([&] {
    views.folder.add(page::report_name);
    page::write_report(views.folder.path(), views.page->json(views.configuration.parameters()));
  });
}

/// What the user should know of the signals in a trace.
std::string trace_text(const RunOptions& options, const trace::Vocabulary& words,
                       const vp::Configuration& configuration) {
  if (!options.trace) return "";
  if (!configuration.find("fidelity"))
    return "\n--trace chose fidelity clocked, which plays every signal; --fidelity tlm is faster "
           "and leaves some out";
  std::vector<std::string> still;
  const std::map<std::string, std::string> values = configuration.values();
  for (const trace::Vocabulary::Unplayed& unplayed : words.unplayed) {
    const auto found = values.find(unplayed.fidelity);
    if (found != values.end() && found->second == "tlm") still.push_back(unplayed.signals);
  }
  return still.empty() ? ""
                       : "\nfidelity tlm does not play " + vp::join(still, ", ") +
                             ": --fidelity clocked does";
}

std::vector<std::string> own_lines(const facts::Summary& summary) {
  const Application& own = application();
  return own.summary_lines ? own.summary_lines(summary) : std::vector<std::string>();
}

/// `failed`: something could not be written, which has its own message.
std::string written_text(const RunOptions& options, const FrameRunner& runner,
                         const Simulation& simulation, const vp::Configuration& configuration,
                         bool has_page, bool failed) {
  const bool has_trace = simulation.wrote_trace();
  std::string text = "\nwrote " + (fs::path(options.output) / "result.json").string();
  if (runner.pictures() > 0)
    text += ", " + result::counted(runner.pictures(), "picture") + " beside it";
  if (has_page) text += ", report.html to look at";
  if (!failed) {
    for (const std::string& file : other_outputs(options)) {
      if (file != options.trace || has_trace) text += ", " + file;
    }
    if (has_trace) text += trace_text(options, simulation.words(), configuration);
  }
  if (!options.no_report && page::page_template().empty())
    text += "\nno report.html: this markervp was built without it (needs Node.js and npm)";
  return text + "\n";
}

/// `warnings`: those of the run as a whole, which no unit's report has. `job`: of the verdict.
int verdict(const RunOptions& options, const FrameRunner& runner, const facts::RunFacts& facts,
            const result::Verdict::Part& job, std::uint64_t warnings,
            const std::exception_ptr& error, std::ostream& err) {
  if (error) std::rethrow_exception(error);
  if (host::InterruptGuard::noted()) {
    err << "markervp: interrupted; results up to here are kept" << std::endl;
    return interrupted;
  }
  if (facts.end && facts.end->exit_code != 0) {
    err << "markervp: program '" << facts.system << "' ended with exit code "
        << facts.end->exit_code << std::endl;
    return run_failed;
  }
  if (const std::string misfit = runner.misfit(); !misfit.empty()) {
    err << "markervp: " << misfit << std::endl;
    return host::wrong_input;
  }
  const auto missing = [&](const std::string& what, const FrameRunner::Missing& units) {
    err << "markervp: " << what << " in " << units.units << " of "
        << facts.work.counted(runner.frames()) << ", first in " << units.first << std::endl;
    return run_failed;
  };
  for (const facts::Tally& tally : facts.work.tallies) {
    const auto& required = options.required;
    const FrameRunner::Missing units = runner.without(tally.name);
    if (std::find(required.begin(), required.end(), tally.name) != required.end() &&
        units.units > 0)
      return missing(tally.without, units);
  }
  if (options.require_job && runner.unfulfilled().units > 0)
    return missing("job not done", runner.unfulfilled());
  if (options.require_job && job.holds != result::Holds::yes) {
    err << "markervp: job not done: " << job.why << std::endl;
    return run_failed;
  }
  warnings += runner.warnings();
  if (options.strict && warnings > 0) {
    err << "markervp: " << result::counted(warnings, "warning") << ", and --strict lets none pass"
        << std::endl;
    return run_failed;
  }
  return done;
}

/// The result goes to `memory`, and nothing is written; null: to files, as the options say.
int run_into(MemoryRun* memory, const RunOptions& asked_for,
             const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  const HostClock::time_point start = HostClock::now();
  if (asked_for.linux_app && asked_for.point) linux_options(asked_for);
  const RunOptions options = with_point(asked_for, err);
  vp::Configuration configuration;
  load_configuration(options.configuration, configuration);
  choose_platform(options, configuration);
  SimulationOptions asked = simulation_options(options);
  const bool page = !options.no_report && !page::page_template().empty();
  if (!page && !options.timeline) asked.timeline_frames = 0;
  asked.console = memory ? memory->console : &out;
  const std::unique_ptr<Simulation> simulation = build(configuration, asked);
  const auto source = study::open_inputs(input_request(options, *simulation));
  FrameRunner runner(*source);
  check_outputs_differ(options);
  check_trace(options);
  std::optional<host::OutputFolder> folder;
  if (!memory) folder.emplace(options.output);
  std::optional<vp::OutputFile> timeline_file;
  if (options.timeline) timeline_file.emplace(*options.timeline);
  facts::Provenance origin;
  if (!memory) origin = provenance(options, arguments, configuration);
  Warner warner(err);
  warner.print(source->warnings());

  std::unique_ptr<result::ResultWriter> file;
  if (folder) file = std::make_unique<result::ResultWriter>(*folder);
  result::ResultSink& result = memory ? static_cast<result::ResultSink&>(memory->result) : *file;
  const host::InterruptGuard guard([] { Simulation::interrupt(); });
  const bool bar = options.quiet || ::isatty(STDOUT_FILENO) == 0;
  page::RunExtras extras;
  runner.run(*simulation, {folder && !options.no_pictures ? &*folder : nullptr, !options.quiet, bar,
                           options.frames_done, out, result, page ? &extras : nullptr});

  facts::RunFacts facts = simulation->facts();
  const bool ran = runner.frames() > 0 || facts.end;
  if (runner.error() && !ran && is_input_error(runner.error())) {
    std::rethrow_exception(runner.error());
  }
  warner.print(source->warnings());
  facts.notes = source->notes();
  if (!memory) facts.configuration = configuration.values();
  if (facts.timing) warner.print(result::timing_warnings(*facts.timing));
  if (facts.clocks) warner.print(result::clock_warnings(*facts.clocks));
  if (facts.resources) warner.print(result::resource_warnings(*facts.resources));
  if (facts.power) warner.print(result::power_warnings(*facts.power));
  origin.wall_time_s = std::chrono::duration<double>(HostClock::now() - start).count();
  if (runner.error()) origin.details.emplace_back("error", message_of(runner.error()));
  // They were printed when they came.
  std::vector<std::string> warnings = warner.all();
  warnings.insert(warnings.end(), facts.warnings.begin(), facts.warnings.end());
  facts.incomplete = incomplete(runner);
  result.finish(facts, origin, warnings);
  const result::Verdict::Part job = result::job_of(facts, result.summary());
  if (memory) {
    memory->configuration = configuration.values();
    memory->history = simulation->history();
    memory->missed_stop = simulation->missed_stop();
    return verdict(options, runner, facts, job, warnings.size(), runner.error(), err);
  }
  std::exception_ptr error = runner.error();
  const bool has_page =
      write_views({timeline_file ? &*timeline_file : nullptr, page ? &extras : nullptr, *folder,
                   configuration, options.trace},
                  *simulation, error);
  out << (options.quiet ? "" : "\n")
      << result::summary_text(result.summary(), facts, own_lines(result.summary()))
      << written_text(options, runner, *simulation, configuration, has_page, error != nullptr)
      << std::flush;
  return verdict(options, runner, facts, job, warnings.size(), error, err);
}

}  // namespace

int run(const RunOptions& options, const std::vector<std::string>& arguments, std::ostream& out,
        std::ostream& err) {
  return run_into(nullptr, options, arguments, out, err);
}

int run_in_memory(const RunOptions& options, MemoryRun& result, std::ostream& err) {
  RunOptions silent = options;
  silent.no_pictures = silent.no_report = silent.quiet = true;
  std::ostringstream unread;
  return run_into(&result, silent, {}, unread, err);
}

}  // namespace platform::cli

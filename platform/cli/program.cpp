#include <cli/program.h>

#include <cli/app.h>
#include <cli/commands.h>
#include <host/process.h>
#include <study/inputs.h>
#include <vp/error.h>
#include <CLI/CLI.hpp>

#include <ostream>
#include <utility>

namespace platform::cli {

namespace {

Application& registered() {
  static Application of_program;
  return of_program;
}

}  // namespace

const Application& application() {
  return registered();
}

ApplicationRegistration::ApplicationRegistration(Application application) {
  registered() = std::move(application);
}

std::string program_version() {
  return MARKERVP_VERSION;
}

std::string source_revision() {
  return MARKERVP_REVISION;
}

std::string version_text() {
  const std::string revision = source_revision();
  return "markervp " + program_version() + (revision.empty() ? "" : " (" + revision + ")");
}

facts::Provenance provenance(const RunOptions& options, const std::vector<std::string>& arguments,
                             const vp::Configuration& configuration) {
  facts::Provenance result;
  result.program = "markervp";
  result.version = program_version();
  result.revision = source_revision();
  result.configuration_hash = configuration.hash();
  result.command_line = arguments;
  result.host = host::host_name();
  result.date = host::utc_now();
  result.details.emplace_back("output", options.output);
  for (const auto& [name, value] : options.input_settings) {
    if (study::is_file_setting(name)) result.details.emplace_back(name, value);
  }
  if (options.program) result.details.emplace_back("program_file", *options.program);
  if (options.linux_app) result.details.emplace_back("linux_application", *options.linux_app);
  if (options.trace) result.details.emplace_back("trace", *options.trace);
  return result;
}

namespace {

int run_command(const CLI::App& app, const CommandLine& line,
                const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  const std::string command = app.get_subcommands().front()->get_name();
  const auto own = line.application.find(command);
  if (own != line.application.end()) return own->second(arguments, out, err);
  if (command == "run") return run(line.run, arguments, out, err);
  if (command == "history") return tell_history(line.history, out);
  if (command == "debug") return debug_run(line.debug, out, err);
  if (command == "faults") return run_faults(line.faults, out, err);
  if (command == "designs") return list_designs(line.designs, out);
  if (command == "config") return print_configuration(line.config, out);
  if (command == "map") return print_map(line.map, out);
  if (command == "import") return import_handoff(line.import, out);
  if (command == "report") return make_report(line.report, out, err);
  if (command == "devices") return list_devices(line.devices, out);
  if (command == "clocks") return list_clocks(line.clocks, out);
  if (command == "power")
    return line.power.design.empty() ? print_power_table(line.power, out)
                                     : print_power_estimate(line.power, out);
  if (command == "rtl") return ask_rtl(line.rtl, arguments, out, err);
  if (command == "trace") return ask_trace(line.trace, out, err);
  if (command == "explore") return explore_points(line.explore, out, err);
  if (command == "sweep") return sweep_points(line.sweep, out, err);
  if (command == "sweep-worker") return sweep_worker(line.sweep_worker, err);
  if (command == "metrics") return list_metrics(line.metrics, out);
  if (command == "pareto") return find_pareto(line.pareto, out, err);
  if (command == "sensitivity") return find_sensitivity(line.sensitivity, out, err);
  if (command == "compare") return compare_runs(line.compare, out, err);
  return print_completion(app, out);
}

/// `code`, if all was written that the user is to read. A failure has told its own.
int written(int code, std::ostream& out) {
  if (code == done) host::check_written(out);
  return code;
}

/// In the order that the parser wants. `--rate 60 fps` is one value, quoted or not.
std::vector<std::string> for_parser(const std::vector<std::string>& arguments) {
  std::vector<std::string> words;
  for (const std::string& word : arguments) {
    const bool is_unit = word == "fps" && words.size() > 1 && words[words.size() - 2] == "--rate";
    if (is_unit) {
      words.back() += " fps";
    } else {
      words.push_back(word);
    }
  }
  return {words.rbegin(), words.rend()};
}

}  // namespace

void parse_again(const std::vector<std::string>& arguments, CommandLine& line) {
  try {
    make_app(line)->parse(for_parser(arguments));
  } catch (const CLI::ParseError& error) {
    throw vp::InputError(std::string("the run's command line is not one of this version: ") +
                         error.what());
  }
}

int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  CommandLine line;
  const std::unique_ptr<CLI::App> app = make_app(line);
  try {
    app->parse(for_parser(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      return host::fail(err, usage_error(*app, error, arguments), wrong_input);
    }
    app->exit(error, out, err);
    return host::exit_code_of([&] { return written(done, out); }, err);
  }
  return host::exit_code_of(
      [&] { return written(run_command(*app, line, arguments, out, err), out); }, err);
}

}  // namespace platform::cli

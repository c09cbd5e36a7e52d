#include <algorithm>
#include <atomic>
#include <boost/interprocess/anonymous_shared_memory.hpp>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <ostream>
#include <thread>

#include <chip/run/cost_profile.h>
#include <cli/app.h>
#include <cli/commands.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <marker/commands/commands.h>
#include <marker/input/frame_source.h>
#include <marker/validation/validation.h>
#include <result/page/report_page.h>
#include <vp/file.h>
#include <vp/progress.h>
#include <CLI/CLI.hpp>

namespace platform::commands {

using namespace cli;

namespace {

/// `markervp validate`.
struct ValidateOptions {
  ConfigurationOptions configuration;
  std::string output = "out/validation";
  std::optional<std::string> profile;
  std::optional<std::string> fidelity;
  std::optional<std::string> markdown;  ///< page of the documentation to write
  std::uint32_t repetitions = 1;        ///< of each measurement, with jitter; 1: exact
  std::uint32_t jobs = 2;               ///< runs side by side
  bool no_report = false;
};

namespace fs = std::filesystem;

RunOptions run_options(const ValidateOptions& options, const validation::System& system) {
  RunOptions run;
  run.inputs = validation::all_tests;
  run.configuration = options.configuration;
  if (options.profile) run.configuration.assignments.push_back("profile=" + *options.profile);
  run.fidelity = options.fidelity;
  run.configuration.design = system.design;
  run.output = (fs::path(options.output) / system.name).string();
  run.no_pictures = true;
  run.no_report = true;
  run.quiet = true;
  return run;
}

/// Exit code of a run that did not end well, after its messages; equal ones are printed once.
int failure(const std::vector<host::ChildEnd>& ends, std::ostream& err) {
  int code = done;
  std::string printed;
  for (const host::ChildEnd& end : ends) {
    const std::string message =
        end.signal != 0 ? "markervp: a run was ended by signal " + std::to_string(end.signal) + "\n"
                        : end.err;
    if (message != printed) err << message;
    printed = message;
    if (code == done) code = end.signal != 0 ? static_cast<int>(run_failed) : end.exit_code;
  }
  return code;
}

/// Waits for the run's end and shows meanwhile how many frames are done.
host::ChildEnd watch(host::Child& run, vp::Progress& bar, const std::atomic<std::uint64_t>& done) {
  while (!run.ended()) {
    bar.update(done);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return run.wait();
}

/// Both systems on all images, side by side if there are jobs enough.
int run_systems(const ValidateOptions& options, const std::vector<std::string>& arguments,
                std::ostream& err) {
  std::vector<host::Child> children;
  std::vector<host::ChildEnd> ends;
  const auto memory =
      boost::interprocess::anonymous_shared_memory(sizeof(std::atomic<std::uint64_t>));
  auto& frames_done = *new (memory.get_address()) std::atomic<std::uint64_t>(0);
  const std::uint64_t frames = input::open_inputs(validation::all_tests, {})->size().value_or(0);
  vp::Progress bar("frames", std::size(validation::systems) * frames);
  for (const validation::System& system : validation::systems) {
    RunOptions run_it = run_options(options, system);
    run_it.frames_done = &frames_done;
    children.emplace_back([&, run_it](std::ostream& child_out, std::ostream& child_err) {
      return run(run_it, arguments, child_out, child_err);
    });
    if (options.jobs == 1) ends.push_back(watch(children.back(), bar, frames_done));
  }
  if (ends.empty()) {
    for (host::Child& child : children) ends.push_back(watch(child, bar, frames_done));
  }
  return failure(ends, err);
}

validation::Measured read_runs(const ValidateOptions& options) {
  const auto read = [&](const validation::System& system) {
    return validation::read_run(fs::path(options.output) / system.name / "result.json");
  };
  return {read(validation::hybrid), read(validation::ps_only)};
}

/// What was written.
std::string write_results(const ValidateOptions& options, const validation::Validation& result) {
  const fs::path folder = options.output;
  vp::write_file((folder / "validation.json").string(), validation::json_text(result));
  vp::write_file((folder / "validation.csv").string(), validation::rows_csv(result));
  vp::write_file((folder / "frames.csv").string(), validation::frames_csv(result));
  std::string text = "wrote validation.json, validation.csv, frames.csv in " + folder.string();
  if (!options.no_report && page::write_report(folder.string())) text += ", report.html to look at";
  if (options.markdown) {
    vp::write_file(*options.markdown, validation::markdown_text(result));
    text += ", " + *options.markdown;
  }
  return text + "\n";
}

constexpr std::uint32_t most_repetitions = 10'000;

int validate(const ValidateOptions& options, const std::vector<std::string>& arguments,
             std::ostream& out, std::ostream& err) {
  const auto published = validation::read_published(validation::published_file());
  if (options.markdown) host::prepare_output_file(*options.markdown);
  host::prepare_output_folder(options.output);
  if (const int code = run_systems(options, arguments, err); code != done) {
    return code;
  }
  const validation::Measured measured = read_runs(options);
  const auto profile =
      profiles::load_cost_profile(measured.hybrid.configuration.at("profile"), std::nullopt);
  const validation::Validation result =
      validation::validate_runs(measured, profile, published, options.repetitions);
  const std::string written = write_results(options, result);
  out << validation::console_text(result) << written << std::flush;
  return result.passed() ? done : run_failed;
}

}  // namespace

cli::Command add_validate(CLI::App& parser) {
  const auto options = std::make_shared<ValidateOptions>();
  ValidateOptions& target = *options;
  CLI::App* command = parser.add_subcommand("validate", "compare with what the thesis measured");
  command
      ->add_option("-o,--output", target.output, "folder for the results (default: out/validation)")
      ->type_name("DIR");
  command->add_option("--profile", target.profile, "cost profile of the software: a name or a file")
      ->type_name("NAME");
  command->add_option("--fidelity", target.fidelity, "how the PL is modelled (default: tlm)")
      ->type_name("tlm|clocked");
  command
      ->add_option("--repetitions", target.repetitions,
                   "measure so often, with the published jitter (default: once, exactly)")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{1}, most_repetitions).description(""));
  command->add_option("--jobs", target.jobs, "systems that run side by side (default: 2)")
      ->type_name("1|2")
      ->check(CLI::Range(std::uint32_t{1}, std::uint32_t{2}).description(""));
  command->add_option("--markdown", target.markdown, "write the page of the documentation too")
      ->type_name("FILE");
  command->add_flag("--no-report", target.no_report, "no page report.html");
  add_configuration_options(*command, target.configuration);
  return {"validate",
          [options](const std::vector<std::string>& arguments, std::ostream& out,
                    std::ostream& err) { return validate(*options, arguments, out, err); }};
}

}  // namespace platform::commands

#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <designs/designs.h>
#include <run/simulation.h>
#include <vp/decimal.h>
#include <vp/error.h>

namespace platform::cli {

namespace {

/// A plain number is frames a second.
std::string with_unit(const std::string& rate) {
  return vp::Decimal::parse(rate) ? rate + " fps" : rate;
}

}  // namespace

void load_configuration(const ConfigurationOptions& options, vp::Configuration& configuration) {
  for (const std::string& file : options.files) configuration.load_file(file);
  for (const std::string& assignment : options.assignments) configuration.set(assignment);
  if (options.design) configuration.set("design", *options.design, "--design");
}

void choose_platform(const PlatformOptions& options, const ConfigurationOptions& asked,
                     vp::Configuration& configuration) {
  if (options.fidelity) configuration.set("fidelity", *options.fidelity, "--fidelity");
  if (options.rate) configuration.set("camera.rate", with_unit(*options.rate), "--rate");
  if (!options.system) return;
  if (asked.design) {
    throw vp::InputError("--system names the design already: leave out --design");
  }
  configuration.set("design", design_of_program(*options.system).name, "--system");
}

std::optional<std::string> program_of(const PlatformOptions& options) {
  if (options.system && options.program) {
    throw vp::InputError("--system names the program already: leave out --program");
  }
  return options.system ? options.system : options.program;
}

std::unique_ptr<Simulation> build(vp::Configuration& configuration,
                                  const SimulationOptions& options) {
  const vp::Configuration::Scope scope(configuration);
  auto simulation = std::make_unique<Simulation>(options);
  configuration.check_unused();
  return simulation;
}

int print_configuration(const ConfigOptions& options, std::ostream& out) {
  vp::Configuration configuration;
  load_configuration(options.configuration, configuration);
  choose_platform(options, options.configuration, configuration);
  SimulationOptions asked;
  asked.program = program_of(options);
  build(configuration, asked);
  out << configuration.to_yaml();
  return done;
}

}  // namespace platform::cli

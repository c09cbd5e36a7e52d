#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
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

void choose_platform(const PlatformOptions& options, vp::Configuration& configuration) {
  if (options.fidelity) configuration.set("fidelity", *options.fidelity, "--fidelity");
  if (options.rate) configuration.set("camera.rate", with_unit(*options.rate), "--rate");
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
  choose_platform(options, configuration);
  SimulationOptions asked;
  asked.program = options.program;
  build(configuration, asked);
  out << configuration.to_yaml();
  return done;
}

}  // namespace platform::cli

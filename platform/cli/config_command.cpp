#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>

namespace platform::cli {

void load_configuration(const ConfigurationOptions& options, vp::Configuration& configuration) {
  for (const std::string& file : options.files) configuration.load_file(file);
  for (const std::string& assignment : options.assignments) configuration.set(assignment);
}

std::unique_ptr<Simulation> build(vp::Configuration& configuration,
                                  const SimulationOptions& options,
                                  const SimulationFactory& make_simulation) {
  const vp::Configuration::Scope scope(configuration);
  std::unique_ptr<Simulation> simulation = make_simulation(options);
  configuration.check_unused();
  return simulation;
}

int print_configuration(const ConfigOptions& options, const SimulationFactory& make_simulation,
                        std::ostream& out) {
  vp::Configuration configuration;
  load_configuration(options.configuration, configuration);
  build(configuration, {}, make_simulation);
  out << configuration.to_yaml();
  return done;
}

}  // namespace platform::cli

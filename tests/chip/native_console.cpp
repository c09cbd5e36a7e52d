#include "native_console.h"

#include <chip/run/simulation.h>
#include <vp/configuration.h>

#include "simulation.h"

std::vector<std::string> native_console(
    const std::string& program_file,
    const std::vector<std::pair<std::string, std::string>>& settings) {
  const kit::Simulation context;
  vp::Configuration configuration;
  for (const auto& [path, value] : settings) configuration.set(path, value);
  const vp::Configuration::Scope scope(configuration);
  platform::Simulation simulation({program_file});
  configuration.check_unused();
  std::vector<std::string> lines;
  simulation.zynq().ps.cpu.console.connect([&](const std::string& line) { lines.push_back(line); });
  simulation.run([] { return platform::facts::SharedInput(); },
                 [](platform::facts::UnitReport&&) { return true; });
  return lines;
}

#pragma once

#include <memory>

#include <cli/simulation.h>

namespace platform::cli {

/// The Zynq-7020 as the command line sees it. `options.program` is a file, or the name of a program
/// in the folder `programs` of library_folders(); none means that of the design.
std::unique_ptr<Simulation> make_zynq_simulation(const SimulationOptions& options);

}  // namespace platform::cli

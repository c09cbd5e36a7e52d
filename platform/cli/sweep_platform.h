#pragma once

#include <sweep/engine.h>
#include <sweep/plan.h>

#include <cli/options.h>
#include <cli/simulation.h>

namespace platform::cli {

/// What sweeps ask of the platform. `make_simulation` lives as long as they do.
sweep::Platform sweep_platform(const SimulationFactory& make_simulation);
/// The command line of `markervp run` that runs the point.
RunOptions options_of(const sweep::PointRun& point);
sweep::RunPoint point_runner(const SimulationFactory& make_simulation);

/// Renders the scenes of the points before processes are forked.
void warm_up(const sweep::Manifest& manifest, const std::vector<std::size_t>& positions);

}  // namespace platform::cli

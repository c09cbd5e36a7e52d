#pragma once

#include <sweep/engine.h>
#include <sweep/plan.h>

#include <cli/options.h>

namespace platform::cli {

/// What sweeps ask of the platform.
sweep::Platform sweep_platform();
/// The command line of `markervp run` that runs the point.
RunOptions options_of(const sweep::PointRun& point);
/// Runs it in this process, without files: a sweep::RunPoint.
int run_point(const sweep::PointRun& point, sweep::PointResult& result, std::ostream& err);

/// Renders the scenes of the points before processes are forked.
void warm_up(const sweep::Manifest& manifest, const std::vector<std::size_t>& positions);

}  // namespace platform::cli

#pragma once

#include <sweep/engine.h>
#include <sweep/plan.h>

#include <cli/options.h>

#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>

namespace platform::cli {

/// The document that `work` makes in a forked process: SystemC and PS programs leave nothing behind
/// in this one, and may crash. If `work` throws or makes no object, throws what it said last on
/// `err`: vp::ProtocolError if hardware or software broke a rule, else vp::InputError.
nlohmann::ordered_json made_apart(
    const std::function<nlohmann::ordered_json(std::ostream& err)>& work);

/// Builds the platform, apart, and tells its parameters. Throws vp::InputError.
sweep::Elaborated elaborate(const ConfigurationOptions& options,
                            const std::optional<std::string>& program = std::nullopt);

/// What sweeps ask of the platform.
sweep::Platform sweep_platform();
/// The command line of `markervp run` that runs the point.
RunOptions options_of(const sweep::PointRun& point);
/// Runs it in this process, without files: a sweep::RunPoint.
int run_point(const sweep::PointRun& point, sweep::PointResult& result, std::ostream& err);

/// Renders the scenes of the points before processes are forked.
void warm_up(const sweep::Manifest& manifest, const std::vector<std::size_t>& positions);

}  // namespace platform::cli

#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include <cli/options.h>
#include <study/engine.h>
#include <study/named_point.h>
#include <study/plan.h>
#include <study/results.h>
#include <study/shards.h>
#include <nlohmann/json.hpp>

/// What commands that compute points have in common.
namespace platform::cli {

/// The document that `work` makes in a forked process: SystemC and PS programs leave nothing behind
/// in this one, and may crash. If `work` throws or makes no object, throws what it said last on
/// `err`: vp::ProtocolError if hardware or software broke a rule, else vp::InputError.
nlohmann::ordered_json made_apart(
    const std::function<nlohmann::ordered_json(std::ostream& err)>& work);

/// Builds the platform, apart, and tells its parameters. Throws vp::InputError.
study::Elaborated elaborate(const ConfigurationOptions& options,
                            const std::optional<std::string>& program = std::nullopt);

/// What sweeps ask of the platform.
study::Platform sweep_platform();
/// The command line of `markervp run` that runs it.
RunOptions options_of(const study::Setup& setup);
/// Whether PS program or design are the user's own, and so may leave anything behind.
bool runs_own_code(const std::string& program,
                   const std::map<std::string, std::string>& configuration);
/// Runs it in this process, without files: a study::RunPoint. Programs that are installed stay
/// loaded.
int run_point(const study::Setup& setup, study::RunResult& result, std::ostream& err);

/// Makes inputs of the points that take long before processes are forked.
void warm_up(const study::Manifest& manifest, const std::vector<std::size_t>& positions);

/// Says on `err` if another version of the program computed it.
void warn_of_version(const study::NamedPoint& point, std::ostream& err);

/// Says on `err` which shards are damaged.
void tell_damages(const study::Shards& shards, std::ostream& err);

/// Positions of the points from `first` on that are to be computed: those without a result, or
/// without the whole one if that is kept. Results of earlier versions are taken over. Throws
/// vp::InputError for one that was changed.
std::vector<std::size_t> pending_points(const SweepOptions& options, const study::Store& store,
                                        study::Shards& shards, const study::Manifest& manifest,
                                        std::size_t first, std::ostream& err);

/// Computes points with the engine that the user wants, until `is_over`; the store has the manifest
/// if it is not the local one.
study::Tally compute(const SweepOptions& options, const study::Store& store,
                     const study::Manifest& manifest, const std::vector<std::size_t>& pending,
                     const study::OnProgress& progress, std::ostream& err,
                     const study::IsOver& is_over = {});

/// What the page of such points has besides them: how a search went.
study::Json page_extras(const study::Results& results);

/// Writes tables, database and page, and says what was found. `computed` now, `before` earlier.
void write_results(const SweepOptions& options, const study::Store& store,
                   const study::Shards& shards, const study::Results& results,
                   std::uint64_t computed, std::uint64_t before, std::ostream& out);

/// What the command ends with, after a line if points failed.
int code_of_failures(const SweepOptions& options, const study::Results& results, std::ostream& err);

}  // namespace platform::cli

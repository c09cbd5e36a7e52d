#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include <cli/options.h>
#include <sweep/engine.h>
#include <sweep/results.h>
#include <sweep/run_log.h>

/// What commands that compute points have in common.
namespace platform::cli {

/// Positions of the points from `first` on that have no result yet. Results that no log knows are
/// read, and logged. Throws vp::InputError for one that somebody changed.
std::vector<std::size_t> pending_points(const sweep::Store& store, sweep::RunLogs& logs,
                                        const sweep::Manifest& manifest, std::size_t first,
                                        bool retry_failed, std::ostream& err);

/// Computes points with the engine that the user wants; the store has the manifest if it is not
/// the local one.
sweep::Tally compute(const SweepOptions& options, const sweep::Store& store,
                     const sweep::Manifest& manifest, const std::vector<std::size_t>& pending,
                     const sweep::OnProgress& progress, std::ostream& err);

/// Writes tables, database and page, and says what was found. `computed` now, `before` earlier.
void write_results(const SweepOptions& options, const sweep::Store& store,
                   const sweep::RunLogs& logs, const sweep::Results& results,
                   std::uint64_t computed, std::uint64_t before, std::ostream& out);

/// What the command ends with, after a line if points failed.
int code_of_failures(const SweepOptions& options, const sweep::Results& results, std::ostream& err);

}  // namespace platform::cli

#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <vector>

#include <cli/options.h>
#include <sweep/engine.h>
#include <sweep/results.h>

/// What commands that compute points have in common.
namespace platform::cli {

/// What of a sweep was computed before.
struct Before {
  std::map<std::size_t, sweep::Outcome> outcomes;  ///< by position
  std::vector<std::size_t> pending;                ///< positions of the others
};

/// Of the points from `first` on. Throws vp::InputError for a result that somebody changed.
Before look_for_results(const sweep::Store& store, const sweep::Manifest& manifest,
                        std::size_t first, bool retry_failed, std::ostream& err);

/// Computes points with the engine that the user wants; the store has the manifest if it is not
/// the local one.
sweep::Tally compute(const SweepOptions& options, const sweep::Store& store,
                     const sweep::Manifest& manifest, const std::vector<std::size_t>& pending,
                     const sweep::OnProgress& progress, std::ostream& err);

/// Writes tables, database and page, and says what was found. `computed` now, `before` earlier.
void write_results(const SweepOptions& options, const sweep::Store& store,
                   const sweep::Results& results, std::uint64_t computed, std::uint64_t before,
                   std::ostream& out);

/// What the command ends with, after a line if points failed.
int code_of_failures(const SweepOptions& options, const sweep::Results& results, std::ostream& err);

}  // namespace platform::cli

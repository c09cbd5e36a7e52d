#pragma once

#include <string>
#include <vector>

#include <study/results.h>

namespace platform::study {

/// Points that differ in one parameter alone: two at least, in the order of the results.
using Comparison = std::vector<const ResultRow*>;

/// All comparisons that these rows make possible for the parameters at `paths`, which move
/// together: each has rows that are equal in all other swept values, and differ in these.
std::vector<Comparison> comparisons(const std::vector<const ResultRow*>& rows,
                                    const std::vector<std::string>& paths);

/// A swept parameter, or several that move together, that changes no result.
struct IdleParameter {
  std::string path;             ///< joined by '+'
  std::size_t comparisons = 0;  ///< that show it
};

/// The parameters that change nothing: in every comparison of points that ran, all results are
/// equal (Repetitions).
std::vector<IdleParameter> idle_parameters(const Results& results);

/// A sentence for each: "'ps.fclk_clk1.frequency' changes no result: …"; empty without such
/// parameters.
std::string idle_text(const std::vector<IdleParameter>& idle);

}  // namespace platform::study

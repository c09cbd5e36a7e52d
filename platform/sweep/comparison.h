#pragma once

#include <string>
#include <vector>

#include <sweep/results.h>

namespace platform::sweep {

/// Points that differ in one parameter alone: two at least, in the order of the results.
using Comparison = std::vector<const ResultRow*>;

/// All comparisons that these rows make possible for the parameters at `paths`, which move
/// together: each has rows that are equal in all other swept values, and differ in these.
std::vector<Comparison> comparisons(const std::vector<const ResultRow*>& rows,
                                    const std::vector<std::string>& paths);

}  // namespace platform::sweep

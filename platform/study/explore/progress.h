#pragma once

#include <study/results.h>

namespace platform::explore {

/// How a search went, for the page: {"points": [count…], "hypervolume": [of the front of that many
/// points…]} in the box of all of them (Front::hypervolume_of), at most 200 of each. Null where the
/// points are not those of a search (`markervp explore`), or none is feasible.
study::Json progress_json(const study::Results& results);

}  // namespace platform::explore

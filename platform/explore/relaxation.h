#pragma once

#include <functional>
#include <string>
#include <vector>

#include <explore/explore.h>

namespace platform::explore {

/// The least that one requirement must give way for a point to meet all others.
struct Relaxation {
  Requirement given_up;
  sweep::ResultRow row;  ///< the point that meets the others
  double shortfall = 0;  ///< of it
};

/// For each constraint and each part of the verdict but that a point runs and does its job: the
/// point, found by a search of its own and computed, that meets all others and needs the least of
/// it. Those for which there is none are left out. For an explorer that found no feasible point.
/// `go_on` is asked before each search.
std::vector<Relaxation> relaxations(Explorer& explorer, const std::function<bool()>& go_on);

/// In words, a sentence for each: "'summary.fps.mean >= 200' alone given up: 179.2 are possible …".
std::string text_of(const Explorer& explorer, const std::vector<Relaxation>& found);

}  // namespace platform::explore

#include <algorithm>
#include <numeric>
#include <string>

#include <study/plan.h>
#include <vp/error.h>

namespace platform::study {

std::uint64_t Refusals::points() const {
  return std::accumulate(reasons.begin(), reasons.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& reason) { return sum + reason.second; });
}

Refusals try_points(const Manifest& manifest, const Platform& platform, std::size_t most) {
  Refusals refusals;
  for (std::size_t i = 0; i < std::min(most, manifest.points.size()); ++i) {
    const Point& point = manifest.points[i];
    const Family& family = manifest.families[point.family];
    std::string problem = family.problem;
    try {
      // Without changes it is what its family was built as.
      if (problem.empty() && !point.changes.empty())
        platform.elaborate({family.program, manifest.settings(point)}, manifest.name);
    } catch (const vp::InputError& error) {
      problem = error.what();
    }
    ++(problem.empty() ? refusals.built : refusals.reasons[problem]);
  }
  return refusals;
}

}  // namespace platform::study

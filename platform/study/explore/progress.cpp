#include <study/explore/progress.h>

#include <study/explore/search.h>
#include <study/pareto.h>

#include <optional>
#include <vector>

namespace platform::explore {

namespace {

constexpr std::size_t most_steps = 200;

/// What each point cost; none for those that are not feasible.
std::vector<std::optional<Judgement>> judgements_of(const study::Results& results) {
  const std::vector<study::Objective> objectives = study::objectives_of(results);
  std::vector<std::optional<Judgement>> found(results.rows.size());
  for (const study::RankedPoint& point : study::rank(results, objectives).points) {
    if (point.front == 0) continue;
    Judgement judgement;
    for (std::size_t i = 0; i < objectives.size(); ++i)
      judgement.costs.push_back(objectives[i].maximise() ? -point.figures[i] : point.figures[i]);
    found[static_cast<std::size_t>(point.row - results.rows.data())] = std::move(judgement);
  }
  return found;
}

}  // namespace

study::Json progress_json(const study::Results& results) {
  if (results.manifest.sampling != "search") return nullptr;
  const std::vector<std::optional<Judgement>> judgements = judgements_of(results);
  Front whole, front;
  for (const auto& judgement : judgements) {
    if (judgement) whole.add(*judgement);
  }
  if (whole.size() == 0) return nullptr;
  study::Json points = study::Json::array(), hypervolume = study::Json::array();
  const std::size_t stride = (judgements.size() + most_steps - 1) / most_steps;
  for (std::size_t i = 0; i < judgements.size(); ++i) {
    if (judgements[i]) front.add(*judgements[i]);
    if ((i + 1) % stride != 0 && i + 1 != judgements.size()) continue;
    points.push_back(i + 1);
    hypervolume.push_back(whole.hypervolume_of(front.costs()));
  }
  return {{"points", points}, {"hypervolume", hypervolume}};
}

}  // namespace platform::explore

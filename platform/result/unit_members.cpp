// A unit of work in result.json: an element of `frames`.
#include <result/result_members.h>

namespace platform::result {

using facts::Better;
using facts::UnitReport;

namespace {

constexpr int figure_places = 9;

using Place = facts::UnitExtra::Place;

/// What the application says of the unit, at that place.
Members<UnitReport>::Write extra(Place place) {
  return [place](const UnitReport& unit, Json& json) {
    if (unit.extra) unit.extra->add_members(place, json);
  };
}

void find_times(const UnitReport& unit,
                const std::function<void(const std::string&, double)>& found) {
  for (const facts::StageTime& time : unit.times)
    found(time.name, static_cast<double>(time.ps) / facts::ps_per_us);
}

void find_energy(const UnitReport& unit,
                 const std::function<void(const std::string&, double)>& found) {
  if (unit.energy.empty()) return;
  double total = 0;
  for (const facts::GroupEnergy& part : unit.energy) total += part.mj;
  found("total", total);
  for (const facts::GroupEnergy& part : unit.energy) found(part.group, part.mj);
}

}  // namespace

const Members<UnitReport>& unit_members() {
  static const Members<UnitReport> members =
      Members<UnitReport>()
          .text("input", unless_empty(&UnitReport::input))
          .text("index", &UnitReport::index)
          .own(extra(Place::behind_index))
          .figure({"settling_showings", "1",
                   "how often the input was given before, for the logic to learn from it"},
                  [](const UnitReport& unit) {
                    return unit.settling_showings > 0 ? std::optional(unit.settling_showings)
                                                      : std::nullopt;
                  })
          .text("gave_up", unless_empty(&UnitReport::gave_up))
          .own(extra(Place::before_counts))
          .named(
              "counts",
              {{"*", "1", "what the design counts of a frame; some of it is lost work",
                Better::neither, "* a frame"}},
              [](const UnitReport& unit, const auto& found) {
                for (const auto& count : unit.counts.list()) found(count.name, count.value);
              },
              0, true)
          .named(
              "figures",
              {{"*", "1", "what the design finds of a frame, in the unit that it declares"}},
              [](const UnitReport& unit, const auto& found) {
                for (const auto& figure : unit.figures) found(figure.name, figure.value);
              },
              figure_places)
          .own(extra(Place::behind_counts))
          .named("time_us",
                 {{"frame", "µs", "from the start of a frame to its result", Better::less},
                  {"*", "µs", "time of a stage", Better::less, "Stage: *"}},
                 find_times, us_places, true)
          .named("energy_mj",
                 {{"total", "mJ", "energy of the chip for the frame", Better::less},
                  {"*", "mJ", "of it one group of modules", Better::less}},
                 find_energy, energy_places)
          .text("warnings", [](const UnitReport& unit) {
            return unit.warnings.empty() ? std::nullopt : std::optional(unit.warnings);
          });
  return members;
}

}  // namespace platform::result

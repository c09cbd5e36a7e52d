// The verdict in result.json: words, and margins.
#include <result/result_members.h>

namespace platform::result {

namespace {

Members<Verdict::Part> part_members() {
  using Part = Verdict::Part;
  return Members<Part>()
      .text("holds", [](const Part& part) { return to_string(part.holds); })
      .figure({"margin_percent", "%", "how far the part is from its limit; negative: beyond",
               facts::Better::more},
              &Part::margin_percent, percent_places)
      .text("by", unless_empty(&Part::by))
      .text("why", [](const Part& part) {
        return part.holds == Holds::yes ? std::nullopt : std::optional(part.why);
      });
}

}  // namespace

const Members<Verdict>& verdict_members() {
  static const Members<Verdict> members =
      Members<Verdict>()
          .text("feasible", [](const Verdict& verdict) { return to_string(verdict.feasible()); })
          .each(part_members(), [](const Verdict& verdict, const auto& found) {
            for (const Verdict::Part& part : verdict.parts) found(part.name, part);
          });
  return members;
}

}  // namespace platform::result

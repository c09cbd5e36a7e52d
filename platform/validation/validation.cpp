#include <algorithm>
#include <cmath>
#include <set>

#include <report/console.h>
#include <scene/catalogue.h>
#include <validation/evidence.h>
#include <validation/published.h>
#include <validation/validation.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::validation {

namespace {

double percent_of(double value, double reference) {
  return 100 * (value - reference) / reference;
}

/// The value nearest to `modelled` that rounds to what is printed.
double as_printed(const Published& published, double modelled) {
  const double half = 0.5 * std::pow(10, -published.decimals);
  return std::clamp(modelled, published.value - half, published.value + half);
}

bool within_band(const Row& row, double reference) {
  return std::abs(percent_of(row.modelled->value, reference)) <= band_percent;
}

/// Verdict on what has to be met.
void judge_value(Row& row, bool lower_bound) {
  const double modelled = row.modelled->value;
  if (within_band(row, row.published.value) || (lower_bound && modelled >= row.published.value)) {
    row.verdict = Verdict::met;
  } else if (within_band(row, as_printed(row.published, modelled))) {
    row.verdict = Verdict::met_rounded;
    row.reason = "printed with few digits: within the band of a value that rounds to it";
  } else {
    row.verdict = Verdict::missed;
    row.reason = "more than " + vp::format_fixed(band_percent, 0) + " % off";
  }
  const KnownMiss* known = find_known_miss(row.published.id);
  if (row.verdict != Verdict::missed || known == nullptr) return;
  if (row.difference_percent >= known->least_percent &&
      row.difference_percent <= known->most_percent) {
    row.verdict = Verdict::known_miss;
    row.reason = known->reason;
  } else {
    row.reason = "more than the known reason explains (" +
                 vp::format_fixed(known->least_percent, 1) + " to " +
                 vp::format_fixed(known->most_percent, 1) + " %)";
  }
}

Use use_of(const RowRule& rule, const std::set<std::string>& fitted_to) {
  if (rule.taken) return Use::taken;
  if (fitted_to.count(rule.id) != 0) return Use::calibration;
  const auto& parts = rule.follows_from;
  const auto fitted = [&](const std::string& id) { return fitted_to.count(id) != 0; };
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), fitted) ? Use::follows
                                                                           : Use::predicted;
}

Row judge_row(const Published& published, const Measured& measured,
              const std::set<std::string>& fitted_to) {
  const RowRule* rule = find_rule(published.id);
  if (rule == nullptr) {
    throw vp::InputError("published value '" + published.id + "': nothing says how to measure it");
  }
  Row row{
      published,       rule->kind, rule->how, rule->measure(measured), 0, use_of(*rule, fitted_to),
      Verdict::absent, ""};
  if (!row.modelled) {
    row.reason = "not modelled by this run";
    return row;
  }
  row.difference_percent = percent_of(row.modelled->value, published.value);
  if (row.kind == Kind::given) {
    row.verdict = Verdict::given;
  } else if (row.kind == Kind::accuracy) {
    row.verdict = Verdict::explained;
    row.reason = accuracy_reason(published.id);
  } else {
    judge_value(row, rule->lower_bound);
  }
  return row;
}

std::string system_text(const std::string& what, std::size_t found, std::size_t total) {
  return what + " " + std::to_string(found) + "/" + std::to_string(total);
}

/// Detection of one family of images by both systems.
Gate detection_gate(const std::string& name, const std::vector<std::string>& groups,
                    const Measured& measured) {
  std::size_t expected = 0;
  for (const SceneGroup& group : scene_groups()) {
    if (std::find(groups.begin(), groups.end(), group.name) != groups.end()) {
      expected += group.scenes.size();
    }
  }
  Gate gate{name, true, ""};
  for (const Run* run : {&measured.hybrid, &measured.ps_only}) {
    std::size_t found = 0;
    std::string first;
    for (const Frame* frame : run->of(groups)) {
      if (frame->found) {
        ++found;
      } else if (first.empty()) {
        first = ", first not in " + frame->input;
      }
    }
    if (found != expected) gate.passed = false;
    gate.text +=
        (gate.text.empty() ? "" : ", ") + system_text(run->system, found, expected) + first;
  }
  return gate;
}

Gate sameness_gate(const Measured& measured) {
  std::size_t same = 0;
  std::string first;
  const auto &one = measured.hybrid.frames, &other = measured.ps_only.frames;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].markers == other[i].markers) {
      ++same;
    } else if (first.empty()) {
      first = ", first differs " + one[i].input;
    }
  }
  return {"both systems find the same markers, corners and poses", same == one.size(),
          "in " + std::to_string(same) + " of " + report::counted(one.size(), "image") + first};
}

/// Rows of some kind and use: how many there are, how many of them met and why not the others.
Gate rows_gate(const std::string& name, const std::vector<Row>& rows,
               const std::vector<Kind>& kinds, const std::vector<Use>& uses) {
  std::size_t all = 0, met = 0, rounded = 0, known = 0;
  std::string missed;
  for (const Row& row : rows) {
    const bool counts = std::find(kinds.begin(), kinds.end(), row.kind) != kinds.end() &&
                        std::find(uses.begin(), uses.end(), row.use) != uses.end();
    if (!counts || row.verdict == Verdict::absent) continue;
    ++all;
    if (row.verdict == Verdict::met) ++met;
    if (row.verdict == Verdict::met_rounded) ++rounded;
    if (row.verdict == Verdict::known_miss) ++known;
    if (row.verdict == Verdict::missed) missed += (missed.empty() ? "" : ", ") + row.published.id;
  }
  std::string text = std::to_string(met + rounded) + " of " + std::to_string(all);
  if (rounded > 0)
    text += " (" + std::to_string(rounded) + " with the rounding of what is printed)";
  if (known > 0) text += ", " + std::to_string(known) + " missed for a known reason";
  if (!missed.empty()) text += ", missed: " + missed;
  return {name, missed.empty(), text};
}

}  // namespace

std::vector<Row> judge_rows(const std::vector<Published>& published, const Measured& measured,
                            const std::set<std::string>& fitted_to) {
  std::vector<Row> rows;
  for (const Published& value : published) rows.push_back(judge_row(value, measured, fitted_to));
  return rows;
}

std::vector<Gate> judge_gates(const std::vector<Row>& rows, const Measured& measured) {
  return {
      rows_gate("predicted times within 5 %", rows, {Kind::timing}, {Use::predicted}),
      rows_gate("times used for calibration within 5 %", rows, {Kind::timing},
                {Use::calibration, Use::follows}),
      rows_gate("marker widths of table 5.3 within 5 %", rows, {Kind::geometry}, {Use::predicted}),
      detection_gate("marker found, poses of 5.2.2 and 5.2.3",
                     {"x", "y", "z", "pitch", "yaw", "roll"}, measured),
      detection_gate("marker found, images of 5.2.4", {"squares"}, measured),
      detection_gate("right ID, the ten markers of 5.2.1", {"id"}, measured),
      detection_gate("right ID, all 250 markers from the front", {"front"}, measured),
      sameness_gate(measured),
  };
}

bool all_passed(const std::vector<Gate>& gates) {
  return std::all_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.passed; });
}

namespace {

double value_of(const std::vector<Published>& published, const std::string& id) {
  for (const Published& row : published) {
    if (row.id == id) return row.value;
  }
  return 0;
}

}  // namespace

Validation validate_runs(const Measured& measured, const profiles::CostProfile& profile,
                         const std::vector<Published>& published, std::uint32_t repetitions) {
  check_same_inputs(measured);
  Validation result;
  result.measured = {repeated(measured.hybrid, repetitions),
                     repeated(measured.ps_only, repetitions)};
  result.repetitions = repetitions;
  result.profile = measured.hybrid.profile;
  result.profile_origin = profile.origin;
  // With the tables of another optimisation the factors are no fit any more.
  const bool is_fit = profile.costs.profile() == result.profile;
  std::set<std::string> fitted_to;
  for (const profiles::FittedConstant& constant : profile.fitted) {
    result.fitted.push_back(constant);
    if (is_fit) fitted_to.insert(constant.published.begin(), constant.published.end());
  }
  result.rows = judge_rows(published, result.measured, fitted_to);
  result.gates = judge_gates(result.rows, result.measured);
  result.orders = study_orders(result.measured, value_of(published, "identification.hybrid"),
                               value_of(published, "speedup.features"), band_percent);
  result.turns = study_turns(result.measured, value_of(published, "speedup.rotation"));
  return result;
}

}  // namespace platform::validation

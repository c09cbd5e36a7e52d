#include <marker/validation/validation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <marker/scene/scene.h>
#include <marker/validation/measured.h>
#include <marker/validation/published.h>
#include <result/console.h>
#include <result/result_json.h>
#include <vp/error.h>
#include <vp/text.h>
#include <nlohmann/json.hpp>

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
          "in " + std::to_string(same) + " of " + result::counted(one.size(), "image") + first};
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
  rows.reserve(published.size());
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

namespace {

using result::Json;
using vp::format_fixed;

constexpr int value_places = 6;
constexpr int us_places = 6;
constexpr int percent_places = 3;
constexpr int schema = 1;

constexpr std::array<const char*, 11> stages{"upload",    "capture",        "corner_detection",
                                             "threshold", "blob_detection", "feature_extraction",
                                             "receive",   "evaluation",     "identification",
                                             "pose",      "frame"};

/// A value of a CSV file; quoted if it must be.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string line(const std::vector<std::string>& cells) {
  std::vector<std::string> escaped;
  escaped.reserve(cells.size());
  for (const std::string& text : cells) escaped.push_back(csv_cell(text));
  return vp::join(escaped, ",") + "\n";
}

Json row_json(const Row& row) {
  Json json;
  json["id"] = row.published.id;
  json["section"] = row.published.section;
  json["system"] = row.published.system;
  json["kind"] = kind_text(row.kind);
  json["unit"] = row.published.unit;
  json["published"] = row.published.value;
  if (row.published.spread) json["published_spread"] = *row.published.spread;
  if (row.modelled) {
    json["modelled"] = result::rounded(row.modelled->value, value_places);
    if (row.modelled->spread) {
      json["modelled_spread"] = result::rounded(*row.modelled->spread, value_places);
    }
    json["difference_percent"] = result::rounded(row.difference_percent, percent_places);
  }
  if (!use_text(row).empty()) json["use"] = use_text(row);
  json["how"] = row.how;
  json["verdict"] = verdict_text(row.verdict);
  if (!row.reason.empty()) json["reason"] = row.reason;
  return json;
}

std::vector<std::string> frame_cells(const std::string& system, const Frame& frame) {
  std::vector<std::string> cells{system,
                                 frame.group,
                                 frame.input,
                                 std::to_string(frame.threshold),
                                 std::to_string(frame.corners),
                                 std::to_string(frame.blobs),
                                 std::to_string(frame.candidates)};
  for (const char* stage : stages) {
    const auto time = frame.times_us.find(stage);
    cells.push_back(time == frame.times_us.end() ? "" : format_fixed(time->second, us_places));
  }
  const bool posed = frame.found && frame.found->translation_mm;
  cells.push_back(frame.found ? format_fixed(frame.found->corner_px, value_places) : "");
  cells.push_back(posed ? format_fixed(*frame.found->translation_mm, value_places) : "");
  cells.push_back(posed ? format_fixed(*frame.found->rotation_deg, value_places) : "");
  cells.push_back(posed ? std::to_string(frame.found->iterations) : "");
  return cells;
}

}  // namespace

std::string json_text(const Validation& v) {
  Json json;
  json["schema"] = schema;
  json["profile"] = v.profile;
  json["fidelity"] = v.measured.hybrid.fidelity;
  json["design"] = v.measured.hybrid.design;
  json["images"] = v.measured.hybrid.frames.size();
  json["repetitions"] = v.repetitions;
  json["band_percent"] = band_percent;
  json["fitted"] = Json::array();
  for (const profiles::FittedConstant& constant : v.fitted) {
    json["fitted"].push_back(
        {{"name", constant.name}, {"value", constant.value}, {"published", constant.published}});
  }
  json["rows"] = Json::array();
  for (const Row& row : v.rows) json["rows"].push_back(row_json(row));
  json["gates"] = Json::array();
  for (const Gate& gate : v.gates) {
    json["gates"].push_back({{"name", gate.name}, {"passed", gate.passed}, {"text", gate.text}});
  }
  json["passed"] = v.passed();
  return json.dump(2) + "\n";
}

std::string rows_csv(const Validation& v) {
  std::string text =
      line({"id", "section", "system", "kind", "unit", "published", "published_spread", "modelled",
            "modelled_spread", "difference_percent", "use", "verdict", "reason"});
  for (const Row& row : v.rows) {
    const Published& p = row.published;
    const auto number = [](const std::optional<double>& value, int places) {
      return value ? format_fixed(*value, places) : std::string();
    };
    const bool known = row.modelled.has_value();
    text += line({p.id, p.section, p.system, kind_text(row.kind), p.unit,
                  format_fixed(p.value, p.decimals), number(p.spread, value_places),
                  known ? format_fixed(row.modelled->value, value_places) : "",
                  known ? number(row.modelled->spread, value_places) : "",
                  known ? format_fixed(row.difference_percent, percent_places) : "", use_text(row),
                  verdict_text(row.verdict), row.reason});
  }
  return text;
}

std::string frames_csv(const Validation& v) {
  std::vector<std::string> head{"system",  "test",  "image",     "threshold",
                                "corners", "blobs", "candidates"};
  for (const char* stage : stages) head.push_back(std::string(stage) + "_us");
  for (const char* error : {"corner_px", "translation_mm", "rotation_deg", "iterations"}) {
    head.emplace_back(error);
  }
  std::string text = line(head);
  for (const Run* run : {&v.measured.hybrid, &v.measured.ps_only}) {
    for (const Frame& frame : run->frames) text += line(frame_cells(run->system, frame));
  }
  return text;
}

}  // namespace platform::validation

#include <validation/result_files.h>

#include <array>

#include <report/result_json.h>
#include <validation/words.h>
#include <vp/text.h>
#include <nlohmann/json.hpp>

namespace platform::validation {

namespace {

using report::Json;
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
    json["modelled"] = report::rounded(row.modelled->value, value_places);
    if (row.modelled->spread) {
      json["modelled_spread"] = report::rounded(*row.modelled->spread, value_places);
    }
    json["difference_percent"] = report::rounded(row.difference_percent, percent_places);
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

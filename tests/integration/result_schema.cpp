#include "result_schema.h"

#include <algorithm>

#include "design_schema.h"

namespace integration {

namespace {

using Json = nlohmann::ordered_json;

enum class Kind { text, number, count, object, array };

struct Key {
  const char* name;
  Kind kind;
};

bool is_of(Kind kind, const Json& value) {
  switch (kind) {
    case Kind::text:
      return value.is_string();
    case Kind::number:
      return value.is_number();
    case Kind::count:
      return value.is_number_unsigned();
    case Kind::object:
      return value.is_object();
    case Kind::array:
      return value.is_array();
  }
  return false;
}

class Checker {
 public:
  std::vector<std::string> take() { return std::move(problems_); }

  void result(const Json& json) {
    if (!keys(json, "result",
              {{"schema", Kind::count},
               {"provenance", Kind::object},
               {"fidelity", Kind::text},
               {"system", Kind::text},
               {"design", Kind::text},
               {"profile", Kind::text},
               {"configuration", Kind::object},
               {"frames", Kind::array},
               {"stages", Kind::array},
               {"summary", Kind::object},
               {"limit", Kind::object}})) {
      return;
    }
    expect(json["schema"] == 1, "schema is not 1");
    one_of(json["fidelity"], "fidelity", {"tlm", "clocked"});
    one_of(json["system"], "system", {"hybrid", "ps-only"});
    provenance(json["provenance"]);
    program_end(json);
    injected(json);
    for (const auto& [path, value] : json["configuration"].items()) {
      expect(value.is_string() && !value.empty(), "configuration." + path + " is no text");
    }
    for (std::size_t i = 0; i < json["frames"].size(); ++i) {
      frame(json["frames"][i], "frames[" + std::to_string(i) + "]");
    }
    stages(json["stages"], json["frames"]);
    summary(json["summary"], json["frames"].size());
    limit(json["limit"], json["stages"]);
  }

 private:
  void expect(bool good, const std::string& problem) {
    if (!good) problems_.push_back(problem);
  }

  /// True if all of them are there and of their kind.
  bool keys(const Json& json, const std::string& where, const std::vector<Key>& expected) {
    const std::size_t before = problems_.size();
    expect(json.is_object(), where + " is no object");
    if (!json.is_object()) return false;
    for (const Key& key : expected) {
      const auto found = json.find(key.name);
      if (found == json.end()) {
        problems_.push_back(where + "." + key.name + " is missing");
      } else {
        expect(is_of(key.kind, *found), where + "." + key.name + " is of another type");
      }
    }
    return problems_.size() == before;
  }

  void one_of(const Json& value, const std::string& where,
              const std::vector<std::string>& allowed) {
    for (const std::string& text : allowed) {
      if (value == text) return;
    }
    problems_.push_back(where + " has an unknown value");
  }

  void numbers(const Json& json, const std::string& where, std::size_t count) {
    bool good = json.is_array() && json.size() == count;
    for (const Json& value : json) good = good && value.is_number();
    expect(good, where + " is not " + std::to_string(count) + " numbers");
  }

  /// `rows` arrays of `columns` numbers.
  void table(const Json& json, const std::string& where, std::size_t rows, std::size_t columns) {
    expect(json.is_array() && json.size() == rows,
           where + " has not " + std::to_string(rows) + " rows");
    if (!json.is_array()) return;
    for (const Json& row : json) numbers(row, where, columns);
  }

  void provenance(const Json& json) {
    keys(json, "provenance",
         {{"program", Kind::text},
          {"version", Kind::text},
          {"configuration_hash", Kind::text},
          {"command_line", Kind::array},
          {"host", Kind::text},
          {"date", Kind::text},
          {"wall_time_s", Kind::number}});
  }

  /// A program that was stopped has none.
  void program_end(const Json& json) {
    if (!json.contains("program_end") && json.contains("incomplete")) return;
    if (!keys(json, "result", {{"program_end", Kind::object}})) return;
    const Json& end = json["program_end"];
    if (!keys(end, "program_end", {{"exit_code", Kind::number}, {"time_us", Kind::number}})) return;
    if (end.contains("reached_limit"))
      expect(end["reached_limit"] == true, "program_end.reached_limit is not true");
    if (end.contains("main_us"))
      expect(end["main_us"] <= end["time_us"], "program_end.main_us is after the end");
  }

  /// Only where faults were asked for.
  void injected(const Json& json) {
    if (!json.contains("injected")) return;
    for (const Json& fault : json["injected"]) {
      if (!keys(fault, "injected", {{"fault", Kind::text}, {"times", Kind::count}})) return;
      expect(fault.contains("first_us") == (fault["times"] > 0),
             "injected.first_us belongs to what happened");
    }
  }

  void frame(const Json& json, const std::string& where) {
    if (!keys(json, where,
              {{"input", Kind::text},
               {"index", Kind::count},
               {"taken_us", Kind::number},
               {"threshold", Kind::count},
               {"counts", Kind::object},
               {"markers", Kind::array},
               {"time_us", Kind::object}})) {
      return;
    }
    keys(json["counts"], where + ".counts",
         {{"corners", Kind::count},
          {"blobs", Kind::count},
          {"feature_words", Kind::count},
          {"candidates", Kind::count},
          {"feature_overflow", Kind::count},
          {"label_overflow", Kind::count},
          {"bridge_overflow", Kind::count},
          {"crossing_overflow", Kind::count},
          {"software_overflow", Kind::count},
          {"malformed", Kind::count}});
    keys(json["time_us"], where + ".time_us",
         {{"upload", Kind::number},
          {"feature_extraction", Kind::number},
          {"receive", Kind::number},
          {"evaluation", Kind::number},
          {"identification", Kind::number},
          {"pose", Kind::number},
          {"frame", Kind::number}});
    bool of_scene = false;
    for (const Json& found : json["markers"]) {
      marker(found, where + ".markers");
      of_scene = of_scene || found.contains("truth");
    }
    if (of_scene || json.contains("scene_marker"))
      keys(json, where, {{"scene_marker", Kind::count}});
  }

  /// Which of the stages set the frame rate, and how much of the run each did.
  void limit(const Json& json, const Json& stages) {
    if (!keys(json, "limit",
              {{"kind", Kind::text},
               {"stages", Kind::array},
               {"stages_us", Kind::number},
               {"period_us", Kind::number},
               {"percent", Kind::object},
               {"levers", Kind::array},
               {"text", Kind::text},
               {"faster_with", Kind::text}}))
      return;
    one_of(json["kind"], "limit.kind", {"sequence", "ahead", "behind", "camera"});
    const Json& percent = json["percent"];
    for (const auto& share : percent.items())
      expect(share.value().is_number() && share.value() >= 0, "limit.percent is no share");
    for (const Json& stage : json["stages"])
      expect(stage.is_string() && percent.contains(stage), "limit.stages names no stage");
    for (const Json& lever : json["levers"])
      expect(lever.is_string() && lever.get<std::string>().find('=') != std::string::npos,
             "limit.levers is no setting");
    expect(percent.contains("camera"), "limit.percent.camera is missing");
    for (const Json& stage : stages) {
      if (!stage.is_object() || !stage.value("name", Json()).is_string()) continue;
      const std::string name = stage["name"];
      if (name == "feature_extraction" && json["stages"] == Json{name})
        keys(json, "limit", {{"clock", Kind::text}, {"why", Kind::text}});
      if (stage.value("part_of", Json()) == "frame" && name != "feature_extraction")
        expect(percent.contains(name), "limit.percent lacks a stage");
    }
    expect(double(json["stages_us"]) <= double(json["period_us"]) * 1.001,
           "limit.stages_us is longer than the period");
  }

  /// The times of the frames, in their order; all but frame and upload are parts of another.
  void stages(const Json& json, const Json& frames) {
    std::vector<std::string> names;
    for (const Json& stage : json) {
      if (keys(stage, "stages", {{"name", Kind::text}})) names.push_back(stage["name"]);
    }
    for (const Json& stage : json) {
      if (!stage.is_object() || stage.value("name", Json()) == "frame" ||
          stage.value("name", Json()) == "upload")
        continue;
      if (keys(stage, "stages", {{"part_of", Kind::text}})) {
        expect(std::find(names.begin(), names.end(), stage["part_of"]) != names.end(),
               "stages.part_of names no stage");
      }
    }
    // The stage that waits for the logic follows its clock; the software's takes what it needs.
    for (const Json& stage : json) {
      const Json name = stage.is_object() ? stage.value("name", Json()) : Json();
      if (name == "feature_extraction") keys(stage, "stages", {{"clock", Kind::text}});
      if (name == "feature_extraction" || name == "identification") {
        keys(stage, "stages", {{"why", Kind::text}});
      }
    }
    for (const Json& frame : frames) {
      if (!frame.is_object()) continue;
      const Json time_us = frame.value("time_us", Json());
      std::vector<std::string> times;
      for (const auto& time : time_us.items()) times.push_back(time.key());
      expect(times == names, "stages are not the times of the frames");
    }
  }

  void marker(const Json& json, const std::string& where) {
    if (!keys(json, where,
              {{"id", Kind::count},
               {"rotation", Kind::count},
               {"side_m", Kind::number},
               {"corners_px", Kind::array},
               {"pose", Kind::object},
               {"reprojection_px", Kind::number},
               {"iterations", Kind::count}})) {
      return;
    }
    expect(json["id"] < 250, where + ".id is not in the dictionary");
    expect(json["rotation"] < 4, where + ".rotation is not 0 to 3");
    table(json["corners_px"], where + ".corners_px", 4, 2);
    pose(json["pose"], where + ".pose");
    expect(json.contains("truth") == json.contains("error"),
           where + " has only one of truth and error");
    if (json.contains("truth") && json.contains("error")) truth(json, where);
  }

  void truth(const Json& marker, const std::string& where) {
    if (keys(marker["truth"], where + ".truth",
             {{"corners_px", Kind::array}, {"pose", Kind::object}})) {
      table(marker["truth"]["corners_px"], where + ".truth.corners_px", 4, 2);
      pose(marker["truth"]["pose"], where + ".truth.pose");
    }
    keys(marker["error"], where + ".error",
         {{"corner_px", Kind::number},
          {"translation_mm", Kind::number},
          {"rotation_deg", Kind::number}});
  }

  void pose(const Json& json, const std::string& where) {
    if (!keys(json, where, {{"rotation", Kind::array}, {"translation_m", Kind::array}})) return;
    table(json["rotation"], where + ".rotation", 3, 3);
    numbers(json["translation_m"], where + ".translation_m", 3);
  }

  void summary(const Json& json, std::size_t frames) {
    if (!keys(json, "summary",
              {{"frames", Kind::count},
               {"delivered", Kind::count},
               {"detected", Kind::count},
               {"fps", Kind::object},
               {"latency_us", Kind::object}})) {
      return;
    }
    expect(json["frames"] == frames, "summary.frames is not the number of frames");
    expect(json["detected"] <= json["frames"], "summary.detected exceeds summary.frames");
    keys(json["fps"], "summary.fps",
         {{"mean", Kind::number}, {"min", Kind::number}, {"max", Kind::number}});
    keys(json["latency_us"], "summary.latency_us", {{"mean", Kind::number}, {"max", Kind::number}});
  }

  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> schema_problems(const Json& result) {
  Checker checker;
  checker.result(result);
  std::vector<std::string> problems = checker.take();
  for (std::string& problem : design_problems(result)) problems.push_back(std::move(problem));
  return problems;
}

}  // namespace integration

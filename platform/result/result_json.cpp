#include <result/result_json.h>

#include <facts/summary.h>
#include <fcntl.h>
#include <vp/text.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <filesystem>

namespace platform::result {

namespace {

/// What a unit is called where result.json does not say it.
constexpr const char* usual_unit = "frame";

}  // namespace

void add_run(Json& json, const facts::RunFacts& facts) {
  json["fidelity"] = facts.fidelity;
  json["system"] = facts.system;
  json["design"] = facts.design;
  json["profile"] = facts.profile;
  if (facts.work.unit == usual_unit) return;
  if (!facts.work.unit.empty()) json["unit"] = facts.work.unit;
  json["job"] = facts.work.job;
}

namespace {

Json injected_json(const std::vector<facts::Injected>& faults) {
  constexpr double ps_per_us = 1e6;
  Json list = Json::array();
  for (const facts::Injected& injected : faults) {
    Json json = {{"fault", injected.fault}, {"times", injected.times}};
    if (injected.times > 0)
      json["first_us"] = rounded(static_cast<double>(injected.first_ps) / ps_per_us, 6);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

void add_end(Json& json, const facts::RunFacts& facts, const std::vector<std::string>& warnings) {
  if (!warnings.empty()) json["warnings"] = warnings;
  if (!facts.notes.empty()) json["notes"] = facts.notes;
  if (!facts.injected.empty()) json["injected"] = injected_json(facts.injected);
  if (facts.incomplete) json["incomplete"] = *facts.incomplete;
  if (facts.end) json["program_end"] = to_json(*facts.end);
}

void add_figures(Json& json, const facts::RunFacts& facts, const facts::Summary& summary) {
  if (!summary.stages().empty()) json["stages"] = stages_json(summary);
  json["summary"] = to_json(summary, facts.work);
  if (const std::optional<facts::Limit> limit = summary.limit())
    json["limit"] = to_json(*limit, facts.work);
  if (facts.power) {
    json["summary"]["power_w"] = power_summary_json(*facts.power);
    if (facts.power->per_frame) {
      json["summary"]["energy_per_frame_mj"] =
          rounded(facts.power->energy_per_frame_mj, energy_places);
    }
  }
  if (facts.unpublished > 0) json["summary"]["unpublished"] = facts.unpublished;
  if (facts.camera) json["camera"] = camera_json(*facts.camera, summary);
  json["verdict"] = to_json(verdict_of(facts, summary));
  if (facts.power) json["power"] = to_json(*facts.power);
  if (facts.resources) json["resources"] = to_json(*facts.resources);
  if (facts.timing) json["timing"] = to_json(*facts.timing);
  if (facts.clocks) json["clocks"] = to_json(*facts.clocks);
}

namespace {

constexpr int figure_places = 9;
constexpr int us_places = 6;
constexpr int fps_places = 6;
constexpr int second_places = 3;
constexpr int percent_places = 3;

Json counts_json(const facts::Counts& counts) {
  Json json = Json::object();
  for (const facts::Counts::Count& count : counts.list()) json[count.name] = count.value;
  return json;
}

}  // namespace

double rounded(double value, int places) {
  const std::string text = vp::format_fixed(value, places);
  double result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

namespace {

using Place = facts::UnitExtra::Place;

void add_extra(const facts::UnitReport& unit, Place place, Json& json) {
  if (unit.extra) unit.extra->add_members(place, json);
}

}  // namespace

Json to_json(const facts::UnitReport& unit) {
  Json json;
  if (!unit.input.empty()) json["input"] = unit.input;
  json["index"] = unit.index;
  add_extra(unit, Place::behind_index, json);
  if (unit.settling_showings > 0) json["settling_showings"] = unit.settling_showings;
  if (!unit.delivered()) json["gave_up"] = unit.gave_up;
  add_extra(unit, Place::before_counts, json);
  json["counts"] = counts_json(unit.counts);
  for (const facts::UnitFigure& figure : unit.figures)
    json["figures"][figure.name] = rounded(figure.value, figure_places);
  add_extra(unit, Place::behind_counts, json);
  json["time_us"] = Json::object();
  for (const facts::StageTime& time : unit.times) {
    json["time_us"][time.name] =
        rounded(static_cast<double>(time.ps) / facts::ps_per_us, us_places);
  }
  if (!unit.energy.empty()) json["energy_mj"] = energy_json(unit.energy);
  if (!unit.warnings.empty()) json["warnings"] = unit.warnings;
  return json;
}

Json to_json(const facts::Summary& summary, const facts::Work& work) {
  Json json;
  json["frames"] = summary.frames();
  json["delivered"] = summary.delivered();
  for (const facts::Tally& tally : work.tallies) {
    if (tally.is_figure) json[tally.name] = summary.tally(tally.name);
  }
  if (summary.fps().count() > 0) {
    json["fps"]["mean"] = rounded(summary.mean_fps(), fps_places);
    json["fps"]["min"] = rounded(summary.fps().min(), fps_places);
    json["fps"]["max"] = rounded(summary.fps().max(), fps_places);
    json["latency_us"]["mean"] = rounded(summary.latency_us().mean(), us_places);
    json["latency_us"]["max"] = rounded(summary.latency_us().max(), us_places);
  }
  return json;
}

Json camera_json(const facts::CameraReport& camera, const facts::Summary& summary) {
  const auto slack_us = [&](double busy_ps) {
    return rounded((camera.period_ps() - busy_ps) / facts::ps_per_us, us_places);
  };
  Json json;
  json["rate_fps"] = rounded(camera.rate_fps, fps_places);
  json["offered"] = camera.offered;
  json["dropped"] = camera.dropped;
  json["delivered_fps"] = rounded(summary.mean_fps(), fps_places);
  json["utilisation_percent"] = rounded(camera.utilisation_percent(), percent_places);
  json["slack_us"]["mean"] = slack_us(camera.busy_ps);
  json["slack_us"]["min"] = slack_us(camera.most_busy_ps);
  return json;
}

Json stages_json(const facts::Summary& summary) {
  Json json = Json::array();
  for (const facts::Summary::Stage& stage : summary.stages()) {
    Json entry;
    entry["name"] = stage.name;
    if (!stage.part_of.empty()) entry["part_of"] = stage.part_of;
    if (!stage.clock.empty()) entry["clock"] = stage.clock;
    if (!stage.why.empty()) entry["why"] = stage.why;
    json.push_back(entry);
  }
  return json;
}

Json to_json(const facts::Limit& limit, const facts::Work& work) {
  Json json;
  json["kind"] = to_string(limit.kind);
  json["stages"] = limit.stages;
  json["stages_us"] = rounded(limit.stages_us, us_places);
  json["period_us"] = rounded(limit.period_us, us_places);
  for (const auto& [name, share] : limit.percent)
    json["percent"][name] = rounded(share, percent_places);
  if (!limit.clock.empty()) json["clock"] = limit.clock;
  if (!limit.why.empty()) json["why"] = limit.why;
  json["levers"] = limit.levers;
  json["text"] = limit.text(work);
  json["faster_with"] = limit.levers_text();
  return json;
}

Json to_json(const facts::ProgramEnd& end) {
  Json json;
  json["exit_code"] = end.exit_code;
  json["time_us"] = rounded(static_cast<double>(end.ps) / facts::ps_per_us, us_places);
  if (end.reached_limit) json["reached_limit"] = true;
  return json;
}

Json to_json(const facts::Provenance& provenance) {
  Json json;
  json["program"] = provenance.program;
  json["version"] = provenance.version;
  if (!provenance.revision.empty()) json["revision"] = provenance.revision;
  json["configuration_hash"] = provenance.configuration_hash;
  json["command_line"] = provenance.command_line;
  json["host"] = provenance.host;
  json["date"] = provenance.date;
  json["wall_time_s"] = rounded(provenance.wall_time_s, second_places);
  for (const auto& [name, value] : provenance.details) json[name] = value;
  return json;
}

namespace {

constexpr int celsius_places = 6;
constexpr int block_places = 1;

double watts(double value) {
  return rounded(value, energy_places);
}

Json amount_json(const facts::ResourceReport::Amount& amount) {
  Json json;
  json["lut"] = static_cast<std::uint64_t>(amount.lut);
  json["ff"] = static_cast<std::uint64_t>(amount.ff);
  json["bram36"] = rounded(amount.bram36, block_places);
  json["dsp"] = static_cast<std::uint64_t>(amount.dsp);
  return json;
}

}  // namespace

Json energy_json(const std::vector<facts::GroupEnergy>& energy) {
  Json json;
  double total = 0;
  for (const facts::GroupEnergy& part : energy) total += part.mj;
  json["total"] = rounded(total, energy_places);
  for (const facts::GroupEnergy& part : energy) json[part.group] = rounded(part.mj, energy_places);
  return json;
}

Json power_summary_json(const facts::PowerReport& power) {
  Json json;
  json["total"] = watts(power.total_w);
  json["ps"] = watts(power.ps_w);
  json["pl"] = watts(power.pl_w);
  json["static"] = watts(power.static_w);
  return json;
}

Json to_json(const facts::PowerReport& power) {
  Json json;
  json["mode"] = power.mode;
  json["table"] = power.table;
  json["ambient_c"] = rounded(power.ambient_c, celsius_places);
  json["junction_c"] = rounded(power.junction_c, celsius_places);
  json["total_w"]["low"] = watts(power.low_w);
  json["total_w"]["nominal"] = watts(power.total_w);
  json["total_w"]["high"] = watts(power.high_w);
  for (const auto& [rail, value] : power.rails) json["rails"][rail] = watts(value);
  json["modules"] = Json::array();
  for (const facts::PowerReport::Module& module : power.modules) {
    Json entry;
    entry["name"] = module.name;
    entry["rail"] = module.rail;
    entry["kind"] = module.kind;
    entry["w"] = watts(module.w);
    if (power.per_frame) entry["mj"] = rounded(module.mj, energy_places);
    entry["source"] = module.source;
    json["modules"].push_back(entry);
  }
  return json;
}

Json to_json(const facts::ResourceReport& resources) {
  Json json;
  json["device"] = resources.device;
  json["modules"] = Json::array();
  for (const facts::ResourceReport::Module& module : resources.modules) {
    Json entry;
    entry["name"] = module.name;
    if (module.known) {
      entry.update(amount_json(module.amount));
      entry["uncertainty_percent"] = module.uncertainty_percent;
    }
    entry["source"] = module.source;
    json["modules"].push_back(entry);
  }
  const bool known = resources.unknown.empty();
  if (known) json["total"] = amount_json(resources.total);
  json["available"] = amount_json(resources.available);
  if (known || !resources.over.empty()) json["fits"] = resources.over.empty();
  json["over"] = resources.over;
  if (!known) json["unknown"] = resources.unknown;
  return json;
}

Json to_json(const Verdict& verdict) {
  Json json;
  json["feasible"] = to_string(verdict.feasible());
  for (const Verdict::Part& part : verdict.parts) {
    Json& entry = json[part.name];
    entry["holds"] = to_string(part.holds);
    if (part.margin_percent)
      entry["margin_percent"] = rounded(*part.margin_percent, percent_places);
    if (!part.by.empty()) entry["by"] = part.by;
    if (part.holds != Holds::yes) entry["why"] = part.why;
  }
  return json;
}

void ResultDocument::add(const facts::UnitReport& frame) {
  frames_.push_back(to_json(frame));
  summary_.add(frame);
}

void ResultDocument::finish(const facts::RunFacts& facts, const facts::Provenance&,
                            const std::vector<std::string>& warnings) {
  json_ = Json::object();
  json_["schema"] = result_schema;
  add_run(json_, facts);
  add_end(json_, facts, warnings);
  json_["frames"] = std::move(frames_);
  add_figures(json_, facts, summary_);
}

namespace {

constexpr int indent = 2;
constexpr const char* name = "result.json";
constexpr const char* temporary = "a temporary file";
/// Bytes of a result without its frames, with some to spare.
constexpr std::uint64_t around_frames = 1 << 16;

/// File names may hold any bytes; JSON holds UTF-8 only.
std::string dump(const Json& json, int spaces = -1) {
  return json.dump(spaces, ' ', false, Json::error_handler_t::replace);
}

/// The members of `json` as lines of an object that continues after them.
std::string opened(const Json& json) {
  std::string text = dump(json, indent);
  text.erase(text.size() - 2);  // the last line feed and brace
  return text + ",\n";
}

/// A file without a name, where the results go: a system's folder for temporary files may be small
/// or slow. Not every file system has such files.
std::FILE* nameless_file(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  return descriptor < 0 ? std::tmpfile() : ::fdopen(descriptor, "w+");
}

}  // namespace

ResultWriter::ResultWriter(host::OutputFolder& folder)
    : folder_(folder),
      file_((std::filesystem::path(folder.path()) / name).string()),
      frames_(nameless_file(folder.path())) {
  if (!frames_) throw vp::OutputError(temporary, errno);
  file_.reserve(around_frames);
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::add(const facts::UnitReport& frame) {
  const std::string text = (summary_.frames() == 0 ? "\n    " : ",\n    ") + dump(to_json(frame));
  file_.reserve(around_frames + bytes_ + text.size());
  if (std::fwrite(text.data(), 1, text.size(), frames_.get()) != text.size() ||
      std::fflush(frames_.get()) != 0) {
    throw vp::OutputError(temporary, errno);
  }
  bytes_ += text.size();
  summary_.add(frame);
}

void ResultWriter::finish(const facts::RunFacts& facts, const facts::Provenance& provenance,
                          const std::vector<std::string>& warnings) {
  Json head;
  head["schema"] = result_schema;
  head["provenance"] = to_json(provenance);
  add_run(head, facts);
  head["configuration"] = Json::object();
  for (const auto& [path, value] : facts.configuration) head["configuration"][path] = value;
  add_end(head, facts, warnings);

  folder_.add(name);
  file_.write(opened(head) + "  \"frames\": [");
  std::rewind(frames_.get());
  std::array<char, 1 << 16> block;
  for (std::uint64_t left = bytes_; left > 0;) {
    const std::size_t size =
        std::fread(block.data(), 1, std::min<std::uint64_t>(left, block.size()), frames_.get());
    if (size == 0) throw vp::OutputError(temporary, errno);
    file_.write({block.data(), size});
    left -= size;
  }
  Json tail;
  add_figures(tail, facts, summary_);
  file_.write(summary_.frames() == 0 ? "],\n" : "\n  ],\n");
  file_.write(dump(tail, indent).substr(2) + "\n");
  file_.commit();
}

}  // namespace platform::result

#include <result/figures.h>
#include <result/result_json.h>
#include <result/result_members.h>

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
/// Of result.json.
constexpr int result_schema = 1;
constexpr int second_places = 3;

/// Adds what ran.
void add_run(Json& json, const facts::RunFacts& facts) {
  json["fidelity"] = facts.fidelity;
  json["system"] = facts.system;
  json["design"] = facts.design;
  json["profile"] = facts.profile;
  if (facts.work.unit != usual_unit) {
    if (!facts.work.unit.empty()) json["unit"] = facts.work.unit;
    json["job"] = facts.work.job;
  }
  if (const Json own = own_figures_json(facts.work); !own.empty()) json["figures"] = own;
}

/// Adds how it went.
void add_end(Json& json, const facts::RunFacts& facts, const std::vector<std::string>& warnings) {
  if (!warnings.empty()) json["warnings"] = warnings;
  end_members().write(facts, json);
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

}  // namespace

double rounded(double value, int places) {
  const std::string text = vp::format_fixed(value, places);
  double result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

Json to_json(const facts::UnitReport& unit) {
  return unit_members().json(unit);
}

void ResultDocument::add(const facts::UnitReport& frame) {
  frames_.push_back(unit_members().json(frame));
  summary_.add(frame);
}

void ResultDocument::finish(const facts::RunFacts& facts, const facts::Provenance&,
                            const std::vector<std::string>& warnings) {
  json_ = Json::object();
  json_["schema"] = result_schema;
  add_run(json_, facts);
  add_end(json_, facts, warnings);
  json_["frames"] = std::move(frames_);
  figure_members().write({facts, summary_}, json_);
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
  const std::string text =
      (summary_.frames() == 0 ? "\n    " : ",\n    ") + dump(unit_members().json(frame));
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
  const Json tail = figure_members().json({facts, summary_});
  file_.write(summary_.frames() == 0 ? "],\n" : "\n  ],\n");
  file_.write(dump(tail, indent).substr(2) + "\n");
  file_.commit();
}

}  // namespace platform::result

#include <study/contents.h>

#include <host/digest.h>
#include <host/document.h>
#include <host/process.h>
#include <vp/text.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

/// Parts of an installation that are no data tables.
bool is_table(const fs::path& relative) {
  const std::string first = relative.begin()->string();
  return first != "programs" && first != "studies" && relative.has_parent_path() &&
         relative.extension() != ".so";
}

/// The tables that a scaled cost profile refers to stand beside it.
void add_named_tables(const fs::path& file, Json& contents) {
  if (file.extension() != ".json") return;
  const Json root = host::read_json<Json>(file, "profile");
  if (!root.is_object() || !root.contains("tables") || !root["tables"].is_object()) return;
  for (const auto& [unused, name] : root["tables"].items()) {
    if (!name.is_string()) continue;
    const fs::path table = file.parent_path() / (name.get<std::string>() + ".json");
    std::error_code ignored;
    if (fs::is_regular_file(table, ignored))
      contents[table.filename().string()] = host::file_hash(table.string());
  }
}

}  // namespace

Json program_identity(const std::string& version, const std::string& revision) {
  Json json;
  json["version"] = version;
  json["revision"] = revision;
  if (revision.empty() || vp::ends_with(revision, "-dirty"))
    json["executable"] = host::file_hash("/proc/self/exe");
  return json;
}

Json table_contents() {
  Json json = Json::object();
  std::error_code ignored;
  for (const std::string& folder : host::library_folders()) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
      const fs::path relative = entry.path().lexically_relative(folder);
      if (entry.is_regular_file(ignored) && is_table(relative)) files.push_back(relative);
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      json[file.generic_string()] = host::file_hash((fs::path(folder) / file).string());
    if (!files.empty()) break;
  }
  return json;
}

Json file_contents(const std::string& program_file,
                   const std::map<std::string, std::string>& configuration) {
  Json json;
  json["program"] = fs::path(program_file).stem().string();
  json["program_file"] = program_file.empty() ? "" : host::file_hash(program_file);
  json["files"] = Json::object();
  for (const auto& [path, value] : configuration) {
    std::error_code ignored;
    if (fs::path(value).extension().empty() || !fs::is_regular_file(value, ignored)) continue;
    json["files"][path] = host::file_hash(value);
    add_named_tables(value, json["files"]);
  }
  return json;
}

}  // namespace platform::study

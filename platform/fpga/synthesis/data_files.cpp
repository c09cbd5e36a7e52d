#include <fpga/synthesis/data_files.h>

#include <algorithm>
#include <regex>
#include <set>
#include <vector>

#include <host/digest.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::synthesis {

namespace fs = std::filesystem;

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<fs::path> folders_of(const Design& design) {
  std::vector<fs::path> folders;
  const auto add = [&folders](const fs::path& folder) {
    if (std::find(folders.begin(), folders.end(), folder) == folders.end())
      folders.push_back(folder);
  };
  for (const fs::path& source : design.sources) add(fs::absolute(source).parent_path());
  for (const fs::path& include : design.includes) add(fs::absolute(include));
  return folders;
}

/// Files below the folders, by their last name, in the order of their paths.
std::map<std::string, std::set<fs::path>> files_below(const std::vector<fs::path>& folders) {
  std::map<std::string, std::set<fs::path>> files;
  std::error_code ignored;
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(
             folder, fs::directory_options::skip_permission_denied, ignored)) {
      if (entry.is_regular_file(ignored))
        files[entry.path().filename().string()].insert(entry.path());
    }
  }
  return files;
}

/// Texts in it that may be names of data.
std::vector<std::string> names_in(const std::string& text) {
  static const std::regex quoted(R"re("([A-Za-z0-9_./: +-]+\.[A-Za-z0-9_]+)")re"),
      source(R"(.*\.(v|sv|vh|svh|vhd|vhdl))");
  std::vector<std::string> names;
  for (std::sregex_iterator m(text.begin(), text.end(), quoted), end; m != end; ++m) {
    if (!std::regex_match((*m)[1].str(), source)) names.push_back((*m)[1]);
  }
  return names;
}

bool reads_files(const std::string& text) {
  static const std::regex call(R"(\$readmem|\$fopen|textio)", std::regex::icase);
  return std::regex_search(text, call);
}

}  // namespace

std::map<std::string, fs::path> data_files_of(const Design& design) {
  std::map<std::string, fs::path> found;
  const std::vector<fs::path> needed = needed_by(design.top, design.sources);
  if (std::none_of(needed.begin(), needed.end(), [](const fs::path& source) {
        return reads_files(vp::read_text(source, "source"));
      }))
    return found;
  const std::map<std::string, std::set<fs::path>> below = files_below(folders_of(design));
  static const std::regex above(R"(^(.*/)?\.\.?/|^/)");
  std::error_code ignored;
  const auto take = [&](const fs::path& source, const std::string& name, const fs::path& file) {
    const auto [known, is_new] = found.emplace(name, file);
    if (is_new || host::file_hash(known->second.string()) == host::file_hash(file.string())) return;
    throw vp::InputError(source.string() + ": '" + name + "' may be '" + known->second.string() +
                         "' or '" + file.string() + "', which differ: give each a name of its own");
  };
  for (const fs::path& source : needed) {
    for (const std::string& name : names_in(vp::read_text(source, "source"))) {
      const fs::path beside = (fs::absolute(source).parent_path() / name)
                                  .lexically_normal();  // `/` takes absolute ones
      if (fs::is_regular_file(beside, ignored)) {
        take(source, name, beside);
        continue;
      }
      const std::string ending = "/" + std::regex_replace(name, above, "");
      const auto known = below.find(fs::path(name).filename().string());
      if (known == below.end()) continue;
      std::vector<fs::path> same_end;
      for (const fs::path& file : known->second) {
        if (ends_with(file.string(), ending)) same_end.push_back(file);
      }
      if (same_end.empty()) same_end.assign(known->second.begin(), known->second.end());
      for (const fs::path& file : same_end) take(source, name, file);
    }
  }
  return found;
}

}  // namespace platform::synthesis

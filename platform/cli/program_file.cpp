#include <cli/program_file.h>

#include <filesystem>
#include <vector>

#include <input/library_folder.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* usual_program = "hybrid";

}  // namespace

bool is_own_program(const std::string& name) {
  const bool is_name = fs::path(name).filename() == name && !fs::path(name).has_extension();
  std::error_code ignored;
  return !is_name || fs::exists(name, ignored);
}

std::string program_file(const std::optional<std::string>& asked) {
  const std::string name = asked.value_or(usual_program);
  if (asked && is_own_program(name)) return name;
  std::error_code ignored;
  std::vector<std::string> folders;
  for (const std::string& folder : input::library_folders()) {
    const fs::path programs = fs::path(folder) / "programs";
    const fs::path file = programs / (name + ".so");
    if (fs::exists(file, ignored)) return file.string();
    folders.push_back(programs.string());
  }
  throw vp::InputError("no program '" + name + "' in " + vp::one_of(folders) +
                       ": give its file, or install markervp completely");
}

}  // namespace platform::cli

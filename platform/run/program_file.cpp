#include <run/program_file.h>

#include <designs/designs.h>

#include <filesystem>
#include <vector>

#include <host/process.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform {

namespace fs = std::filesystem;

bool is_own_program(const std::string& name) {
  const bool is_name = fs::path(name).filename() == name && !fs::path(name).has_extension();
  std::error_code ignored;
  return !is_name || fs::exists(name, ignored);
}

namespace {

/// Where installed programs are.
std::vector<std::string> program_folders() {
  std::vector<std::string> folders = host::library_folders();
  for (std::string& folder : folders) folder = (fs::path(folder) / "programs").string();
  return folders;
}

/// `<name>.so` in the first of these folders that has it; empty: none has.
std::string file_in(const std::vector<std::string>& folders, const std::string& name) {
  std::error_code ignored;
  for (const std::string& folder : folders) {
    const fs::path file = fs::path(folder) / (name + ".so");
    if (fs::exists(file, ignored)) return file.string();
  }
  return {};
}

std::string installed_program(const std::string& name) {
  const std::string file = file_in(program_folders(), name);
  if (!file.empty()) return file;
  throw vp::InputError("no program '" + name + "' in " + vp::one_of(program_folders()) +
                       ": give its file, or install markervp completely");
}

}  // namespace

std::string usual_program(const DesignInfo& design) {
  const std::string name = design.programs.front(), folder = folder_of(design);
  if (folder.empty()) return installed_program(name);
  std::vector<std::string> folders = program_folders();
  folders.insert(folders.begin(), folder);
  const std::string file = file_in(folders, name);
  if (!file.empty()) return file;
  throw vp::InputError("design '" + design.name + "' lacks its PS program '" + name + "': build " +
                       name + ".so in " + folder +
                       " (markervp_add_program), or choose another with --program");
}

std::string program_file(const std::string& name) {
  return is_own_program(name) ? name : installed_program(name);
}

}  // namespace platform

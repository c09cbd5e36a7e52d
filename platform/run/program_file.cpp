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

std::string installed_program(const std::string& name, const std::string& folder) {
  std::vector<std::string> folders;
  if (!folder.empty()) folders.push_back(folder);
  for (const std::string& library : host::library_folders())
    folders.push_back((fs::path(library) / "programs").string());
  std::error_code ignored;
  for (const std::string& programs : folders) {
    const fs::path file = fs::path(programs) / (name + ".so");
    if (fs::exists(file, ignored)) return file.string();
  }
  throw vp::InputError("no program '" + name + "' in " + vp::one_of(folders) +
                       ": give its file, or install markervp completely");
}

std::string usual_program(const DesignInfo& design) {
  return installed_program(design.programs.front(), folder_of(design));
}

std::string program_file(const std::string& name) {
  return is_own_program(name) ? name : installed_program(name);
}

}  // namespace platform

#include <input/library_folder.h>

#include <filesystem>

namespace platform::input {

std::vector<std::string> library_folders() {
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path root = executable.parent_path().parent_path();
  std::vector<std::string> folders{(root / "lib" / "markervp").string()};
  const std::string system = (root / MARKERVP_LIBDIR / "markervp").string();
  if (system != folders.front()) folders.push_back(system);
  return folders;
}

}  // namespace platform::input

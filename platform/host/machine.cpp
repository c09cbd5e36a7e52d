#include <unistd.h>

#include <ctime>
#include <filesystem>

#include <host/machine.h>

namespace platform::host {

std::string host_name() {
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) return "unknown";
  return name;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::vector<std::string> library_folders() {
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path root = executable.parent_path().parent_path();
  std::vector<std::string> folders{(root / "lib" / "markervp").string()};
  const std::string system = (root / MARKERVP_LIBDIR / "markervp").string();
  if (system != folders.front()) folders.push_back(system);
  return folders;
}

}  // namespace platform::host

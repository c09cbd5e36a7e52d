#include <sweep/studies.h>

#include <algorithm>
#include <filesystem>

#include <input/library_folder.h>
#include <sweep/spec.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::sweep {

namespace fs = std::filesystem;

std::vector<Study> studies() {
  std::vector<Study> found;
  std::error_code ignored;
  for (const std::string& folder : input::library_folders()) {
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "studies", ignored)) {
      if (entry.path().extension() != ".yaml") continue;
      const Spec spec = read_spec(entry.path().string());
      found.push_back({spec.name, spec.title, entry.path().string()});
    }
    if (!found.empty()) break;
  }
  std::sort(found.begin(), found.end(),
            [](const Study& a, const Study& b) { return a.name < b.name; });
  return found;
}

std::string sweep_file(const std::string& name) {
  std::error_code ignored;
  if (fs::exists(name, ignored)) return name;
  std::vector<std::string> names;
  for (const Study& study : studies()) {
    if (study.name == name) return study.file;
    names.push_back(study.name);
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("no sweep '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "name a YAML file, or a study that 'markervp sweep --list' shows");
}

}  // namespace platform::sweep

#include <fmt/format.h>

#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <report/words.h>
#include <scene/catalogue.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

std::string span(const SceneGroup& group) {
  if (group.scenes.size() == 1) return group.scenes.front();
  return group.scenes.front() + ".." + group.scenes.back();
}

void print_groups(std::ostream& out) {
  const auto row = [&](const std::string& name, const std::string& section,
                       const std::string& scenes, const std::string& what) {
    out << fmt::format("{:<8} {:<7} {:<19} {}\n", name, section, scenes, what);
  };
  row("group", "thesis", "scenes", "what");
  for (const SceneGroup& group : scene_groups()) {
    row(group.name, group.section, span(group), group.description);
  }
  out << "\n'markervp scenes GROUP' shows a group, 'markervp run NAME' runs a scene or a group.\n";
}

void print_group(const SceneGroup& group, std::ostream& out) {
  out << group.description << (group.section.empty() ? "" : " (thesis " + group.section + ")")
      << "\n\n";
  out << fmt::format("{:<11} {:>6}  {:>7}  {:>24}  {}\n", "scene", "marker", "squares",
                     "top left corner, m", "rotation");
  for (const std::string& name : group.scenes) {
    const Scene scene = make_scene(name);
    const Eigen::Vector3d& t = scene.pose.translation;
    const auto metres = [&](std::size_t axis) { return vp::format_fixed(t[axis], 3); };
    out << fmt::format("{:<11} {:>6}  {:>7}  {:>8}{:>8}{:>8}  {}\n", name, scene.marker_id,
                       scene.squares.size() + 1, metres(0), metres(1), metres(2),
                       report::angles_text(scene.pose.rotation));
  }
}

const SceneGroup& find_group(const std::string& name) {
  std::vector<std::string> names;
  for (const SceneGroup& group : scene_groups()) {
    if (group.name == name) return group;
    names.push_back(group.name);
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("unknown group of scenes '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "there are " + vp::join(names, ", "));
}

}  // namespace

int list_scenes(const ScenesOptions& options, std::ostream& out) {
  if (options.names_only) {
    const auto names = options.group.empty() ? scene_names() : find_group(options.group).scenes;
    for (const std::string& name : names) out << name << "\n";
  } else if (options.group.empty()) {
    print_groups(out);
  } else {
    print_group(find_group(options.group), out);
  }
  return done;
}

}  // namespace platform::cli

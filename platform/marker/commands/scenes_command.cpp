#include <fmt/format.h>

#include <cli/commands.h>
#include <host/output_folder.h>
#include <marker/commands/commands.h>
#include <marker/detectors/truth.h>
#include <marker/input/frame_source.h>
#include <marker/picture/picture.h>
#include <marker/report/marker_text.h>
#include <marker/scene/scene.h>
#include <result/console.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>

namespace platform::commands {

using namespace cli;

namespace {

/// `markervp scenes`.
struct ScenesOptions {
  std::string group;                  ///< empty: all
  bool names_only = false;            ///< one name a line, for scripts
  std::optional<std::string> output;  ///< folder for images and truth.json
};

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
                       angles_text(scene.pose.rotation));
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

/// The scenes as image files, with what is in them.
void write_scenes(const ScenesOptions& options, std::ostream& out) {
  if (options.group.empty())
    throw vp::InputError("scenes --output: name a scene or a group, as in 'markervp scenes roll'");
  const auto source = input::open_inputs({options.group}, {});
  host::OutputFolder folder(*options.output);
  detectors::Truth truth;
  while (const auto frame = source->next()) {
    if (!frame->truth) throw vp::InputError("'" + options.group + "' is no scene");
    const std::string file = frame->name + ".png";
    vp::write_file(folder.add(file), picture::encode_png(frame->image));
    truth.add(file, make_scene(frame->name, frame->camera));
  }
  vp::write_file(folder.add(detectors::Truth::file_name), truth.json());
  out << "wrote " << result::counted(*source->size(), "image") << " and "
      << detectors::Truth::file_name << " in " << *options.output << "\n";
}

int list_scenes(const ScenesOptions& options, std::ostream& out) {
  if (options.output) {
    write_scenes(options, out);
  } else if (options.names_only) {
    const auto names = options.group.empty() ? scene_names() : find_group(options.group).scenes;
    for (const std::string& name : names) out << name << "\n";
  } else if (options.group.empty()) {
    print_groups(out);
  } else {
    print_group(find_group(options.group), out);
  }
  return done;
}

std::vector<std::string> group_names() {
  std::vector<std::string> names;
  for (const SceneGroup& group : scene_groups()) names.push_back(group.name);
  return names;
}

}  // namespace

cli::Command add_scenes(CLI::App& parser) {
  const auto options = std::make_shared<ScenesOptions>();
  ScenesOptions& target = *options;
  CLI::App* command = parser.add_subcommand("scenes", "list the scenes that can be rendered");
  command->add_option("GROUP", target.group, "only this group, in detail")
      ->type_name(vp::join(group_names(), "|"));
  command->add_flag("--names", target.names_only, "one name a line, for scripts");
  command->add_option("-o,--output", target.output, "write images and truth.json of them")
      ->type_name("DIR");
  return {"scenes", [options](const std::vector<std::string>&, std::ostream& out, std::ostream&) {
            return list_scenes(*options, out);
          }};
}

}  // namespace platform::commands

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>

#include <cli/commands.h>
#include <marker/commands/commands.h>
#include <marker/poses/pose_text.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <CLI/CLI.hpp>

namespace platform::commands {

using namespace cli;

namespace {

/// `markervp poses`.
struct PosesOptions {
  std::string result = "out";
  std::string convention = "top-left";
  std::string format = "csv";
  std::vector<std::string> sides;
  poses::TextOptions text;
  std::optional<std::string> output;
};

/// The names of a list, for messages and choices.
template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const Named& each : list) names.emplace_back(each.name);
  return names;
}

template <class Named>
std::string described(const std::vector<Named>& list) {
  std::string text;
  for (const Named& each : list) text += fmt::format("  {:<12}{}\n", each.name, each.description);
  return text;
}

template <class Named>
const Named& find(const std::vector<Named>& list, const std::string& name) {
  return *std::find_if(list.begin(), list.end(),
                       [&](const Named& each) { return name == each.name; });
}

int print_poses(PosesOptions options, std::ostream& out, std::ostream& err) {
  options.text.convention = &find(poses::conventions(), options.convention);
  for (const std::string& side : options.sides)
    options.text.sides.push_back(poses::side_rule(side));
  const std::vector<poses::PoseFrame> frames = poses::read_poses(options.result);
  std::vector<std::string> warnings;
  const std::string text =
      poses::poses_text(find(poses::formats(), options.format), frames, options.text, warnings);
  for (const std::string& warning : warnings) err << "markervp: warning: " << warning << std::endl;
  if (options.output) {
    vp::write_file(*options.output, text);
    out << "wrote " << *options.output << "\n";
  } else {
    out << text;
  }
  return done;
}

}  // namespace

cli::Command add_poses(CLI::App& parser) {
  const auto options = std::make_shared<PosesOptions>();
  PosesOptions& target = *options;
  CLI::App* command = parser.add_subcommand(
      "poses", "write the poses of a run for OpenCV, AprilTag, ROS and others");
  command->footer("Frames (docs/poses.md has a picture):\n" + described(poses::conventions()) +
                  "\nFormats:\n" + described(poses::formats()));
  command->add_option("RESULT", target.result,
                      "folder of a run, or its result.json (default: out)");
  const auto choice = [&](const char* name, std::string& value, const char* what,
                          const std::vector<std::string>& names) {
    command->add_option(name, value, what)
        ->type_name(vp::join(names, "|"))
        ->check(CLI::IsMember(names).description(""));
  };
  choice("--frame", target.convention, "convention of marker frame, corners and pixels",
         names_of(poses::conventions()));
  choice("--format", target.format, "what is written", names_of(poses::formats()));
  command->add_option("--id", target.text.name, "only this marker; board: only the board")
      ->type_name("ID|board");
  command->add_option("--side", target.sides, "side of a marker, or of all; may be repeated")
      ->type_name("[ID[-ID]=]LENGTH")
      ->expected(1)
      ->take_all();
  command->add_option("--camera-frame", target.text.camera_frame, "frame_id of ROS' messages")
      ->type_name("NAME");
  command->add_option("-o,--output", target.output, "write a file instead of printing")
      ->type_name("FILE");
  return {"poses", [options](const std::vector<std::string>&, std::ostream& out,
                             std::ostream& err) { return print_poses(*options, out, err); }};
}

}  // namespace platform::commands

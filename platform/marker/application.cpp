#include <cli/application.h>
#include <host/output_folder.h>
#include <marker/commands/commands.h>
#include <marker/input/image_input.h>
#include <marker/picture/page_view.h>
#include <marker/picture/picture.h>
#include <marker/report/marker_text.h>
#include <study/inputs.h>

/// What this project's application adds to the platform.
namespace platform {

namespace {

constexpr const char* examples =
    R"(  markervp run                              the demo scene, results in out/
  markervp run z1.0 roll30 photo.png        scenes and files, one after the other
  markervp run roll                         every scene of a group
  markervp run clip.avi --fit scale --camera camera.yaml
  markervp sweep pixel-clock                a ready study
  markervp scenes                           what can be run
  markervp validate                         the thesis' chapter 5, value by value
)";

constexpr const char* run_help =
    R"(INPUT is a scene, a group of scenes, an image file, a folder of images or a video. Without
any the demo scene runs. With --linux it is an argument of the application. Results: result.json
and an annotated picture per frame.)";

const input::InputFrame* input_of(const facts::UnitReport& frame) {
  return dynamic_cast<const input::InputFrame*>(frame.given.get());
}

bool draw(const facts::UnitReport& frame, host::OutputFolder& folder) {
  const input::InputFrame* input = input_of(frame);
  if (!input) return false;
  picture::write_png(picture::annotate(input->image, frame),
                     folder.add(picture::picture_name(frame)));
  return true;
}

std::string page_view(const facts::UnitReport& frame) {
  const input::InputFrame* input = input_of(frame);
  return input ? picture::page_view(input->image, frame) : "null";
}

cli::Application marker_application() {
  cli::Application marker;
  marker.description =
      "Virtual platform of a Zynq-7020 that finds ArUco markers at a high frame rate.";
  marker.examples = examples;
  marker.run_help = run_help;
  marker.input_command = "scenes --names";
  marker.commands = {commands::add_design_figures, commands::add_scenes, commands::add_poses,
                     commands::add_validate, commands::add_compare_detectors};
  marker.requirements = {{"--require-marker", "detected", "exit code 1 if a frame has no marker"}};
  marker.summary_lines = marker_summary;
  marker.draw = draw;
  marker.page_view = page_view;
  return marker;
}

const cli::ApplicationRegistration of_markers(marker_application());

}  // namespace

}  // namespace platform

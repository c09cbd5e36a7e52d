#pragma once

#include <cli/application.h>

/// The commands that the marker application adds to the platform's.
namespace platform::commands {

/// Lists scenes, or writes their images and what is in them.
cli::Command add_scenes(CLI::App& parser);

/// Adds --figures and --changes to `designs`: runs each to see what it reaches and takes.
cli::Command add_design_figures(CLI::App& parser);

/// Writes the poses of a run in the conventions and formats of others.
cli::Command add_poses(CLI::App& parser);

/// Runs the tests of thesis chapter 5 on both systems, each in a process of its own, and compares
/// them with what the thesis prints. run_failed: a gate failed.
cli::Command add_validate(CLI::App& parser);

/// Shows the same images to our designs, OpenCV's ArUco and AprilTag 3.
cli::Command add_compare_detectors(CLI::App& parser);

}  // namespace platform::commands

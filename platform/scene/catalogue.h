#pragma once

#include <string>
#include <vector>

#include <scene/scene.h>

namespace platform {

/// Scenes that belong to one test of the thesis.
struct SceneGroup {
  std::string name;                 ///< x, y, z, pitch, yaw, roll, squares, id, front, demo
  std::string section;              ///< "5.2.2.1"; empty: not a test of the thesis
  std::string description;          ///< one line
  std::vector<std::string> scenes;  ///< names in order
};

/// Every scene there is: the 41 poses of thesis 5.2.2 and 5.2.3, the 15 pictures of 5.2.4, the ten
/// IDs of 5.2.1, a front view of each of the 250 markers, and the demo.
const std::vector<SceneGroup>& scene_groups();

/// The names of all scenes, group by group.
std::vector<std::string> scene_names();

bool is_scene(const std::string& name);

/// The scene of that name, seen by `camera`. Throws vp::InputError for an unknown name, with the
/// nearest known one.
Scene make_scene(const std::string& name, const Camera& camera = Camera{});

}  // namespace platform

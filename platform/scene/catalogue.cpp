#include <scene/catalogue.h>
#include <scene/catalogue_views.h>
#include <scene/dictionary.h>
#include <vp/error.h>
#include <vp/text.h>

#include <functional>

namespace platform {

namespace {

struct Entry {
  std::string name;
  std::function<void(Scene&)> fill;
};

struct Chapter {
  SceneGroup group;
  std::vector<Entry> entries;
};

/// One decimal place, as in "x-0.5".
std::string tenths(int value) {
  const int size = value < 0 ? -value : value;
  return (value < 0 ? "-" : "") + std::to_string(size / 10) + "." + std::to_string(size % 10);
}

Chapter displacements(const SceneGroup& group, int first, int last, int step,
                      Eigen::Vector3d (*translation)(double)) {
  Chapter chapter{group, {}};
  for (int value = first; value <= last; value += step) {
    chapter.entries.push_back({group.name + tenths(value), [=](Scene& scene) {
                                 scene.pose.translation = translation(value / 10.0);
                               }});
  }
  return chapter;
}

Chapter rotations(const SceneGroup& group, int last, int step,
                  Eigen::Matrix3d (*rotation)(double)) {
  Chapter chapter{group, {}};
  for (int degrees = 0; degrees <= last; degrees += step) {
    chapter.entries.push_back({group.name + std::to_string(degrees), [=](Scene& scene) {
                                 scene.pose = {rotation(degrees), {0, 0, 1}};
                               }});
  }
  return chapter;
}

template <typename Fill>
Chapter numbered(const SceneGroup& group, int first, int last, Fill fill) {
  Chapter chapter{group, {}};
  for (int number = first; number <= last; ++number) {
    chapter.entries.push_back(
        {group.name + std::to_string(number), [=](Scene& scene) { fill(scene, number); }});
  }
  return chapter;
}

Chapter identification() {
  Chapter chapter{{"id", "5.2.1", "ten markers, each from a place and angle of its own", {}}, {}};
  for (const IdentificationView& view : identification_views()) {
    chapter.entries.push_back({"id" + std::to_string(view.marker_id), [=](Scene& scene) {
                                 scene.marker_id = view.marker_id;
                                 scene.pose = pose_of(view);
                               }});
  }
  return chapter;
}

Chapter demonstration() {
  return {{"demo", "", "a marker among squares and foreign markers, seen from the side", {}},
          {{"demo", fill_demo}}};
}

std::vector<Chapter> make_chapters() {
  std::vector<Chapter> chapters;
  chapters.push_back(
      displacements({"x", "5.2.2.1", "camera moved along X, 2 m in front of the marker", {}}, -10,
                    10, 5, [](double metres) {
                      return Eigen::Vector3d{-metres, 0, 2};
                    }));
  chapters.push_back(
      displacements({"y", "5.2.2.2", "camera moved along Y, 2 m in front of the marker", {}}, -8, 8,
                    4, [](double metres) {
                      return Eigen::Vector3d{0, -metres, 2};
                    }));
  chapters.push_back(displacements({"z", "5.2.2.3", "camera moved away along Z, in m", {}}, 5, 45,
                                   5, [](double metres) {
                                     return Eigen::Vector3d{0, 0, metres};
                                   }));
  chapters.push_back(rotations({"pitch", "5.2.3.1", "camera turned about X at 1 m, in degrees", {}},
                               60, 15, rotation_x));
  chapters.push_back(rotations({"yaw", "5.2.3.2", "camera turned about Y at 1 m, in degrees", {}},
                               60, 15, rotation_y));
  chapters.push_back(rotations({"roll", "5.2.3.3", "camera turned about Z at 1 m, in degrees", {}},
                               330, 30, rotation_z));
  chapters.push_back(numbered({"squares", "5.2.4", "the marker and further squares, by count", {}},
                              1, most_squares, fill_squares));
  chapters.push_back(identification());
  chapters.push_back(
      numbered({"front", "5.2.1", "each marker of DICT_4X4_250 seen from the front at 1 m", {}}, 0,
               dictionary_size - 1, [](Scene& scene, int id) {
                 scene.marker_id = id;
                 scene.pose = pose_from_centre(Pose{}.rotation, {0, 0, 1});
               }));
  chapters.push_back(demonstration());
  for (Chapter& chapter : chapters) {
    for (const Entry& entry : chapter.entries) chapter.group.scenes.push_back(entry.name);
  }
  return chapters;
}

const std::vector<Chapter>& chapters() {
  static const std::vector<Chapter> all = make_chapters();
  return all;
}

const Entry* find_entry(const std::string& name) {
  for (const Chapter& chapter : chapters()) {
    for (const Entry& entry : chapter.entries) {
      if (entry.name == name) return &entry;
    }
  }
  return nullptr;
}

[[noreturn]] void refuse_unknown(const std::string& name) {
  const std::string nearest = vp::nearest_match(name, scene_names());
  const std::string hint = nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
  throw vp::InputError("unknown scene '" + name + "': " + hint + "'markervp scenes' lists all");
}

/// FNV-1a: the noise of a scene depends on its name alone.
std::uint64_t seed_of(const std::string& name) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (unsigned char character : name) hash = (hash ^ character) * 0x100000001B3u;
  return hash;
}

}  // namespace

const std::vector<SceneGroup>& scene_groups() {
  static const std::vector<SceneGroup> groups = [] {
    std::vector<SceneGroup> list;
    for (const Chapter& chapter : chapters()) list.push_back(chapter.group);
    return list;
  }();
  return groups;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneGroup& group : scene_groups()) {
    names.insert(names.end(), group.scenes.begin(), group.scenes.end());
  }
  return names;
}

bool is_scene(const std::string& name) {
  return find_entry(name) != nullptr;
}

Scene make_scene(const std::string& name, const Camera& camera) {
  const Entry* entry = find_entry(name);
  if (entry == nullptr) refuse_unknown(name);
  Scene scene;
  scene.name = name;
  scene.camera = camera;
  scene.seed = seed_of(name);
  entry->fill(scene);
  return scene;
}

}  // namespace platform

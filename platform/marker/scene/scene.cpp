#include <marker/scene/conditions.h>
#include <marker/scene/scene.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <marker/dictionary.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform {

static_assert(dictionary_size == marker::dictionary_size);

const std::array<std::uint16_t, dictionary_size>& dictionary() {
  return marker::dictionary;
}

std::uint16_t marker_word(int id) {
  if (id < 0 || id >= dictionary_size) {
    throw vp::InputError("marker ID " + std::to_string(id) + " is not in DICT_4X4_250: give 0 to " +
                         std::to_string(dictionary_size - 1));
  }
  return marker::dictionary[static_cast<std::size_t>(id)];
}

bool is_black(std::uint16_t word, int row, int column) {
  return ((word >> (15 - (4 * row + column))) & 1) != 0;
}

namespace {

constexpr double largest_blur_px = 100;

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
  throw vp::InputError("scene '" + scene.name + "': " + what);
}

void require_range(const Scene& scene, const char* what, double value, double high,
                   const char* unit) {
  if (!(value >= 0 && value <= high)) {
    refuse(scene, std::string(what) + " is " + std::to_string(value) + unit + ": give 0 to " +
                      std::to_string(high) + unit);
  }
}

constexpr double longest_shutter_s = 10;

void validate_shutter(const Scene& scene) {
  require_range(scene, "exposure", scene.shutter.exposure_s, longest_shutter_s, " s");
  require_range(scene, "readout", scene.shutter.readout_s, longest_shutter_s, " s");
  if (!(scene.motion.velocity.allFinite() && std::isfinite(scene.motion.spin_deg_per_s) &&
        std::isfinite(scene.time_s))) {
    refuse(scene, "motion or time is no number");
  }
}

void validate_room(const Scene& scene, const Pose& pose) {
  const Room& room = scene.room;
  if (!(room.wall_w > 0 && room.floor_v > room.ceiling_v && room.side_u > 0)) {
    refuse(scene, "the room is turned inside out: give wall > 0, floor below ceiling, side > 0");
  }
  const Eigen::Vector3d camera = camera_position(pose);
  if (!(camera.z() < 0)) {
    refuse(scene, "the camera sees the marker's back: turn the marker towards the camera");
  }
  const bool inside = camera.y() < room.floor_v && camera.y() > room.ceiling_v &&
                      std::abs(camera.x()) < room.side_u;
  if (!inside) {
    refuse(scene, "the camera is outside the room at U = " + std::to_string(camera.x()) +
                      " m, V = " + std::to_string(camera.y()) +
                      " m: move it inside or enlarge the room");
  }
}

/// Whether the squares, borders included, share more than an edge.
bool overlap(const Square& a, const Square& b) {
  const double a_border = a.side * border_fraction;
  const double b_border = b.side * border_fraction;
  return a.u - a_border < b.u + b.side + b_border && b.u - b_border < a.u + a.side + a_border &&
         a.v - a_border < b.v + b.side + b_border && b.v - b_border < a.v + a.side + a_border;
}

void validate_squares(const Scene& scene) {
  std::vector<Square> all{Square{}};
  all.insert(all.end(), scene.squares.begin(), scene.squares.end());
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (!(std::isfinite(all[i].u) && std::isfinite(all[i].v) && std::isfinite(all[i].side) &&
          all[i].side > 0)) {
      refuse(scene, "square " + std::to_string(i) + " has no place or size: give metres");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (overlap(all[i], all[j])) {
        refuse(scene, "square " + std::to_string(i) + " overlaps " +
                          (j == 0 ? std::string("the marker") : "square " + std::to_string(j)) +
                          ": move it away, borders included");
      }
    }
  }
}

}  // namespace

void validate(const Scene& scene) {
  validate(scene.camera);
  marker_word(scene.marker_id);
  validate_shutter(scene);
  const double half_s = (scene.shutter.readout_s + scene.shutter.exposure_s) / 2;
  for (const double time_s : {scene.time_s - half_s, scene.time_s + half_s}) {
    const Pose pose = pose_at(scene, time_s);
    validate(pose);
    project_marker(scene.camera, pose);
    validate_room(scene, pose);
  }
  validate_squares(scene);
  const Brightness& light = scene.brightness;
  require_range(scene, "brightness of black", light.black, 1, "");
  require_range(scene, "brightness of the border", light.border, 1, "");
  require_range(scene, "brightness of the wall", light.wall, 1, "");
  require_range(scene, "brightness of the floor", light.floor, 1, "");
  require_range(scene, "brightness of the ceiling", light.ceiling, 1, "");
  require_range(scene, "brightness of the side walls", light.side_walls, 1, "");
  require_range(scene, "noise", scene.noise_sigma, 1, "");
  require_range(scene, "vignetting", scene.vignetting, 1, "");
  require_range(scene, "hidden", scene.hidden, 1, "");
  require_range(scene, "blur", scene.blur_sigma_px, largest_blur_px, " px");
}

Pose pose_at(const Scene& scene, double time_s) {
  if (!scene.motion.any() || time_s == 0) return scene.pose;
  const Eigen::Vector3d centre = transform(scene.pose, {marker_side_m / 2, marker_side_m / 2, 0}) +
                                 scene.motion.velocity * time_s;
  return pose_from_centre(rotation_z(scene.motion.spin_deg_per_s * time_s) * scene.pose.rotation,
                          centre);
}

double exposure_time(const Scene& scene, double y_px) {
  return scene.time_s + scene.shutter.readout_s * (y_px / scene.camera.height - 0.5);
}

namespace {

/// A square as the camera sees it when the pose of the scene's marker is `pose`.
std::array<PixelPoint, 4> seen_square(const Scene& scene, Pose pose, const Square& square) {
  pose.translation = transform(pose, {square.u, square.v, 0});
  return project_marker(scene.camera, pose, square.side);
}

/// False: a part of it is behind the camera while the picture is taken, so it is not seen whole.
bool is_in_front(const Scene& scene, const Square& square) {
  const double half_s = (scene.shutter.readout_s + scene.shutter.exposure_s) / 2;
  for (const double time_s : {scene.time_s - half_s, scene.time_s, scene.time_s + half_s}) {
    for (const double u : {square.u, square.u + square.side}) {
      for (const double v : {square.v, square.v + square.side})
        if (!(transform(pose_at(scene, time_s), {u, v, 0}).z() > 0)) return false;
    }
  }
  return true;
}

GroundTruth truth_of(const Scene& scene, const Square& square, int id) {
  GroundTruth truth;
  truth.marker_id = id;
  truth.is_usual = square.side == marker_side_m;
  const Pose pose = pose_at(scene, scene.time_s);
  truth.pose = pose;
  truth.pose.translation = transform(pose, {square.u, square.v, 0});
  truth.corners_px = seen_square(scene, pose, square);
  if (!scene.motion.any() || scene.shutter.readout_s == 0) return truth;
  // A corner's row decides when it is seen, and when decides the row: a few rounds settle it, since
  // no row is passed as fast as rows are read.
  constexpr int rounds = 20;
  for (std::size_t i = 0; i < truth.corners_px.size(); ++i) {
    PixelPoint& corner = truth.corners_px[i];
    for (int round = 0; round < rounds; ++round) {
      const Pose then = pose_at(scene, exposure_time(scene, corner.y));
      corner = seen_square(scene, then, square)[i];
    }
  }
  return truth;
}

}  // namespace

GroundTruth ground_truth(const Scene& scene) {
  validate(scene);
  return truth_of(scene, Square{}, scene.marker_id);
}

std::vector<GroundTruth> ground_truths(const Scene& scene) {
  std::vector<GroundTruth> truths{ground_truth(scene)};
  const auto& words = dictionary();
  for (const Square& square : scene.squares) {
    const auto word = std::find(words.begin(), words.end(), square.word);
    if (word != words.end() && is_in_front(scene, square))
      truths.push_back(truth_of(scene, square, static_cast<int>(word - words.begin())));
  }
  return truths;
}

namespace {

/// The marker and `count` - 1 squares around it (thesis 5.2.4).
void fill_squares(Scene& scene, int count);

/// A view of thesis 5.2.1. The thesis names the IDs but not the places: decision.
struct IdentificationView {
  int marker_id;
  Eigen::Vector3d centre;  ///< of the marker in the camera frame, m
  double pitch;            ///< degrees; the rotation is Rx(pitch) * Ry(yaw) * Rz(roll)
  double yaw;              ///< degrees
  double roll;             ///< degrees
};

const std::vector<IdentificationView>& identification_views();

Pose pose_of(const IdentificationView& view);

/// The picture that a run without input shows: about 110 feature words.
void fill_demo(Scene& scene);

/// Distance between the squares of thesis 5.2.4, m (decision).
constexpr double square_pitch_m = 0.62;

/// Columns and rows of the squares in the order in which they appear (decision).
constexpr std::array<std::pair<int, int>, most_squares> square_places{{
    {0, 0},
    {-1, 0},
    {1, 0},
    {0, -1},
    {0, 1},
    {-1, -1},
    {1, -1},
    {-1, 1},
    {1, 1},
    {-2, 0},
    {2, 0},
    {-2, -1},
    {2, -1},
    {-2, 1},
    {2, 1},
}};

void fill_squares(Scene& scene, int count) {
  scene.pose.translation = {-marker_side_m / 2, -marker_side_m / 2, 2.5};
  scene.squares = squares_around(count);
}

const std::vector<IdentificationView>& identification_views() {
  static const std::vector<IdentificationView> views{
      {0, {0.00, 0.05, 1.20}, 20, -15, 0},      {7, {-0.45, 0.20, 1.80}, -10, 30, 10},
      {15, {0.50, -0.25, 1.60}, 12, 30, 98},    {21, {0.30, 0.30, 1.40}, -30, 14, 195},
      {36, {-0.20, -0.35, 2.20}, 5, -40, -95},  {43, {0.90, 0.10, 2.60}, 20, -25, 20},
      {52, {-0.30, 0.00, 1.00}, 30, 20, -8},    {76, {0.15, -0.10, 0.80}, 10, 45, 5},
      {88, {-0.80, 0.45, 3.00}, -12, -12, 190}, {99, {0.40, 0.15, 3.50}, -8, -18, -70},
  };
  return views;
}

Pose pose_of(const IdentificationView& view) {
  const Eigen::Matrix3d rotation =
      rotation_x(view.pitch) * (rotation_y(view.yaw) * rotation_z(view.roll));
  return pose_from_centre(rotation, view.centre);
}

void fill_demo(Scene& scene) {
  constexpr double pitch = square_pitch_m;
  constexpr double small = 0.19;
  scene.marker_id = 99;
  const Eigen::Matrix3d rotation = rotation_x(14) * (rotation_y(34) * rotation_z(-4));
  scene.pose = pose_from_centre(rotation, {0.08, 0.02, 1.75});
  // Foreign words: the markers of another dictionary.
  scene.squares = {
      {-pitch, 0, marker_side_m, 0x6BD6},
      {pitch, 0, marker_side_m, 0x9429},
      {0, -pitch, marker_side_m, 0x6996},
      {0, pitch, marker_side_m, plain_square_word},
      {-pitch, -pitch, marker_side_m, plain_square_word},
      {pitch, -pitch, marker_side_m, plain_square_word},
      {-pitch, pitch, marker_side_m, 0xF6F0},
      {-1.04, -0.62, small, plain_square_word},
      {-1.04, -0.20, small, 0x7BDE},
      {-1.04, 0.22, small, plain_square_word},
      {-1.04, 0.64, small, 0xFBD7},
  };
}

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

std::vector<Square> squares_around(int count) {
  std::vector<Square> squares;
  for (int i = 1; i < count; ++i) {
    const auto [column, row] = square_places[static_cast<std::size_t>(i)];
    Square square;
    square.u = column * square_pitch_m;
    square.v = row * square_pitch_m;
    squares.push_back(square);
  }
  return squares;
}

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
  return find_entry(name.substr(0, name.find('@'))) != nullptr;
}

Scene make_scene(const std::string& name, const Camera& camera) {
  const std::size_t conditions = name.find('@');
  const Entry* entry = find_entry(name.substr(0, conditions));
  if (entry == nullptr) refuse_unknown(name.substr(0, conditions));
  Scene scene;
  scene.name = name;
  scene.camera = camera;
  scene.seed = seed_of(name);
  entry->fill(scene);
  if (conditions != std::string::npos) set_conditions(scene, name.substr(conditions + 1));
  return scene;
}

}  // namespace platform

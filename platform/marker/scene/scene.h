#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <marker/scene/pose.h>

namespace platform {

/// Markers in ArUco's DICT_4X4_250.
constexpr int dictionary_size = 250;

/// The words of DICT_4X4_250, by ID: 4x4 cells row by row, the top left one in bit 15; 1 = black as
/// in the thesis (OpenCV has 1 = white).
const std::array<std::uint16_t, dictionary_size>& dictionary();

/// The word of one marker. Throws vp::InputError if `id` is not 0 to 249.
std::uint16_t marker_word(int id);

/// Colour of one of the 4x4 cells, row and column 0 to 3 from the top left.
bool is_black(std::uint16_t word, int row, int column);

/// Light that each surface sends, as a fraction of full scale (decision: wall and floor give the
/// histogram peaks 178 and 79 of appendix C.7).
struct Brightness {
  double black = 0.08;   ///< marker cells and squares
  double border = 0.90;  ///< white cells and the border around a marker
  double wall = 0.698;
  double floor = 0.31;
  double ceiling = 0.80;
  double side_walls = 0.62;
};

/// The room in the marker frame, m (decision). It has no end behind the camera.
struct Room {
  double wall_w = 0.6;
  double floor_v = 1.2;
  double ceiling_v = -2.6;
  double side_u = 4.5;  ///< the side walls stand at -side_u and +side_u
};

/// White border around a marker as a fraction of its side: 0.125 m at 0.30 m (thesis 5.1.1).
constexpr double border_fraction = 0.125 / 0.30;

/// The word of a square without white cells.
constexpr std::uint16_t plain_square_word = 0xFFFF;

/// A further square with white border on the marker's plane (thesis 5.2.4).
struct Square {
  double u = 0;                            ///< its top left corner in the marker frame, m
  double v = 0;                            ///< m
  double side = marker_side_m;             ///< m
  std::uint16_t word = plain_square_word;  ///< its 4x4 cells, 1 = black; all ones: a plain square
};

/// How marker and room move as the camera sees them, evenly.
struct Motion {
  Eigen::Vector3d velocity{0, 0, 0};  ///< of the marker's centre, m/s
  double spin_deg_per_s = 0;  ///< about that centre and the camera's axis, positive from x to y

  bool any() const { return spin_deg_per_s != 0 || !velocity.isZero(0); }
};

/// When the sensor gathers light. A row gathers for `exposure_s`; with a rolling shutter rows begin
/// one after the other, the last one `readout_s` · (1 - 1 / rows) later than the first.
struct Shutter {
  double exposure_s = 0;
  double readout_s = 0;  ///< 0: a global shutter
};

/// Everything that decides a picture. Two equal scenes render to equal bytes on any host.
struct Scene {
  std::string name;  ///< for messages and reports
  Camera camera;
  Pose pose;          ///< of the marker, at time 0
  Motion motion;      ///< from then on
  double time_s = 0;  ///< of the picture: the middle of the exposure of its middle row
  Shutter shutter;
  int marker_id = 0;  ///< DICT_4X4_250
  std::vector<Square> squares;
  Brightness brightness;
  Room room;
  double noise_sigma =
      0.007;  ///< deviation of the Gaussian noise, fraction of full scale (table 5.1)
  double blur_sigma_px = 0;  ///< deviation of the lens blur, px; 0: none
  double vignetting = 0;     ///< share of the light that is missing in the farthest corner
  std::uint64_t seed = 0;    ///< of the noise
  /// What light the camera's grey levels stand for: "srgb", "rec709" or an exponent, and its table;
  /// none: they are light.
  std::string response;
  std::shared_ptr<const marker::LightTable> light_of_levels;
  double hidden = 0;  ///< radius of a disc over the marker's top left corner, share of its side
  int jpeg = 0;       ///< quality of the file that the picture was in, 1 to 100; 0: none
};

/// What a perfect detector would find.
struct GroundTruth {
  int marker_id = 0;
  /// Clockwise from the marker's own top left, each where it is in the middle of the exposure of
  /// its row.
  std::array<PixelPoint, 4> corners_px;
  Pose pose;             ///< at the picture's time
  bool is_usual = true;  ///< as large as programs take all markers to be: they can find its pose
};

/// The marker's pose at a time, s.
Pose pose_at(const Scene& scene, double time_s);

/// The middle of the exposure at this height in the picture, px, s.
double exposure_time(const Scene& scene, double y_px);

/// Throws vp::InputError if the scene cannot be rendered: camera or pose invalid, a marker corner
/// not in front of the camera, the camera behind the marker or outside the room, an unknown ID,
/// overlapping squares, a level, noise or vignetting outside 0 to 1, a blur outside 0 to 100 px, a
/// hidden part outside 0 to 1, a negative exposure, or a motion that makes it so while the picture
/// is taken.
void validate(const Scene& scene);

/// Corners may lie outside the picture. Throws vp::InputError like validate().
GroundTruth ground_truth(const Scene& scene);

/// The same of each marker of the dictionary in front of the camera; the scene's own comes first.
std::vector<GroundTruth> ground_truths(const Scene& scene);

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

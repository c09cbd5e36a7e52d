#include <cmath>
#include <cstddef>
#include <string>

#include <marker/dictionary.h>
#include <scene/scene.h>
#include <vp/error.h>

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

void validate_room(const Scene& scene) {
  const Room& room = scene.room;
  if (!(room.wall_w > 0 && room.floor_v > room.ceiling_v && room.side_u > 0)) {
    refuse(scene, "the room is turned inside out: give wall > 0, floor below ceiling, side > 0");
  }
  const Eigen::Vector3d camera = camera_position(scene.pose);
  if (!(camera.z() < 0)) {
    refuse(scene, "the camera sees the marker's back: turn the marker towards the camera");
  }
  const bool inside = camera.y() < room.floor_v && camera.y() > room.ceiling_v &&
                      std::abs(camera.x()) < room.side_u;
  if (!inside) {
    refuse(scene, "the camera stands outside the room at U = " + std::to_string(camera.x()) +
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
  validate(scene.pose);
  marker_word(scene.marker_id);
  project_marker(scene.camera, scene.pose);
  validate_room(scene);
  validate_squares(scene);
  const Brightness& light = scene.brightness;
  require_range(scene, "brightness of black", light.black, 1, "");
  require_range(scene, "brightness of the border", light.border, 1, "");
  require_range(scene, "brightness of the wall", light.wall, 1, "");
  require_range(scene, "brightness of the floor", light.floor, 1, "");
  require_range(scene, "brightness of the ceiling", light.ceiling, 1, "");
  require_range(scene, "brightness of the side walls", light.side_walls, 1, "");
  require_range(scene, "noise", scene.noise_sigma, 1, "");
  require_range(scene, "blur", scene.blur_sigma_px, largest_blur_px, " px");
}

GroundTruth ground_truth(const Scene& scene) {
  validate(scene);
  return {scene.marker_id, project_marker(scene.camera, scene.pose), scene.pose};
}

}  // namespace platform

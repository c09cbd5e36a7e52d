#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <marker/scene/pose.h>
#include <marker/scene/scene.h>
#include <result/result_json.h>

namespace platform::detectors {

/// A marker that is in an image.
struct TrueMarker {
  int id = 0;
  // What is known of it.
  std::optional<std::array<PixelPoint, 4>> corners_px;  ///< clockwise from its own top left
  std::optional<Pose> pose;
};

/// What is known of an image.
struct ImageTruth {
  std::optional<std::vector<TrueMarker>> markers;  ///< all that are in it; none: not counted
  std::optional<std::set<int>> ids;                ///< that may be in it; none: not known
};

/// The file `truth.json` of a folder of images:
///
///     {"schema": 1,
///      "ids": [0, 1, 2],
///      "images": {"a.png": [{"id": 2, "corners_px": [[x, y], ... 4],
///                            "pose": {"rotation": [[...], ... 3], "translation_m": [x, y, z]}}]}}
///
/// `ids` is what may be seen in images that are not listed. It, corners and pose may be missing.
/// The centre of the first pixel is (0.5, 0.5), a pose as in result.json.
class Truth {
 public:
  static constexpr const char* file_name = "truth.json";

  /// Throws vp::InputError that names the file and what is wrong in it.
  static Truth read(const std::filesystem::path& file);
  /// That of the folder; nothing is known if it has none.
  static Truth of_folder(const std::filesystem::path& folder);

  void add(const std::string& image, const Scene& scene);
  /// `image`: its file's name.
  ImageTruth of(const std::string& image) const;
  bool empty() const { return images_.empty() && !ids_; }

  std::string json() const;

 private:
  std::map<std::string, std::vector<TrueMarker>> images_;
  std::optional<std::set<int>> ids_;
};

/// All markers of the dictionary in a scene.
ImageTruth truth_of(const Scene& scene);

// Corners and poses as result.json has them. nlohmann::json::exception: they are none.
std::array<PixelPoint, 4> corners_from(const result::Json& json);
Pose pose_from(const result::Json& json);

}  // namespace platform::detectors

#pragma once

#include <marker/images.h>
#include <marker/quad_fit.h>
#include <marker/scene/grey_image.h>
#include <marker/scene/scene.h>

#include <cstdint>
#include <ostream>
#include <vector>

namespace marker {
/// For the messages of tests.
inline std::ostream& operator<<(std::ostream& stream, Refusal refusal) {
  return stream << refusal_name(refusal);
}
}  // namespace marker

/// Pictures of the scene renderer, and what is before the code under test: blobs.
namespace pictures {

marker::GreyImage view(const platform::GreyImage& picture);
marker::Lens lens_of(const platform::Camera& camera);

/// The picture of a scene through a lens: `lens.camera` is that of the scene. No noise.
platform::GreyImage render_through(const platform::Scene& scene, const marker::Lens& lens);

/// Extremes of the dark blobs of a picture whose box is at least `minimum_side` px wide and high.
/// Pixels are dark up to `threshold`; blobs join over corners, and merge wherever they meet.
std::vector<marker::Extremes> find_blobs(const marker::GreyImage& picture,
                                         std::uint8_t threshold = 127,
                                         std::uint32_t minimum_side = 20);

/// Such blobs as the logic sends them, without a trailer (blob_stream.h).
std::vector<std::uint32_t> words_of(const std::vector<marker::Extremes>& blobs);

/// A scene of ten markers of 0.3 m in five columns and two rows, 0.26 m apart, with the IDs 0 to 9.
platform::Scene ten_markers();

/// A candidate that was fitted, with the corner of it that is the marker's own top left.
struct Found {
  bool found = false;
  marker::QuadFit fit{};
  double corner_error = 0;  ///< mean distance from the true corners, px
};

/// The marker of a scene in its picture: the fitted blob whose corners are within 2 px of the true
/// ones, turned so that corner 0 is the marker's own top left.
Found find_marker(const platform::Scene& scene, const marker::GreyImage& picture,
                  const marker::Lens& lens);

/// The 41 poses of thesis 5.2.2 and 5.2.3.
std::vector<platform::Scene> poses_of_the_thesis();

}  // namespace pictures

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <marker/scene/grey_image.h>
#include <marker/scene/pose.h>

namespace platform::detectors {

/// A marker as a detector saw it.
struct SeenMarker {
  int id = 0;
  std::array<PixelPoint, 4> corners_px;  ///< clockwise from the marker's own top left
  std::optional<Pose> pose;              ///< none: the corners admit none
};

/// The markers that are looked for.
struct MarkerSet {
  std::uint32_t cells = 0;           ///< of the code's side
  std::uint32_t distance = 0;        ///< least number of cells in which two words differ
  std::uint32_t corrected = 0;       ///< wrong cells that our own programs put up with
  std::vector<std::uint64_t> words;  ///< by ID: row by row, the top left cell highest; 1 = black
  double side_m = marker_side_m;     ///< of the black square
  std::uint32_t border = 1;          ///< width of the black border, cells
};

/// A detector that others wrote, on one thread of this computer.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;         ///< "opencv-subpix"
  virtual std::string description() const = 0;  ///< one line, with the library's version
  /// Throws std::runtime_error if the library fails.
  virtual std::vector<SeenMarker> find(const GreyImage& image, const Camera& camera) = 0;
};

/// The plug-in that knows the libraries: they take longer to load than most commands run.
class PeerLibrary {
 public:
  virtual ~PeerLibrary() = default;
  /// Each of its detectors, set up for these markers.
  virtual std::vector<std::unique_ptr<Peer>> peers(const MarkerSet& markers) const = 0;
};

/// Raised with every change of the classes above: the plug-in's entry point carries it in its name.
#define MARKERVP_PEERS_ENTRY markervp_peers_2

/// Those of the plug-in. Throws vp::InputError if it is missing or of another version.
std::vector<std::unique_ptr<Peer>> make_peers(const MarkerSet& markers);

}  // namespace platform::detectors

/// The plug-in's entry point.
extern "C" __attribute__((visibility("default"))) const platform::detectors::PeerLibrary*
MARKERVP_PEERS_ENTRY();

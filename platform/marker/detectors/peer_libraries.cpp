// The plug-in behind detectors/peers.h: OpenCV's ArUco and AprilTag 3.
#include <apriltag/apriltag.h>
#include <apriltag/apriltag_pose.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <host/stderr_capture.h>
#include <marker/detectors/peers.h>

namespace platform::detectors {

namespace {

/// OpenCV puts the centre of the first pixel at (0, 0), but not where it took over AprilTag's code:
/// over the 41 poses of the thesis' chapter 5 those corners would be off by (0.47, 0.46) px.
double first_centre(cv::aruco::CornerRefineMethod refinement) {
  return refinement == cv::aruco::CORNER_REFINE_APRILTAG ? 0 : 0.5;
}

class OpenCvPeer : public Peer {
 public:
  OpenCvPeer(const char* name, const char* corners, cv::aruco::CornerRefineMethod refinement,
             const MarkerSet& markers)
      : name_(name),
        corners_(corners),
        first_centre_(first_centre(refinement)),
        side_m_(markers.side_m) {
    dictionary_.markerSize = static_cast<int>(markers.cells);
    dictionary_.maxCorrectionBits = static_cast<int>((markers.distance - 1) / 2);
    for (const std::uint64_t word : markers.words)
      dictionary_.bytesList.push_back(byte_list(word, dictionary_.markerSize));
    parameters_->cornerRefinementMethod = refinement;
    parameters_->markerBorderBits = static_cast<int>(markers.border);
  }

  std::string name() const override { return name_; }
  std::string description() const override {
    return std::string("OpenCV " CV_VERSION ", ArUco, corners ") + corners_ +
           ", IPPE and Levenberg-Marquardt";
  }

  std::vector<SeenMarker> find(const GreyImage& image, const Camera& camera) override {
    const cv::Mat grey(image.height, image.width, CV_8UC1,
                       const_cast<std::uint8_t*>(image.pixels.data()));
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(grey, cv::makePtr<cv::aruco::Dictionary>(dictionary_), corners, ids,
                             parameters_);
    std::vector<SeenMarker> seen(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      seen[i].id = ids[i];
      for (std::size_t c = 0; c < seen[i].corners_px.size(); ++c)
        seen[i].corners_px[c] = {corners[i][c].x + first_centre_, corners[i][c].y + first_centre_};
      seen[i].pose = pose(seen[i].corners_px, camera);
    }
    return seen;
  }

 private:
  /// OpenCV's own form of a word: 1 = white, and its four rotations.
  static cv::Mat byte_list(std::uint64_t word, int cells) {
    cv::Mat bits(cells, cells, CV_8UC1);
    for (int i = 0; i < cells * cells; ++i) {
      const bool black = (word >> (cells * cells - 1 - i) & 1) != 0;
      bits.at<std::uint8_t>(i / cells, i % cells) = black ? 0 : 1;
    }
    return cv::aruco::Dictionary::getByteListFromBits(bits);
  }

  std::optional<Pose> pose(const std::array<PixelPoint, 4>& corners_px,
                           const Camera& camera) const {
    const std::vector<cv::Point3d> corners{
        {0, 0, 0}, {side_m_, 0, 0}, {side_m_, side_m_, 0}, {0, side_m_, 0}};
    std::vector<cv::Point2d> points;
    points.reserve(corners_px.size());
    for (const PixelPoint& corner : corners_px) points.emplace_back(corner.x, corner.y);
    const cv::Matx33d intrinsic(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    std::vector<double> lens(camera.distortion.begin(), camera.distortion.end());
    if (camera.lens_model == marker::LensModel::equidistant) {
      // solvePnP() knows no fisheye lens: it gets what a pinhole camera would see.
      lens.resize(4);
      cv::fisheye::undistortPoints(points, points, intrinsic, lens, cv::noArray(), intrinsic);
      lens.clear();
    }
    cv::Vec3d turn, shift;
    if (!cv::solvePnP(corners, points, intrinsic, lens, turn, shift, false, cv::SOLVEPNP_IPPE))
      return std::nullopt;
    cv::solvePnPRefineLM(corners, points, intrinsic, lens, turn, shift);
    cv::Matx33d rotation;
    cv::Rodrigues(turn, rotation);
    Pose found;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        found.rotation(row, column) = rotation(row, column);
      found.translation[row] = shift[row];
    }
    return found;
  }

  const char *name_, *corners_;
  double first_centre_;  ///< of both coordinates, px
  double side_m_;
  cv::aruco::Dictionary dictionary_;
  cv::Ptr<cv::aruco::DetectorParameters> parameters_ = cv::aruco::DetectorParameters::create();
};

/// A family of AprilTag's with the geometry of ArUco's markers: code and black border.
///
/// AprilTag turns a code by a quarter by moving its bits on by a quarter of their number, so the
/// bits of a quadrant come one after the other, row by row, then those of the next one clockwise;
/// the centre of an odd number of cells comes last.
class TagFamily {
 public:
  explicit TagFamily(const MarkerSet& markers) : cells_(markers.cells), border_(markers.border) {
    place_bits();
    for (const std::uint64_t word : markers.words) codes_.push_back(code(word));
    family_.ncodes = static_cast<std::uint32_t>(codes_.size());
    family_.codes = codes_.data();
    family_.width_at_border = static_cast<int>(cells_ + 2 * border_);
    family_.total_width = family_.width_at_border + 2;
    family_.nbits = static_cast<std::uint32_t>(x_.size());
    family_.bit_x = x_.data();
    family_.bit_y = y_.data();
    family_.h = markers.distance;
    family_.name = name_.data();
  }
  TagFamily(const TagFamily&) = delete;
  TagFamily& operator=(const TagFamily&) = delete;

  apriltag_family_t* get() { return &family_; }

 private:
  void place_bits() {
    const std::uint32_t last = cells_ + 2 * border_ - 1;  // of the marker in each direction
    std::vector<std::array<std::uint32_t, 2>> quadrant;
    for (std::uint32_t y = border_; 2 * y < last; ++y) {
      for (std::uint32_t x = y; x < last - y; ++x) quadrant.push_back({x, y});
    }
    for (int turn = 0; turn < 4; ++turn) {
      for (auto& [x, y] : quadrant) {
        x_.push_back(x);
        y_.push_back(y);
        const std::uint32_t old_x = x;
        x = last - y;
        y = old_x;
      }
    }
    if (cells_ % 2 == 1) {
      x_.push_back(last / 2);
      y_.push_back(last / 2);
    }
  }

  /// The bits of a word in this order; 1 = white.
  std::uint64_t code(std::uint64_t word) const {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const std::uint32_t place = (y_[i] - border_) * cells_ + x_[i] - border_;
      const bool black = (word >> (cells_ * cells_ - 1 - place) & 1) != 0;
      result = result << 1 | (black ? 0U : 1U);
    }
    return result;
  }

  std::uint32_t cells_, border_;
  std::vector<std::uint32_t> x_, y_;
  std::vector<std::uint64_t> codes_;
  std::string name_ = "aruco";
  apriltag_family_t family_{};
};

class AprilTagPeer : public Peer {
 public:
  explicit AprilTagPeer(const MarkerSet& markers)
      : side_m_(markers.side_m), family_(markers), detector_(apriltag_detector_create()) {
    // More cost the library gigabytes.
    constexpr std::uint32_t most_corrected = 2;
    apriltag_detector_add_family_bits(
        detector_, family_.get(), static_cast<int>(std::min(markers.corrected, most_corrected)));
    detector_->nthreads = 1;
    detector_->quad_decimate = 1;  // whole resolution: the most exact corners, the smallest markers
  }
  ~AprilTagPeer() override {
    apriltag_detector_destroy(detector_);  // frees what it added to the family, too
  }
  AprilTagPeer(const AprilTagPeer&) = delete;
  AprilTagPeer& operator=(const AprilTagPeer&) = delete;

  std::string name() const override { return "apriltag3"; }
  std::string description() const override {
    return "AprilTag " MARKERVP_APRILTAG_VERSION
           ", whole resolution, refined edges, orthogonal iteration";
  }

  std::vector<SeenMarker> find(const GreyImage& image, const Camera& camera) override {
    const host::StderrCapture quiet;  // estimate_tag_pose() thinks aloud
    image_u8_t grey{image.width, image.height, image.width,
                    const_cast<std::uint8_t*>(image.pixels.data())};
    zarray_t* found = apriltag_detector_detect(detector_, &grey);
    std::vector<SeenMarker> seen;
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(found, i, static_cast<void*>(&detection));
      seen.push_back(seen_marker(*detection, camera));
    }
    apriltag_detections_destroy(found);
    return seen;
  }

 private:
  SeenMarker seen_marker(apriltag_detection_t& detection, const Camera& camera) const {
    SeenMarker seen;
    seen.id = detection.id;
    // It lists them from the bottom left, counter-clockwise.
    for (std::size_t c = 0; c < 4; ++c)
      seen.corners_px[c] = {detection.p[3 - c][0], detection.p[3 - c][1]};
    apriltag_detection_info_t view{&detection, side_m_, camera.fx, camera.fy, camera.cx, camera.cy};
    apriltag_pose_t pose{};
    estimate_tag_pose(&view, &pose);
    if (pose.R == nullptr || pose.t == nullptr) return seen;
    seen.pose.emplace();
    for (unsigned row = 0; row < 3; ++row) {
      for (unsigned column = 0; column < 3; ++column)
        seen.pose->rotation(row, column) = MATD_EL(pose.R, row, column);
      seen.pose->translation[row] = MATD_EL(pose.t, row, 0);
    }
    // Its origin is the centre.
    seen.pose->translation -= seen.pose->rotation * Eigen::Vector3d(side_m_ / 2, side_m_ / 2, 0);
    // What matd_destroy() does, which Debian's library does not export.
    std::free(pose.R);
    std::free(pose.t);
    return seen;
  }

  double side_m_;
  TagFamily family_;
  apriltag_detector_t* detector_;
};

class Libraries : public PeerLibrary {
 public:
  std::vector<std::unique_ptr<Peer>> peers(const MarkerSet& markers) const override {
    cv::setNumThreads(1);
    std::vector<std::unique_ptr<Peer>> all;
    const auto add = [&](const char* name, const char* corners,
                         cv::aruco::CornerRefineMethod refinement) {
      all.push_back(std::make_unique<OpenCvPeer>(name, corners, refinement, markers));
    };
    add("opencv", "as found", cv::aruco::CORNER_REFINE_NONE);
    add("opencv-subpix", "refined to sub-pixels", cv::aruco::CORNER_REFINE_SUBPIX);
    add("opencv-apriltag", "as AprilTag 2 does", cv::aruco::CORNER_REFINE_APRILTAG);
    all.push_back(std::make_unique<AprilTagPeer>(markers));
    return all;
  }
};

}  // namespace

}  // namespace platform::detectors

const platform::detectors::PeerLibrary* MARKERVP_PEERS_ENTRY() {
  static const platform::detectors::Libraries libraries;
  return &libraries;
}

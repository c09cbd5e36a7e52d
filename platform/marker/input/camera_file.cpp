#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include <marker/input/calibration_file.h>
#include <marker/input/camera_file.h>
#include <marker/input/camera_response.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::input {

namespace {

constexpr double pixel_centre = 0.5;
constexpr std::size_t matrix_size = 9;

using Names = std::set<std::string>;

// Plain names (plain_name()).
const Names matrix_names{"cameramatrix", "k", "intrinsicmatrix"};
const Names distortion_names{"distortioncoefficients", "distcoeffs", "distortion", "d"};
const Names width_names{"imagewidth", "width"};
const Names height_names{"imageheight", "height"};
const Names size_names{"cameraresolution", "imagesize", "resolution"};
const Names rectification_names{"rectificationmatrix", "r"};
const Names projection_names{"projectionmatrix", "p"};
const Names skew_names{"skew", "alphac"};
const Names model_names{"distortionmodel", "distmodel",   "lensmodel",      "lenstype",
                        "cameramodel",     "model",       "modeltype",      "projectionmodel",
                        "projection",      "cameratype",  "fisheyemodel",   "fisheye",
                        "isfisheye",       "camera.type", "intrinsicsmodel"};

/// What calibrators write beside the camera: how they got it, and whose it is.
const Names known_names{"calibrationtime",
                        "calibrationdate",
                        "framescount",
                        "nrofframes",
                        "nframes",
                        "boardwidth",
                        "boardheight",
                        "squaresize",
                        "markersize",
                        "aspectratio",
                        "fixaspectratio",
                        "flags",
                        "avgreprojectionerror",
                        "perviewreprojectionerrors",
                        "reprojectionerror",
                        "rms",
                        "extrinsicparameters",
                        "imagepoints",
                        "gridpoints",
                        "cameraname",
                        "name",
                        "serialnumber",
                        "date",
                        "roi.dorectify",
                        "header.seq",
                        "header.frameid",
                        "header.stamp.secs",
                        "header.stamp.nsecs",
                        "header.stamp.sec",
                        "header.stamp.nanosec"};

/// Entries by which files of other programs are known.
struct Sign {
  const char* name;  ///< plain, of the entry or of the last of its names
  const char* file;
};
constexpr Sign signs[] = {{"distortioncoeffs", "a camchain of Kalibr"},
                          {"tcamimu", "a camchain of Kalibr"},
                          {"projectionparameters", "a camera file of VINS (camodocal)"},
                          {"mirrorparameters", "a camera file of VINS (camodocal)"},
                          {"radialdistortion", "MATLAB's cameraParameters"},
                          {"mappingcoefficients", "MATLAB's fisheyeIntrinsics"},
                          {"ppx", "intrinsics of librealsense"},
                          {"cameradata", "a calibration of DepthAI"},
                          {"mirroroffset", "a camera file of BoofCV"},
                          {"flx", "a transforms.json of a NeRF"},
                          {"m1", "a stereo calibration with two cameras"},
                          {"cameramatrix1", "a stereo calibration with two cameras"},
                          {"value0", "a calibration of Basalt"}};

/// A lens model by the names that it has in files, and how many coefficients it may have.
struct NamedLens {
  Names names;  ///< plain
  std::set<std::size_t> coefficients;
  bool is_fisheye = false;
};
const std::set<std::size_t> any_count{0, 4, 5, 8, 12, 14};
const NamedLens lens_models[] = {
    {{"plumbbob", "radtan", "radialtangential", "brown", "brownconrady"}, {0, 4, 5}},
    {{"pinhole", "perspective", "opencv", "0", "false", "no"}, any_count},
    {{"rational", "rationalpolynomial"}, {8, 12, 14}},
    {{"equidistant", "equi", "fisheye", "kannalabrandt", "kannalabrandt4", "kb4", "kannalabrandt8",
      "kb8"},
     {0, 4},
     true},
    {{"none", "undistorted", "nodistortion"}, {0}}};
/// A file that says yes to one of these is of a fisheye lens.
const Names fisheye_names{"fisheyemodel", "fisheye", "isfisheye"};
const Names yes{"1", "true", "yes"};
const Names response_names{"response", "cameraresponse", "responsecurve"};

bool is_name(const std::string& text, const Names& names) {
  return names.count(text) > 0;
}

/// Behind the last dot.
std::string last_name(const std::string& plain) {
  return plain.substr(plain.rfind('.') + 1);
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// True for an entry that may well hold a lens' distortion, under whatever name.
bool looks_like_distortion(const CalibrationEntry& entry) {
  const std::string all = plain_name(entry.name), name = last_name(all);
  static const Names short_names{"kc",  "xi",   "k1",   "k2",   "k3",    "k4",  "k5",
                                 "k6",  "p1",   "p2",   "s1",   "s2",    "s3",  "s4",
                                 "tau", "taux", "tauy", "k1k2", "alpha", "beta"};
  if (is_name(name, short_names)) return true;
  for (const char* part : {"distort", "fisheye", "radial", "tangential", "coef", "prism"})
    if (contains(all, part)) return true;
  for (std::size_t at = all.find("dist"); at != std::string::npos; at = all.find("dist", at + 1))
    if (all.compare(at, 8, "distance") != 0) return true;
  return contains(all, "lens") && !entry.numbers.empty();
}

bool is_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool is_zero(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
}

bool is_near(double a, double b) {
  return std::abs(a - b) <= 1e-6 * std::max(1.0, std::abs(b));
}

/// A camera out of the entries of its file.
class Reader {
 public:
  explicit Reader(const std::string& path)
      : path_(path), entries_(read_calibration_file(path)), used_(entries_.size(), false) {}

  CalibratedCamera read() {
    result_.name = std::filesystem::path(path_).filename().string();
    read_matrix();
    read_size();
    read_distortion();
    read_response();
    read_skew();
    read_region();
    read_rectification();
    read_rest();
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw vp::InputError("camera file '" + path_ + "' " + problem);
  }

  /// The entry with one of these names; null if missing. The same thing may be said twice,
  /// but not in two ways.
  const CalibrationEntry* find(const Names& names) {
    const CalibrationEntry* found = nullptr;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const CalibrationEntry& entry = entries_[i];
      if (!is_name(plain_name(entry.name), names)) continue;
      used_[i] = true;
      if (found && (entry.numbers != found->numbers || entry.text != found->text)) {
        refuse("says '" + vp::excerpt(found->name) + "' and '" + vp::excerpt(entry.name) +
               "', which differ: leave one");
      }
      if (!found) found = &entry;
    }
    return found;
  }

  /// The same of a matrix; null if missing, or it is empty or all zero: not set.
  const CalibrationEntry* find_matrix(const Names& names, std::size_t rows, std::size_t columns) {
    const CalibrationEntry* entry = find(names);
    if (entry == nullptr || (entry->is_list && entry->numbers.empty() && entry->text.empty()))
      return nullptr;
    const bool shaped = (entry->rows == 0 || entry->rows == rows) &&
                        (entry->columns == 0 || entry->columns == columns);
    const std::string shape = std::to_string(rows) + "x" + std::to_string(columns);
    if (!shaped || entry->numbers.size() != rows * columns)
      refuse("has a '" + vp::excerpt(entry->name) + "' that is not " + shape + " numbers");
    if (!is_finite(entry->numbers))
      refuse("has a '" + vp::excerpt(entry->name) + "' with values that are no numbers");
    return is_zero(entry->numbers) ? nullptr : entry;
  }

  /// A number; `otherwise` if it is not there.
  double number(const Names& names, double otherwise) {
    const CalibrationEntry* entry = find(names);
    if (entry == nullptr) return otherwise;
    if (entry->numbers.size() != 1 || !std::isfinite(entry->numbers[0]))
      refuse("has a '" + vp::excerpt(entry->name) + "' that is not one number");
    return entry->numbers[0];
  }

  void read_matrix() {
    const CalibrationEntry* entry = find(matrix_names);
    if (entry == nullptr) refuse_without_matrix();
    const std::vector<double>& m = entry->numbers;
    const bool shaped =
        (entry->rows == 0 || entry->rows == 3) && (entry->columns == 0 || entry->columns == 3);
    if (m.size() != matrix_size || !shaped) refuse("has a camera_matrix that is not 3x3 numbers");
    if (is_zero(m)) refuse("is of a camera that is not calibrated: its camera_matrix is zero");
    const bool affine = m[3] == 0 && m[6] == 0 && m[7] == 0 && m[8] == 1;
    if (m[2] == 0 && m[5] == 0 && m[6] > 0 && m[7] > 0 && m[8] == 1)
      refuse("has a transposed camera_matrix (MATLAB, Open3D): write it row by row");
    if (!is_finite(m) || !affine || !(m[0] > 0) || !(m[4] > 0)) {
      refuse("has a camera_matrix that is not [fx 0 cx; 0 fy cy; 0 0 1] with fx, fy > 0");
    }
    if (m[1] != 0) refuse("has a skewed camera_matrix: calibrate without skew");
    constexpr double least_focal_length_px = 10;
    if (m[0] < least_focal_length_px || m[4] < least_focal_length_px)
      refuse("has a focal length below 10 px: give camera_matrix in px, not in mm or in widths");
    result_.camera.fx = m[0];
    result_.camera.fy = m[4];
    result_.camera.cx = m[2] + pixel_centre;
    result_.camera.cy = m[5] + pixel_centre;
  }

  [[noreturn]] void refuse_without_matrix() const {
    for (const Sign& sign : signs) {
      for (const CalibrationEntry& entry : entries_) {
        const std::string plain = plain_name(entry.name);
        if (plain == sign.name || last_name(plain) == sign.name ||
            plain.rfind(sign.name + std::string("."), 0) == 0)
          refuse("looks like " + std::string(sign.file) + " (it has '" + vp::excerpt(entry.name) +
                 "'), which is not read: give " + accepted_calibrations);
      }
    }
    for (const CalibrationEntry& entry : entries_) {
      if (is_name(last_name(plain_name(entry.name)), matrix_names))
        refuse("has its camera_matrix inside another entry ('" + vp::excerpt(entry.name) +
               "'): give a file of this one camera, with its entries at the top level");
    }
    refuse(std::string("has no camera_matrix: give ") + accepted_calibrations);
  }

  int side(double value) const {
    if (!(value >= 1 && value <= largest_side_px) || value != std::floor(value))
      refuse("has an image width or height that is not 1 to 16384 px");
    return static_cast<int>(value);
  }

  void read_size() {
    Camera& camera = result_.camera;
    const double width = number(width_names, NAN), height = number(height_names, NAN);
    if (std::isnan(width) != std::isnan(height))
      refuse("has only one of image_width and image_height");
    result_.has_size = !std::isnan(width);
    if (result_.has_size) {
      camera.width = side(width);
      camera.height = side(height);
    }
    const CalibrationEntry* both = find(size_names);
    if (both == nullptr) return;
    if (both->numbers.size() != 2)
      refuse("has a '" + vp::excerpt(both->name) + "' that is not width and height");
    const int other_width = side(both->numbers[0]), other_height = side(both->numbers[1]);
    if (result_.has_size && (camera.width != other_width || camera.height != other_height))
      refuse("has two image sizes: leave one");
    camera.width = other_width;
    camera.height = other_height;
    result_.has_size = true;
  }

  /// The numbers of coefficients that the models named in the file allow. Notes a fisheye lens.
  std::set<std::size_t> allowed_counts() {
    std::set<std::size_t> counts = any_count;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const CalibrationEntry& entry = entries_[i];
      if (!is_name(plain_name(entry.name), model_names)) continue;
      used_[i] = true;
      if (entry.text.empty() && !entry.is_list) continue;
      const bool is_yes =
          is_name(plain_name(entry.name), fisheye_names) && is_name(plain_name(entry.text), yes);
      const std::string name = is_yes ? "fisheye" : plain_name(entry.text);
      const NamedLens* known = nullptr;
      for (const NamedLens& model : lens_models)
        if (is_name(name, model.names)) known = &model;
      if (known == nullptr) {
        refuse("says '" + vp::excerpt(entry.name) + ": " + vp::excerpt(entry.text) +
               "': a lens model that is not supported. plumb_bob (radtan, Brown-Conrady), "
               "rational_polynomial and equidistant (fisheye) are; calibrate for one of them");
      }
      is_model_named_ = true;
      if (known->is_fisheye) result_.lens_model = marker::LensModel::equidistant;
      std::set<std::size_t> common;
      std::set_intersection(counts.begin(), counts.end(), known->coefficients.begin(),
                            known->coefficients.end(), std::inserter(common, common.end()));
      counts = common;
    }
    return counts;
  }

  void read_distortion() {
    const std::set<std::size_t> counts = allowed_counts();
    const CalibrationEntry* entry = find(distortion_names);
    if (entry == nullptr) return;
    const std::vector<double>& k = entry->numbers;
    if (k.empty() && !entry->text.empty())
      refuse("has lens distortion in '" + vp::excerpt(entry->name) +
             "' whose values are not numbers");
    if (k.empty() && !entry->is_list) {
      refuse("has lens distortion that is not a list of numbers: '" + vp::excerpt(entry->name) +
             "'; write [] if the lens has none");
    }
    if (!is_finite(k))
      refuse("has lens distortion that is not a number: calibrate anew, or leave it out");
    if (entry->rows > 1 && entry->columns > 1)
      refuse("has lens distortion that is neither a row nor a column");
    if (counts.count(k.size()) == 0) {
      refuse("has " + std::to_string(k.size()) +
             " coefficients of lens distortion, which its lens model has not: plumb_bob has 4 or 5 "
             "(k1, k2, p1, p2, k3), rational_polynomial 8 or 12, equidistant 4");
    }
    const std::size_t known = result_.camera.distortion.size();
    if (k.size() > known && !is_zero({k.begin() + static_cast<std::ptrdiff_t>(known), k.end()})) {
      refuse(
          "has lens distortion of a tilted sensor (tau_x, tau_y), which is not supported: "
          "calibrate without CALIB_TILTED_MODEL");
    }
    // Beyond what lenses that are not quite straight have.
    constexpr double most_tangential = 0.02;
    if (!is_model_named_ && k.size() == 4 &&
        std::max(std::abs(k[2]), std::abs(k[3])) > most_tangential) {
      refuse(
          "has 4 coefficients of lens distortion without a lens model, and the last two are too "
          "large for p1 and p2: those of a fisheye lens come with 'fisheye_model: 1', others with "
          "'distortion_model: plumb_bob'");
    }
    constexpr std::size_t brown_conrady = 5;
    if (k.size() > brown_conrady && !is_zero({k.begin() + brown_conrady, k.end()}))
      result_.lens_model = marker::LensModel::rational;
    result_.distortion = k;
  }

  void read_response() {
    const CalibrationEntry* entry = find(response_names);
    if (entry == nullptr) return;
    result_.response = response_of(*entry, "camera file '" + path_ + "'");
  }

  void read_skew() {
    if (number(skew_names, 0) != 0) refuse("has skew: calibrate without skew");
  }

  /// Of the sensor's pixels that the images have.
  void read_region() {
    if (number({"binningx"}, 0) > 1 || number({"binningy"}, 0) > 1)
      refuse("is for binned images (binning_x, binning_y): calibrate at the images' own size");
    const double width = number({"roi.width"}, 0), height = number({"roi.height"}, 0);
    const bool is_whole = (width == 0 && height == 0) ||
                          (width == result_.camera.width && height == result_.camera.height);
    if (!is_whole || number({"roi.xoffset"}, 0) != 0 || number({"roi.yoffset"}, 0) != 0)
      refuse("is for a part of the images (roi): calibrate at the images' own size");
  }

  /// ROS: K and D are those of the images as they are taken, R and P of rectified ones.
  void read_rectification() {
    if (const CalibrationEntry* r = find_matrix(rectification_names, 3, 3)) {
      for (std::size_t i = 0; i < matrix_size; ++i) {
        if (is_near(r->numbers[i], i % 4 == 0 ? 1 : 0)) continue;
        refuse("rectifies the images by a turn ('" + vp::excerpt(r->name) +
               "' is not the identity), and whether they are rectified is not known: for images as "
               "they were taken leave it out with P, for rectified ones give P's first three "
               "columns as camera_matrix, without distortion");
      }
    }
    const CalibrationEntry* p = find_matrix(projection_names, 3, 4);
    if (p == nullptr) return;
    const Camera& c = result_.camera;
    const double expected[] = {
        c.fx, 0, c.cx - pixel_centre, 0, 0, c.fy, c.cy - pixel_centre, 0, 0, 0, 1, 0};
    for (std::size_t i = 0; i < p->numbers.size(); ++i) {
      if (is_near(p->numbers[i], expected[i])) continue;
      result_.oddities.push_back(
          "has a '" + vp::excerpt(p->name) +
          "' other than its camera_matrix: images are taken to be as the camera sends them, not "
          "rectified (image_raw, not image_rect)");
      return;
    }
  }

  /// What is left may be another way to say what the lens does.
  void read_rest() {
    std::vector<std::string> unknown;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const CalibrationEntry& entry = entries_[i];
      const std::string plain = plain_name(entry.name);
      const bool is_deviation = contains(plain, "stddev");
      if (used_[i] || is_deviation || is_name(plain, known_names)) continue;
      if (looks_like_distortion(entry)) {
        refuse("has '" + vp::excerpt(entry.name) +
               "', which looks like lens distortion and is not read: call it "
               "distortion_coefficients (k1, k2, p1, p2, k3), or leave it out");
      }
      const std::string name = vp::excerpt(entry.name);
      if (std::find(unknown.begin(), unknown.end(), name) == unknown.end()) unknown.push_back(name);
    }
    if (unknown.empty()) return;
    constexpr std::size_t most = 8;
    const std::size_t more = unknown.size() - std::min(unknown.size(), most);
    unknown.resize(unknown.size() - more);
    result_.oddities.push_back("has entries that are not read: " + vp::join(unknown, ", ") +
                               (more > 0 ? " and " + std::to_string(more) + " more" : ""));
  }

  std::string path_;
  std::vector<CalibrationEntry> entries_;
  std::vector<bool> used_;
  bool is_model_named_ = false;
  CalibratedCamera result_;
};

}  // namespace

CalibratedCamera read_camera_file(const std::string& path) {
  return Reader(path).read();
}

Camera camera_for(const CalibratedCamera& calibrated, ImageSize size) {
  Camera camera = calibrated.camera;
  const bool fits = camera.width == size.width && camera.height == size.height;
  if (calibrated.has_size && !fits) {
    throw vp::InputError("camera file '" + calibrated.name + "' is for images of " +
                         std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                         " px, not " + std::to_string(size.width) + "x" +
                         std::to_string(size.height) + ": calibrate at the image's own size");
  }
  camera.width = size.width;
  camera.height = size.height;
  const std::size_t known = std::min(calibrated.distortion.size(), camera.distortion.size());
  std::copy_n(calibrated.distortion.begin(), known, camera.distortion.begin());
  camera.lens_model = calibrated.lens_model;
  camera.response = calibrated.response;
  return camera;
}

bool has_distortion(const CalibratedCamera& calibrated) {
  const std::vector<double>& all = calibrated.distortion;
  return calibrated.lens_model == marker::LensModel::equidistant ||
         std::any_of(all.begin(), all.end(), [](double value) { return value != 0; });
}

}  // namespace platform::input

#include <expat.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include <input/camera_file.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/yaml.h>

// OpenCV's own parser is for files that one trusts: it overruns the stack on short ones.

namespace platform::input {

namespace {

/// Calibration files have a few hundred lines; anything larger is something else.
constexpr std::uintmax_t largest_file = 1 << 20;

/// An entry as the file has it, before it is known to be numbers.
struct Entry {
  std::vector<std::string> words;  ///< row by row
  bool is_binary = false;          ///< the one word is base64
  // Of OpenCV's matrices only, which say what they hold.
  std::string type;  ///< "d", "f", "2f": channels and type of an element
  std::string rows, columns;
};

std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c != '_') text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

/// Reads a whole word; OpenCV and YAML write ".Nan" and "-.Inf".
std::optional<double> number(std::string_view word) {
  const bool has_plus = !word.empty() && word.front() == '+';
  const bool is_negative = !word.empty() && word.front() == '-';
  std::string text = plain(std::string(word.substr(has_plus || is_negative ? 1 : 0)));
  if (text == ".nan" || text == ".inf") text.erase(0, 1);
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  if (!text.empty() && text.front() == '-') return std::nullopt;
  return is_negative ? -value : value;
}

/// OpenCV's --base64: 24 bytes that name the type, then the elements as a PC has them in memory.
std::optional<std::vector<double>> unpacked(const std::string& base64) {
  constexpr std::size_t head = 24;
  const std::vector<unsigned char> bytes = YAML::DecodeBase64(base64);
  if (bytes.size() < head) return std::nullopt;
  const std::string type(vp::trim({reinterpret_cast<const char*>(bytes.data()), head}));
  const auto elements = [&](auto element) {
    std::vector<double> values;
    for (std::size_t at = head; at + sizeof element <= bytes.size(); at += sizeof element) {
      std::memcpy(&element, bytes.data() + at, sizeof element);
      values.push_back(static_cast<double>(element));
    }
    return values;
  };
  switch (type.empty() ? ' ' : type.back()) {
    case 'd':
      return elements(double());
    case 'f':
      return elements(float());
    case 'i':
      return elements(std::int32_t());
    default:
      return std::nullopt;
  }
}

/// Nothing if the entry is not numbers; throws vp::InputError if it is a matrix with some missing.
std::optional<std::vector<double>> numbers(const Entry& entry, const std::string& where) {
  std::vector<double> values;
  if (entry.is_binary) {
    auto found = unpacked(vp::join(entry.words, ""));
    if (!found) return std::nullopt;
    values = *std::move(found);
  } else {
    for (const std::string& word : entry.words) {
      const auto value = number(word);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
  }
  if (entry.type.empty()) return values;
  if (entry.type.back() == 'f')
    for (double& value : values) value = static_cast<float>(value);
  const double channels = number(entry.type.substr(0, entry.type.size() - 1)).value_or(1);
  const auto rows = number(entry.rows), columns = number(entry.columns);
  if (rows && columns && *rows * *columns * channels != static_cast<double>(values.size())) {
    throw vp::InputError(where + ": its data are not rows times cols numbers");
  }
  return values;
}

/// The entries of a file as they come.
class Collection {
 public:
  explicit Collection(std::string what) : what_(std::move(what)) {}

  void add(const std::string& name, const Entry& entry) {
    const auto found = numbers(entry, what_ + ", '" + vp::excerpt(name) + "'");
    if (found && !found->empty()) values_[plain(name)] = *found;
  }
  CalibrationValues take() { return std::move(values_); }

 private:
  std::string what_;
  CalibrationValues values_;
};

// ---- YAML and JSON ----

void add_words(const YAML::Node& node, Entry& entry) {
  if (node.IsScalar()) {
    entry.words.push_back(node.Scalar());
  } else if (node.IsSequence()) {
    for (const YAML::Node& element : node) add_words(element, entry);
  } else {
    entry.words.emplace_back();  // not a number
  }
}

Entry entry_of(const YAML::Node& node) {
  constexpr std::string_view base64_mark = "$base64$";
  Entry entry;
  const YAML::Node data = node.IsMap() ? node["data"] : node;
  if (!data) return entry;
  const auto scalar = [&](const char* key) {
    const YAML::Node found = node[key];
    return found && found.IsScalar() ? found.Scalar() : std::string();
  };
  if (node.IsMap() && node["dt"]) {
    entry.type = scalar("dt");
    entry.rows = scalar("rows");
    entry.columns = scalar("cols");
  }
  add_words(data, entry);
  if (!data.IsScalar()) return entry;
  const bool is_marked = data.Scalar().rfind(base64_mark, 0) == 0;
  if (is_marked) entry.words.front().erase(0, base64_mark.size());
  entry.is_binary = is_marked || data.Tag() == "tag:yaml.org,2002:binary";
  return entry;
}

/// OpenCV writes comments into its JSON as C++ has them: turned into blanks.
std::string without_comments(std::string json) {
  bool in_text = false;
  for (std::size_t i = 0; i + 1 < json.size(); ++i) {
    if (in_text && json[i] == '\\') {
      ++i;
    } else if (json[i] == '"') {
      in_text = !in_text;
    } else if (!in_text && json[i] == '/' && json[i + 1] == '/') {
      for (; i < json.size() && json[i] != '\n'; ++i) json[i] = ' ';
    }
  }
  return json;
}

CalibrationValues read_yaml(const std::string& text, const std::string& what) {
  // JSON is YAML, but for its comments.
  const bool is_json = text.rfind('{', 0) == 0;
  const YAML::Node root =
      vp::load_yaml(is_json ? without_comments(text) : text, what, vp::YamlDocuments::first);
  if (!root.IsMap()) throw vp::InputError(what + ": no calibration in YAML, XML or JSON");
  Collection collection(what);
  for (const auto& entry : root) {
    if (entry.first.IsScalar()) collection.add(entry.first.Scalar(), entry_of(entry.second));
  }
  return collection.take();
}

// ---- XML ----

/// <opencv_storage> <name> words </name> <name type_id="opencv-matrix"> <rows/> <cols/> <dt/>
/// <data> words </data> </name> </opencv_storage>; <_> stands around elements of lists.
class XmlReader {
 public:
  XmlReader(const std::string& what)
      : what_(what), collection_(what), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {}

  CalibrationValues read(const std::string& text) {
    XML_Parser parser = parser_.get();
    if (parser == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &XmlReader::start, &XmlReader::end);
    XML_SetCharacterDataHandler(parser, &XmlReader::characters);
    // No calibration has one, and entities are defined in it.
    XML_SetStartDoctypeDeclHandler(parser, &XmlReader::doctype);
    const auto status = XML_Parse(parser, text.data(), static_cast<int>(text.size()), XML_TRUE);
    if (error_) std::rethrow_exception(error_);
    if (status != XML_STATUS_OK) fail("this is not whole XML: calibrate again, or correct it");
    return collection_.take();
  }

 private:
  static constexpr std::size_t deepest = 32;

  [[noreturn]] void fail(const std::string& problem) const {
    throw vp::InputError(what_ + ":" + std::to_string(XML_GetCurrentLineNumber(parser_.get())) +
                         ":" + std::to_string(XML_GetCurrentColumnNumber(parser_.get()) + 1) +
                         ": " + problem);
  }

  /// No exception may pass through the library.
  template <class Work>
  static void guarded(void* self, Work work) {
    auto& reader = *static_cast<XmlReader*>(self);
    if (reader.error_) return;
    try {
      work(reader);
    } catch (...) {
      reader.error_ = std::current_exception();
      XML_StopParser(reader.parser_.get(), XML_FALSE);
    }
  }

  static void start(void* self, const XML_Char* name, const XML_Char** attributes) {
    guarded(self, [&](XmlReader& reader) { reader.open(name, attributes); });
  }
  static void end(void* self, const XML_Char*) {
    guarded(self, [](XmlReader& reader) { reader.close(); });
  }
  static void characters(void* self, const XML_Char* text, int size) {
    guarded(self,
            [&](XmlReader& reader) { reader.text_.append(text, static_cast<std::size_t>(size)); });
  }
  static void doctype(void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    guarded(self,
            [](XmlReader& reader) { reader.fail("a calibration has no DOCTYPE: leave it out"); });
  }

  void open(const std::string& name, const XML_Char** attributes) {
    if (path_.empty() && name != "opencv_storage") fail("no <opencv_storage>: not OpenCV's XML");
    if (path_.size() == deepest)
      fail("nested more than " + std::to_string(deepest) + " levels deep: calibrate again");
    take_words();
    path_.push_back(name);
    if (path_.size() == 2) {
      entry_ = {};
      is_map_ = has_data_ = false;
    }
    if (path_.size() == 3 && name != "_") is_map_ = true;
    if (path_.size() == 3 && name == "data") has_data_ = true;
    for (; *attributes != nullptr; attributes += 2) {
      if (std::string_view(attributes[0]) == "type_id" &&
          std::string_view(attributes[1]) == "binary")
        entry_.is_binary = true;
    }
  }

  void close() {
    take_words();
    if (path_.size() == 2 && (has_data_ || !is_map_)) collection_.add(path_[1], entry_);
    path_.pop_back();
  }

  /// What stands between two tags.
  void take_words() {
    const std::string field = path_.size() > 2 ? path_[2] : "";
    if (field == "rows") {
      entry_.rows += vp::trim(text_);
    } else if (field == "cols") {
      entry_.columns += vp::trim(text_);
    } else if (field == "dt") {
      entry_.type += vp::trim(text_);
    } else if (path_.size() > 1 && (field.empty() || field == "_" || field == "data")) {
      std::replace_if(
          text_.begin(), text_.end(), [](char c) { return std::isspace(c & 0xff) != 0; }, ' ');
      for (std::string& word : vp::split(text_, ' '))
        if (!word.empty()) entry_.words.push_back(std::move(word));
    }
    text_.clear();
  }

  const std::string& what_;
  Collection collection_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser_;
  std::exception_ptr error_;
  std::vector<std::string> path_;  ///< names of the open elements
  std::string text_;               ///< since the last tag
  Entry entry_;
  bool is_map_ = false, has_data_ = false;
};

}  // namespace

CalibrationValues read_calibration_values(const std::string& path) {
  const std::string text = vp::read_text(path, "camera file", largest_file);
  const std::string what = "camera file '" + path + "'";
  if (text.empty()) throw vp::InputError(what + " is empty");
  if (text.find('\0') != std::string::npos)
    throw vp::InputError(what + ": no calibration in YAML, XML or JSON");
  return text.rfind("<?xml", 0) == 0 ? XmlReader(what).read(text) : read_yaml(text, what);
}

namespace {

constexpr double pixel_centre = 0.5;
constexpr std::size_t matrix_size = 9;

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw vp::InputError("camera file '" + path + "' " + problem);
}

const std::vector<double>* first_of(const CalibrationValues& values,
                                    const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto found = values.find(name);
    if (found != values.end()) return &found->second;
  }
  return nullptr;
}

int side(const std::vector<double>& values, const std::string& path) {
  const double side = values.size() == 1 ? values[0] : 0;
  if (!(side >= 1 && side <= largest_side_px) || side != std::floor(side)) {
    refuse(path, "has an image width or height that is not 1 to 16384 px");
  }
  return static_cast<int>(side);
}

void read_matrix(const CalibrationValues& values, const std::string& path, Camera& camera) {
  const std::vector<double>* k = first_of(values, {"cameramatrix", "k", "intrinsicmatrix"});
  if (k == nullptr) refuse(path, "has no camera_matrix (OpenCV or ROS calibration expected)");
  if (k->size() != matrix_size) refuse(path, "has a camera_matrix that is not 3x3");
  const bool finite = std::all_of(k->begin(), k->end(), [](double v) { return std::isfinite(v); });
  const std::vector<double>& m = *k;
  const bool affine = m[3] == 0 && m[6] == 0 && m[7] == 0 && m[8] == 1;
  if (!finite || !affine || !(m[0] > 0) || !(m[4] > 0)) {
    refuse(path, "has a camera_matrix that is not [fx 0 cx; 0 fy cy; 0 0 1] with fx, fy > 0");
  }
  if (m[1] != 0) refuse(path, "has a skewed camera_matrix: calibrate without skew");
  camera.fx = m[0];
  camera.fy = m[4];
  camera.cx = m[2] + pixel_centre;
  camera.cy = m[5] + pixel_centre;
}

}  // namespace

CalibratedCamera read_camera_file(const std::string& path) {
  const CalibrationValues values = read_calibration_values(path);
  CalibratedCamera result;
  result.name = std::filesystem::path(path).filename().string();
  read_matrix(values, path, result.camera);
  const std::vector<double>* width = first_of(values, {"imagewidth", "width"});
  const std::vector<double>* height = first_of(values, {"imageheight", "height"});
  if ((width == nullptr) != (height == nullptr)) {
    refuse(path, "has only one of image_width and image_height");
  }
  result.has_size = width != nullptr;
  if (result.has_size) {
    result.camera.width = side(*width, path);
    result.camera.height = side(*height, path);
  }
  const auto* distortion =
      first_of(values, {"distortioncoefficients", "distcoeffs", "distortion", "d"});
  if (distortion == nullptr) return result;
  if (!std::all_of(distortion->begin(), distortion->end(),
                   [](double v) { return std::isfinite(v); }))
    refuse(path, "has lens distortion that is not a number: calibrate anew, or leave it out");
  result.distortion = *distortion;
  return result;
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
  return camera;
}

namespace {

bool has_distortion(const CalibratedCamera& calibrated, std::size_t from) {
  const std::vector<double>& all = calibrated.distortion;
  return from < all.size() && std::any_of(all.begin() + static_cast<std::ptrdiff_t>(from),
                                          all.end(), [](double value) { return value != 0; });
}

}  // namespace

bool has_distortion(const CalibratedCamera& calibrated) {
  return has_distortion(calibrated, 0);
}

std::optional<double> lens_reach_px(const CalibratedCamera& calibrated, ImageSize usual) {
  const Camera& known = calibrated.camera;
  const Camera camera =
      camera_for(calibrated, calibrated.has_size ? ImageSize{known.width, known.height} : usual);
  const auto [k1, k2, p1, p2, k3] = camera.distortion;
  double corner = 0;
  for (const double x : {0, camera.width}) {
    for (const double y : {0, camera.height}) {
      corner =
          std::max(corner, std::hypot((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy));
    }
  }
  double seen = 0;
  for (int step = 1; seen < corner; ++step) {
    constexpr double step_size = 1e-3;
    const double r = step * step_size, r2 = r * r;
    const double next = r * (1 + r2 * (k1 + r2 * (k2 + r2 * k3)));
    if (!(next > seen)) return seen * std::min(camera.fx, camera.fy);
    seen = next;
  }
  return std::nullopt;
}

bool has_more_distortion(const CalibratedCamera& calibrated) {
  return has_distortion(calibrated, calibrated.camera.distortion.size());
}

}  // namespace platform::input

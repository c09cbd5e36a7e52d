#include <marker/input/calibration_dialect.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::input {

namespace {

using Entries = std::vector<CalibrationEntry>;
using Numbers = std::vector<double>;

CalibrationEntry list_of(std::string name, Numbers numbers, std::size_t rows = 0,
                         std::size_t columns = 0) {
  CalibrationEntry entry;
  entry.name = std::move(name);
  entry.numbers = std::move(numbers);
  entry.is_list = true;
  entry.rows = rows;
  entry.columns = columns;
  return entry;
}

CalibrationEntry word_of(std::string name, std::string text) {
  CalibrationEntry entry;
  entry.name = std::move(name);
  entry.text = std::move(text);
  return entry;
}

CalibrationEntry matrix_of(double fx, double fy, double cx, double cy, double skew = 0) {
  return list_of("camera_matrix", {fx, skew, cx, 0, fy, cy, 0, 0, 1}, 3, 3);
}

/// Some entries of a file by their plain names, each taken once.
class Words {
 public:
  Words(Entries entries, std::string what) : what_(std::move(what)), entries_(std::move(entries)) {}

  [[noreturn]] void refuse(const std::string& problem) const {
    throw vp::InputError(what_ + " " + problem);
  }

  bool has(const std::string& name) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const CalibrationEntry& e) { return plain_name(e.name) == name; });
  }

  /// Takes it out; refuses where it says two things.
  std::optional<CalibrationEntry> take(const std::string& name) {
    std::optional<CalibrationEntry> found;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      if (plain_name(entry->name) != name) {
        ++entry;
        continue;
      }
      if (found && (found->numbers != entry->numbers || found->text != entry->text))
        refuse("says '" + vp::excerpt(entry->name) + "' twice, which differ: leave one");
      found = *entry;
      entry = entries_.erase(entry);
    }
    return found;
  }

  /// That many numbers.
  Numbers numbers(const std::string& name, std::size_t least, std::size_t most) {
    const std::optional<CalibrationEntry> entry = take(name);
    if (!entry) refuse("has no '" + name + "'");
    const std::size_t count = entry->numbers.size();
    if (count < least || count > most) {
      refuse("has a '" + vp::excerpt(entry->name) + "' that is not " +
             (least == most ? std::to_string(most)
                            : std::to_string(least) + " to " + std::to_string(most)) +
             " numbers");
    }
    return entry->numbers;
  }
  double number(const std::string& name, std::optional<double> otherwise = std::nullopt) {
    if (otherwise && !has(name)) return *otherwise;
    return numbers(name, 1, 1)[0];
  }

  void drop(std::initializer_list<const char*> names) {
    for (const char* name : names) {
      entries_.erase(
          std::remove_if(entries_.begin(), entries_.end(),
                         [&](const CalibrationEntry& e) { return plain_name(e.name) == name; }),
          entries_.end());
    }
  }

  void add(CalibrationEntry entry) { entries_.push_back(std::move(entry)); }
  Entries rest() { return std::move(entries_); }
  const Entries& entries() const { return entries_; }

 private:
  std::string what_;
  Entries entries_;
};

// ---- Kalibr ----

/// "cam0" of "cam0.intrinsics"; empty if that is no camera of a camchain.
std::string camera_of(const std::string& plain) {
  const std::size_t dot = plain.find('.');
  if (dot == std::string::npos || dot < 4 || plain.compare(0, 3, "cam") != 0) return "";
  const bool is_number = std::all_of(plain.begin() + 3, plain.begin() + static_cast<long>(dot),
                                     [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? plain.substr(0, dot) : "";
}

bool is_camchain(const Words& words) {
  return std::any_of(words.entries().begin(), words.entries().end(), [](const auto& entry) {
    const std::string plain = plain_name(entry.name);
    const std::string camera = camera_of(plain);
    return !camera.empty() && plain == camera + ".intrinsics";
  });
}

/// A camera whose entries begin with `prefix`.
Entries from_kalibr(Words words, const std::string& prefix) {
  const std::optional<CalibrationEntry> model = words.take(prefix + "cameramodel");
  if (!model || plain_name(model->text) != "pinhole") {
    words.refuse("says '" + prefix + "camera_model: " + (model ? vp::excerpt(model->text) : "") +
                 "': a projection that is not supported; pinhole is");
  }
  const Numbers k = words.numbers(prefix + "intrinsics", 4, 4);
  words.add(matrix_of(k[0], k[1], k[2], k[3]));
  const std::optional<CalibrationEntry> lens = words.take(prefix + "distortionmodel");
  if (!lens || lens->text.empty()) words.refuse("has no '" + prefix + "distortion_model'");
  words.add(word_of("distortion_model", lens->text));
  if (words.has(prefix + "distortioncoeffs"))
    words.add(list_of("distortion_coefficients", words.numbers(prefix + "distortioncoeffs", 0, 8)));
  if (words.has(prefix + "resolution"))
    words.add(list_of("resolution", words.numbers(prefix + "resolution", 2, 2)));
  for (const char* name : {"rostopic", "tcamimu", "tcncnm1", "camoverlaps", "timeshiftcamimu"})
    words.take(prefix + name);
  return words.rest();
}

Entries from_camchain(Words words) {
  std::string camera;
  for (const CalibrationEntry& entry : words.entries()) {
    const std::string found = camera_of(plain_name(entry.name));
    if (found.empty()) continue;
    if (!camera.empty() && found != camera) {
      words.refuse("has several cameras ('" + camera + "' and '" + found +
                   "'): give a file with the one that took the images");
    }
    camera = found;
  }
  return from_kalibr(std::move(words), camera + ".");
}

/// The sensor.yaml of a data set (EuRoC's form): a camera of Kalibr's at the top level.
bool is_sensor_file(const Words& words) {
  return words.has("intrinsics") && words.has("cameramodel") && words.has("distortionmodel");
}

Entries from_sensor_file(Words words) {
  words.drop({"sensortype", "comment", "ratehz", "tbs", "tbs.rows", "tbs.cols", "tbs.data"});
  return from_kalibr(std::move(words), "");
}

// ---- MATLAB's cameraParameters ----

Entries from_matlab(Words words) {
  // MATLAB's first pixel is (1, 1), OpenCV's (0, 0).
  if (words.has("intrinsicmatrix")) {
    const Numbers m = words.numbers("intrinsicmatrix", 9, 9);
    words.add(matrix_of(m[0], m[4], m[6] - 1, m[7] - 1, m[3]));
    if (m[1] != 0 || m[2] != 0 || m[5] != 0 || m[8] != 1)
      words.refuse("has an IntrinsicMatrix that is not [fx 0 0; s fy 0; cx cy 1] as MATLAB has it");
    words.drop({"k"});
  } else {
    const Numbers m = words.numbers("k", 9, 9);
    words.add(matrix_of(m[0], m[4], m[2] - 1, m[5] - 1, m[1]));
    if (m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
      words.refuse("has a K that is not [fx s cx; 0 fy cy; 0 0 1]");
  }
  const Numbers radial = words.numbers("radialdistortion", 2, 3);
  Numbers tangential{0, 0};
  if (words.has("tangentialdistortion")) tangential = words.numbers("tangentialdistortion", 2, 2);
  words.add(word_of("distortion_model", "plumb_bob"));
  words.add(list_of("distortion_coefficients", {radial[0], radial[1], tangential[0], tangential[1],
                                                radial.size() > 2 ? radial[2] : 0}));
  if (words.has("imagesize")) {
    const Numbers size = words.numbers("imagesize", 2, 2);  // rows first
    words.add(list_of("image_size", {size[1], size[0]}));
  }
  words.drop({"focallength", "principalpoint", "numradialdistortioncoefficients", "estimateskew",
              "estimatetangentialdistortion", "worldunits", "worldpoints", "meanreprojectionerror",
              "rotationvectors", "translationvectors", "numpatterns"});
  return words.rest();
}

// ---- ORB-SLAM ----

Entries from_orb_slam(Words words) {
  // Its versions say "Camera.fx" and "Camera1.fx".
  const std::string camera = words.has("camera1.fx") ? "camera1." : "camera.";
  if (words.has("camera2.fx")) words.refuse("has two cameras: give a file with one of them");
  const std::optional<CalibrationEntry> type = words.take("camera.type");
  const std::string model = type ? plain_name(type->text) : "pinhole";
  if (model != "pinhole" && model != "kannalabrandt8") {
    words.refuse("says 'Camera.type: " + vp::excerpt(type->text) +
                 "': a camera that is not supported; PinHole and KannalaBrandt8 are");
  }
  words.add(matrix_of(words.number(camera + "fx"), words.number(camera + "fy"),
                      words.number(camera + "cx"), words.number(camera + "cy")));
  const auto k = [&](const char* name) { return words.number(camera + name, 0); };
  const Numbers first{k("k1"), k("k2")};
  if (model == "kannalabrandt8") {
    words.add(word_of("distortion_model", "equidistant"));
    words.add(list_of("distortion_coefficients", {first[0], first[1], k("k3"), k("k4")}));
  } else {
    const Numbers tangential{k("p1"), k("p2")};
    words.add(word_of("distortion_model", "plumb_bob"));
    words.add(list_of("distortion_coefficients",
                      {first[0], first[1], tangential[0], tangential[1], k("k3")}));
  }
  if (words.has("camera.width"))
    words.add(list_of("image_size", {words.number("camera.width"), words.number("camera.height")}));
  words.drop({"camera.fps", "camera.rgb", "camera.bf", "file.version"});
  return words.rest();
}

// ---- Scripts ----

/// All of a line's words as numbers; none if one is not.
std::optional<Numbers> numbers_in(const std::string& line) {
  std::istringstream words(line);
  Numbers numbers;
  for (std::string word; words >> word;) {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto read = std::from_chars(word.data() + (word[0] == '+' ? 1 : 0), end, value);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    numbers.push_back(value);
  }
  if (numbers.empty()) return std::nullopt;
  return numbers;
}

/// ROS's ost.txt: a heading, and below it numbers.
Entries read_ost(const std::string& text, const std::string& what) {
  std::map<std::string, Numbers> found;
  std::string section, heading;
  std::vector<std::string> cameras;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = std::string(vp::trim(line));
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      section = plain_name(line.substr(1, line.find(']') - 1));
      if (section != "image" && section != "externals") cameras.push_back(section);
    } else if (const std::optional<Numbers> numbers = numbers_in(line)) {
      Numbers& all = found[heading];
      all.insert(all.end(), numbers->begin(), numbers->end());
    } else {
      heading = section == "externals" ? "" : plain_name(line);
    }
  }
  if (cameras.size() > 1)
    throw vp::InputError(what + " has several cameras: give a file with one of them");
  Entries entries;
  const auto add = [&](const char* heading_of, const char* name, std::size_t rows,
                       std::size_t columns) {
    const auto numbers = found.find(heading_of);
    if (numbers == found.end()) return;
    if (rows * columns != 0 && numbers->second.size() != rows * columns) {
      throw vp::InputError(what + " has a '" + name + "' that is not " +
                           std::to_string(rows * columns) + " numbers");
    }
    entries.push_back(list_of(name, numbers->second, rows * columns > 1 ? rows : 0,
                              rows * columns > 1 ? columns : 0));
  };
  add("width", "image_width", 1, 1);
  add("height", "image_height", 1, 1);
  add("cameramatrix", "camera_matrix", 3, 3);
  add("distortion", "distortion_coefficients", 0, 0);
  add("rectification", "rectification_matrix", 3, 3);
  add("projection", "projection_matrix", 3, 4);
  // Its writer knows no other.
  entries.push_back(word_of("distortion_model", "plumb_bob"));
  return entries;
}

/// The numbers that a script of MATLAB assigns: "name = [ 1 ; 2 ];" or "name = 1;".
std::map<std::string, Numbers> assignments(const std::string& text) {
  std::map<std::string, Numbers> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (line[0] == '%' || equals == std::string::npos) continue;
    std::string value = line.substr(equals + 1, line.find('%', equals) - equals - 1);
    for (char& c : value)
      if (c == '[' || c == ']' || c == ';' || c == ',') c = ' ';
    if (const std::optional<Numbers> numbers = numbers_in(value))
      found[std::string(vp::trim(line.substr(0, equals)))] = *numbers;
  }
  return found;
}

Entries read_caltech(const std::string& text, const std::string& what) {
  const std::map<std::string, Numbers> script = assignments(text);
  const auto of = [&](const char* name, std::size_t count) -> const Numbers& {
    const auto found = script.find(name);
    if (found == script.end() || found->second.size() != count) {
      throw vp::InputError(what + " has no '" + name + "' of " + std::to_string(count) +
                           " numbers, as Calib_Results.m of Caltech's toolbox has it");
    }
    return found->second;
  };
  const Numbers &f = of("fc", 2), &c = of("cc", 2);
  const auto kc = script.find("kc");
  if (kc != script.end() && kc->second.size() == 4) {
    throw vp::InputError(what +
                         " has a 'kc' of 4 numbers, which may be those of the toolbox's fisheye "
                         "function or of an old one: write kc with 5, or a camera_info YAML");
  }
  Entries entries{matrix_of(f[0], f[1], c[0], c[1])};
  if (kc != script.end()) {
    entries.push_back(word_of("distortion_model", "plumb_bob"));
    entries.push_back(list_of("distortion_coefficients", of("kc", 5)));
  }
  if (script.count("alpha_c") > 0) entries.push_back(list_of("alpha_c", of("alpha_c", 1)));
  if (script.count("nx") > 0 || script.count("ny") > 0)
    entries.push_back(list_of("image_size", {of("nx", 1)[0], of("ny", 1)[0]}));
  return entries;
}

bool assigns(const std::string& text, const std::string& variable) {
  for (const char* assigned : {" = [", "=["}) {
    const std::string start = variable + assigned;
    if (text.rfind(start, 0) == 0 || text.find("\n" + start) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

Entries in_known_words(Entries entries, const std::string& what) {
  Words words(std::move(entries), what);
  if (is_sensor_file(words)) return from_sensor_file(std::move(words));
  if (is_camchain(words)) return from_camchain(std::move(words));
  if (words.has("radialdistortion") && (words.has("intrinsicmatrix") || words.has("k")))
    return from_matlab(std::move(words));
  if (words.has("camera.fx") || words.has("camera1.fx")) return from_orb_slam(std::move(words));
  return words.rest();
}

std::optional<Entries> read_script(const std::string& text, const std::string& what) {
  if (text.find("# oST version") != std::string::npos || text.rfind("[image]", 0) == 0)
    return read_ost(text, what);
  if (assigns(text, "fc") || assigns(text, "cc") || assigns(text, "kc"))
    return read_caltech(text, what);
  return std::nullopt;
}

}  // namespace platform::input

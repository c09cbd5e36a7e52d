#include <input/calibration_values.h>

#include <yaml-cpp/yaml.h>

#include <cctype>
#include <opencv2/core.hpp>

#include <input/file_bytes.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::input {

namespace {

/// Calibration files have a few hundred lines; anything larger is something else.
constexpr std::size_t largest_file = 1 << 20;

std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c != '_') text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

[[noreturn]] void refuse_malformed(const std::string& path, const std::string& why) {
  throw vp::InputError("camera file '" + path + "' is malformed: " + why);
}

// ---- OpenCV
// ---------------------------------------------------------------------------------------------------------

bool is_file_storage(const std::string& text) {
  return text.rfind("%YAML", 0) == 0 || text.rfind("<?xml", 0) == 0 || text.rfind('{', 0) == 0;
}

std::vector<double> matrix_values(const cv::Mat& matrix) {
  cv::Mat reals;
  matrix.convertTo(reals, CV_64F);
  const cv::Mat row = reals.reshape(1, 1);
  return {row.begin<double>(), row.end<double>()};
}

std::vector<double> node_values(const cv::FileNode& node) {
  std::vector<double> values;
  if (node.isInt() || node.isReal()) {
    values.push_back(static_cast<double>(node));
  } else if (node.isMap() && !node["data"].empty()) {
    values = matrix_values(node.mat());
  } else if (node.isSeq()) {
    for (const cv::FileNode& element : node) {
      const std::vector<double> part = node_values(element);
      values.insert(values.end(), part.begin(), part.end());
    }
  }
  return values;
}

/// OpenCV writes to stderr before it throws; the message is ours to print.
int keep_quiet(int, const char*, const char*, const char*, int, void*) {
  return 0;
}

CalibrationValues read_file_storage(const std::string& text, const std::string& path) {
  cv::redirectError(keep_quiet);
  CalibrationValues values;
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    for (const cv::FileNode& node : storage.root()) {
      const std::vector<double> numbers = node_values(node);
      if (!numbers.empty()) values[plain(node.name())] = numbers;
    }
  } catch (const cv::Exception& exception) {
    refuse_malformed(path, exception.err);
  }
  return values;
}

// ---- ROS
// ------------------------------------------------------------------------------------------------------------

std::vector<double> node_values(const YAML::Node& node) {
  std::vector<double> values;
  if (node.IsScalar()) {
    double value = 0;
    if (YAML::convert<double>::decode(node, value)) values.push_back(value);
  } else if (node.IsSequence()) {
    for (const YAML::Node& element : node) {
      const std::vector<double> part = node_values(element);
      values.insert(values.end(), part.begin(), part.end());
    }
  } else if (node.IsMap() && node["data"]) {
    values = node_values(node["data"]);
  }
  return values;
}

CalibrationValues read_yaml(const std::string& text, const std::string& path) {
  CalibrationValues values;
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) refuse_malformed(path, "no calibration in YAML, XML or JSON");
    for (const auto& entry : root) {
      const std::vector<double> numbers = node_values(entry.second);
      if (!numbers.empty()) values[plain(entry.first.as<std::string>())] = numbers;
    }
  } catch (const YAML::Exception& exception) {
    refuse_malformed(path,
                     "line " + std::to_string(exception.mark.line + 1) + ": " + exception.msg);
  }
  return values;
}

}  // namespace

CalibrationValues read_calibration_values(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path, largest_file + 1);
  const std::string text(bytes.begin(), bytes.end());
  if (bytes.size() > largest_file || text.find('\0') != std::string::npos) {
    refuse_malformed(path, "no calibration in YAML, XML or JSON");
  }
  return is_file_storage(text) ? read_file_storage(text, path) : read_yaml(text, path);
}

}  // namespace platform::input

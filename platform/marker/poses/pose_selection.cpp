#include <marker/poses/pose_selection.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include <vp/error.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <Eigen/Geometry>

namespace platform::poses {

namespace {

/// As large as the rules say.
FoundPose sized(const FoundPose& found, const TextOptions& options) {
  if (found.is_board()) return found;
  const int id = std::stoi(found.name);
  for (auto rule = options.sides.rbegin(); rule != options.sides.rend(); ++rule) {
    if (rule->first_id <= id && id <= rule->last_id) return with_side(found, rule->side_m);
  }
  return found;
}

}  // namespace

SideRule side_rule(const std::string& text) {
  SideRule rule{0, std::numeric_limits<int>::max()};
  const std::size_t sign = text.find('=');
  if (sign != std::string::npos) {
    int end = 0;
    const std::string ids = text.substr(0, sign);
    const int numbers =
        std::sscanf(ids.c_str(), "%d%n-%d%n", &rule.first_id, &end, &rule.last_id, &end);
    if (numbers == 1) rule.last_id = rule.first_id;
    if (numbers < 1 || static_cast<std::size_t>(end) != ids.size() || rule.first_id < 0 ||
        rule.last_id < rule.first_id)
      throw vp::InputError("--side '" + text + "': '" + ids +
                           "' is no ID and no range of IDs, as 7 or 10-19");
  }
  try {
    rule.side_m =
        vp::parse_quantity(text.substr(sign == std::string::npos ? 0 : sign + 1), vp::Unit::length)
            .to_double();
  } catch (const vp::InputError& error) {
    throw vp::InputError("--side '" + text + "': the side " + error.what());
  }
  if (!(rule.side_m > 0)) throw vp::InputError("--side '" + text + "': a side is longer than 0");
  return rule;
}

std::vector<FoundPose> found_in(const PoseFrame& frame, const TextOptions& options) {
  std::vector<FoundPose> chosen;
  for (const FoundPose& found : frame.found) {
    if (!options.name || found.name == *options.name)
      chosen.push_back(in_convention(*options.convention, sized(found, options)));
  }
  return chosen;
}

std::vector<FoundPose> placed_in(const PoseFrame& frame, const TextOptions& options,
                                 std::vector<std::string>& warnings) {
  const std::vector<FoundPose> all = found_in(frame, options);
  std::vector<FoundPose> placed;
  std::set<std::string> told;
  for (const FoundPose& found : all) {
    const auto times = std::count_if(
        all.begin(), all.end(), [&](const FoundPose& other) { return other.name == found.name; });
    if (times == 1 && found.pose) placed.push_back(found);
    if (times > 1 && told.insert(found.name).second)
      warnings.push_back("frame " + std::to_string(frame.index) + " has marker " + found.name +
                         " " + std::to_string(times) +
                         " times: left out, for they would have one name");
  }
  return placed;
}

namespace {

std::vector<std::string> names_in(const std::vector<PoseFrame>& frames,
                                  bool (*counts)(const FoundPose&)) {
  std::set<std::string> names;
  for (const PoseFrame& frame : frames) {
    for (const FoundPose& found : frame.found) {
      if (counts(found)) names.insert(found.name);
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace

void check_name(const std::vector<PoseFrame>& frames, const TextOptions& options) {
  const auto names = names_in(frames, [](const FoundPose&) { return true; });
  if (!options.name || std::find(names.begin(), names.end(), *options.name) != names.end()) return;
  throw vp::InputError("--id: there is no '" + *options.name + "' in it: there " +
                       (names.empty() ? "are no markers" : "are " + vp::join(names, ", ")));
}

void require_one_name(const std::vector<PoseFrame>& frames, const TextOptions& options,
                      const std::string& format) {
  const auto names =
      names_in(frames, [](const FoundPose& found) { return found.pose.has_value(); });
  if (!options.name && names.size() > 1)
    throw vp::InputError("--format " + format +
                         " is of one marker, or of the board: say which with "
                         "--id; there are " +
                         vp::join(names, ", "));
}

std::uint64_t taken_ns(const PoseFrame& frame) {
  if (!frame.taken_us)
    throw vp::InputError("frame " + std::to_string(frame.index) +
                         " does not say when its image was taken: its software gave it up, or its "
                         "result is of an earlier version");
  return static_cast<std::uint64_t>(std::llround(*frame.taken_us * 1000));
}

std::array<double, 4> quaternion_of(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  const double sign = q.w() < 0 ? -1 : 1;
  return {sign * q.x(), sign * q.y(), sign * q.z(), sign * q.w()};
}

}  // namespace platform::poses

#include <profiles/profile_file.h>

#include <vp/error.h>
#include <vp/text.h>

#include <cmath>
#include <vector>

#include <host/document.h>

namespace platform::profiles {

namespace {

constexpr int version = 1;

/// As short as it reads back.
std::string written(double value) {
  return nlohmann::json(value).dump();
}

}  // namespace

ProfileFile::ProfileFile(const std::filesystem::path& path) : path_(path) {
  root_ = host::read_json(path, "profile");
  if (!root_.is_object()) refuse("it is not a JSON object");
  const Json& found = member(root_, "version", "the profile");
  if (found != version) {
    refuse("its version is " + found.dump() + ", this program reads version " +
           std::to_string(version) + ": make it anew with scripts/calibrate");
  }
}

void ProfileFile::refuse(const std::string& problem) const {
  throw vp::InputError("profile '" + path_.string() + "': " + problem);
}

const ProfileFile::Json& ProfileFile::member(const Json& object, const std::string& key,
                                             const std::string& where) const {
  const auto found = object.find(key);
  if (found == object.end()) refuse("'" + key + "' of " + where + " is missing");
  return *found;
}

const ProfileFile::Json& ProfileFile::object(const Json& object, const std::string& key,
                                             const std::string& where) const {
  const Json& found = member(object, key, where);
  if (!found.is_object()) refuse("'" + key + "' of " + where + " is not an object");
  return found;
}

std::string ProfileFile::text(const Json& object, const std::string& key,
                              const std::string& where) const {
  const Json& found = member(object, key, where);
  if (!found.is_string() || found.get<std::string>().empty()) {
    refuse("'" + key + "' of " + where + " is not a text");
  }
  return found.get<std::string>();
}

double ProfileFile::number(const Json& object, const std::string& key, const std::string& where,
                           double min, double max) const {
  const Json& found = member(object, key, where);
  if (!found.is_number()) refuse("'" + key + "' of " + where + " is not a number");
  const double value = found.get<double>();
  if (!std::isfinite(value) || value < min || value > max) {
    refuse("'" + key + "' of " + where + " is " + written(value) + ": give a number from " +
           written(min) + " to " + written(max));
  }
  return value;
}

void ProfileFile::only(const Json& object, const std::set<std::string>& known,
                       const std::string& where) const {
  for (const auto& [key, value] : object.items()) {
    if (known.count(key) != 0) continue;
    const std::string nearest =
        vp::nearest_match(key, std::vector<std::string>(known.begin(), known.end()));
    refuse("'" + key + "' of " + where + " is unknown" +
           (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
  }
}

}  // namespace platform::profiles

#include <algorithm>
#include <cmath>

#include <device/device.h>
#include <host/document.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::device {

namespace {

using Json = nlohmann::ordered_json;
using Owner = FigureInfo::Owner;

constexpr int version = 1;

/// The file, with the errors that its reader finds. It has the figures of the family, those of each
/// speed grade, and those of each part with the grades in which it is sold.
class DeviceFile {
 public:
  explicit DeviceFile(const std::filesystem::path& path) : path_(path) {
    root_ = host::read_json<Json>(path, "device file");
    if (!root_.is_object()) refuse("it is not a JSON object");
    only(root_, {"version", "family", "grades", "parts"}, "the file");
    const Json& found = member(root_, "version", "the file");
    if (found != version) {
      refuse("its version is " + found.dump() + ", this program reads version " +
             std::to_string(version));
    }
  }

  std::vector<Device> devices() const {
    Device family;
    read(object(root_, "family", "the file"), Owner::family, "family", family);
    const Json& grades = object(root_, "grades", "the file");
    std::vector<Device> all;
    for (const auto& [name, json] : object(root_, "parts", "the file").items()) {
      const std::string where = "part '" + name + "'";
      Device part = family;
      part.part = name;
      read(json, Owner::part, where, part);
      const Json& sold = member(json, "grades", where);
      if (!sold.is_array() || sold.empty()) refuse("'grades' of " + where + " is not a list");
      for (const Json& grade : sold) {
        if (!grade.is_string()) refuse("a grade of " + where + " is not a text");
        Device device = part;
        device.grade = grade;
        read(object(grades, device.grade, "'grades'"), Owner::grade, "grade '" + device.grade + "'",
             device);
        check(device);
        all.push_back(std::move(device));
      }
    }
    return all;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw vp::InputError("device file '" + path_.string() + "': " + problem);
  }

  /// Takes all figures of an owner.
  void read(const Json& json, Owner owner, const std::string& where, Device& device) const {
    if (!json.is_object()) refuse(where + " is not an object");
    std::vector<std::string> known;
    if (owner == Owner::part) known.emplace_back("grades");
    for (const FigureInfo& info : figures()) {
      if (info.owner == owner) known.emplace_back(info.name);
    }
    only(json, known, where);
    for (const FigureInfo& info : figures()) {
      if (info.owner != owner) continue;
      device.*info.figure = figure(member(json, info.name, where), info,
                                   "'" + std::string(info.name) + "' of " + where);
    }
  }

  Figure figure(const Json& json, const FigureInfo& info, const std::string& where) const {
    if (!json.is_object()) refuse(where + " is not an object");
    only(json, {"value", "confidence", "source"}, where);
    Figure figure;
    const Json& value = member(json, "value", where);
    if (!value.is_number()) refuse("'value' of " + where + " is not a number");
    figure.value = value.get<double>();
    if (!std::isfinite(figure.value) || figure.value < info.least || figure.value > info.most ||
        (info.whole && figure.value != std::floor(figure.value))) {
      refuse(where + " is " + value.dump() + ": give a " + (info.whole ? "whole " : "") +
             "number from " + Json(info.least).dump() + " to " + Json(info.most).dump());
    }
    figure.confidence = confidence(text(json, "confidence", where), where);
    figure.source = text(json, "source", where);
    return figure;
  }

  Confidence confidence(const std::string& name, const std::string& where) const {
    std::vector<std::string> names;
    for (const Confidence c : {Confidence::published, Confidence::derived, Confidence::assumed}) {
      if (name == to_string(c)) return c;
      names.emplace_back(to_string(c));
    }
    refuse("'confidence' of " + where + " is '" + name + "': give " + vp::one_of(names));
  }

  /// What only shows when all figures are there.
  void check(const Device& device) const {
    const auto ordered = [&](const Figure& least, const Figure& most, const char* what) {
      if (least.value > most.value) {
        refuse(std::string(what) + " of " + device.name() + " are not in order: the least is " +
               Json(least.value).dump() + ", the most " + Json(most.value).dump());
      }
    };
    ordered(device.crystal_min_mhz, device.crystal_max_mhz, "crystals");
    ordered(device.pll_feedback_min, device.pll_feedback_max, "feedback dividers");
    ordered(device.vco_min_mhz, device.vco_max_mhz, "PLL outputs");
  }

  const Json& member(const Json& json, const std::string& key, const std::string& where) const {
    const auto found = json.find(key);
    if (found == json.end()) refuse("'" + key + "' of " + where + " is missing");
    return *found;
  }

  const Json& object(const Json& json, const std::string& key, const std::string& where) const {
    const Json& found = member(json, key, where);
    if (!found.is_object()) refuse("'" + key + "' of " + where + " is not an object");
    return found;
  }

  std::string text(const Json& json, const std::string& key, const std::string& where) const {
    const Json& found = member(json, key, where);
    if (!found.is_string() || found.get<std::string>().empty()) {
      refuse("'" + key + "' of " + where + " is not a text");
    }
    return found.get<std::string>();
  }

  void only(const Json& json, const std::vector<std::string>& known,
            const std::string& where) const {
    for (const auto& [key, value] : json.items()) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      const std::string nearest = vp::nearest_match(key, known);
      refuse("'" + key + "' of " + where + " is unknown" +
             (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
    }
  }

  std::filesystem::path path_;
  Json root_;
};

}  // namespace

std::vector<Device> read_devices(const std::filesystem::path& file) {
  return DeviceFile(file).devices();
}

}  // namespace platform::device

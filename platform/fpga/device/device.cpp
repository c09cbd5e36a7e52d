#include <fpga/device/device.h>

#include <algorithm>
#include <cmath>

#include <host/document.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::device {

namespace {

namespace fs = std::filesystem;

fs::path& first_folder() {
  static fs::path folder;
  return folder;
}

std::vector<Device> installed_devices() {
  std::vector<Device> all;
  std::string searched;
  std::vector<fs::path> folders;
  if (!first_folder().empty()) folders.push_back(first_folder());
  for (const std::string& library : host::library_folders())
    folders.push_back(fs::path(library) / "devices");
  for (const fs::path& folder : folders) {
    if (searched.empty()) searched = folder.string();
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() != ".json") continue;
      for (Device& device : read_devices(entry.path())) all.push_back(std::move(device));
    }
    if (!all.empty()) break;  // the first folder that has any, as for other data
  }
  if (all.empty()) {
    throw vp::InputError("no devices are installed in " + searched +
                         "; install markervp completely");
  }
  std::sort(all.begin(), all.end(),
            [](const Device& a, const Device& b) { return a.name() < b.name(); });
  return all;
}

}  // namespace

bool look_in(const fs::path& folder) {
  first_folder() = folder;
  return true;
}

const char* to_string(Confidence confidence) {
  switch (confidence) {
    case Confidence::published:
      return "published";
    case Confidence::derived:
      return "derived";
    case Confidence::assumed:
      return "assumed";
  }
  return "";
}

// UG585 appendix B.28: manufacturer, family, and the code of the device between them.
std::uint32_t Device::idcode() const {
  return 0x0372'0093 | static_cast<std::uint32_t>(device_code.value) << 12;
}

const std::vector<FigureInfo>& figures() {
  using Owner = FigureInfo::Owner;
  static const std::vector<FigureInfo> all = {
      {"lut", "", "look-up tables", Owner::part, &Device::lut, 1, 1e7, true},
      {"ff", "", "flip-flops", Owner::part, &Device::ff, 1, 1e7, true},
      {"bram36", "", "block memories of 36 kbit", Owner::part, &Device::bram36, 1, 1e5, true},
      {"dsp", "", "DSP48 slices", Owner::part, &Device::dsp, 1, 1e5, true},
      {"cores", "", "Cortex-A9 cores", Owner::part, &Device::cores, 1, 2, true},
      {"static_w", "W", "static power at a junction of 25 C", Owner::part, &Device::static_w, 0.001,
       100},
      {"device_code", "", "bits 12 to 16 of IDCODE", Owner::part, &Device::device_code, 0, 31,
       true},
      {"cpu_621_mhz", "MHz", "highest CPU clock, ratio 6:2:1", Owner::grade, &Device::cpu_621_mhz,
       1, 10'000},
      {"cpu_421_mhz", "MHz", "highest CPU clock, ratio 4:2:1", Owner::grade, &Device::cpu_421_mhz,
       1, 10'000},
      {"ddr_mhz", "MHz", "highest memory clock, DDR3 or DDR3L", Owner::grade, &Device::ddr_mhz, 1,
       10'000},
      {"fclk_mhz", "MHz", "highest clock to the PL", Owner::grade, &Device::fclk_mhz, 1, 10'000},
      {"clock_buffer_mhz", "MHz", "highest clock from a pin", Owner::grade,
       &Device::clock_buffer_mhz, 1, 10'000},
      {"vco_max_mhz", "MHz", "highest output of a PLL", Owner::grade, &Device::vco_max_mhz, 1,
       10'000},
      {"fmax_factor", "", "Fmax of logic over that of grade -1", Owner::grade, &Device::fmax_factor,
       0.1, 10},
      {"crystal_min_mhz", "MHz", "lowest PS_CLK", Owner::family, &Device::crystal_min_mhz, 1,
       1'000},
      {"crystal_max_mhz", "MHz", "highest PS_CLK", Owner::family, &Device::crystal_max_mhz, 1,
       1'000},
      {"pll_feedback_min", "", "least feedback divider of a PLL", Owner::family,
       &Device::pll_feedback_min, 1, 127, true},
      {"pll_feedback_max", "", "largest feedback divider of a PLL", Owner::family,
       &Device::pll_feedback_max, 1, 127, true},
      {"vco_min_mhz", "MHz", "lowest output of a PLL", Owner::family, &Device::vco_min_mhz, 1,
       10'000},
      {"divisor_max", "", "largest divisor behind a PLL", Owner::family, &Device::divisor_max, 1,
       63, true},
  };
  return all;
}

const std::vector<Device>& devices() {
  static const std::vector<Device> all = installed_devices();
  return all;
}

const Device& find_device(const std::string& name) {
  const std::string wanted = vp::lower(name);
  std::vector<std::string> names;
  for (const Device& device : devices()) {  // the slowest grade of a part comes first
    if (wanted == device.name() || wanted == device.part) return device;
    names.push_back(device.name());
  }
  const std::string nearest = vp::nearest_match(wanted, names);
  throw vp::InputError("unknown device '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "there are " + vp::join(names, ", "));
}

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

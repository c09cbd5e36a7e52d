#include <chip/run/cost_profile.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <host/document.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <nlohmann/json.hpp>

namespace platform::profiles {

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> all = {
      {"application", {"frames"}},
      {"interrupt", {"interrupts"}},
      {"receive", {"words_received"}},
      {"decode", {"packets_decoded", "boxes_decoded"}},
      {"evaluation",
       {"corner_tests", "box_tests", "corners_inside", "quadrant_tests", "score_evaluations",
        "quads_checked", "corners_freed", "blobs_evaluated", "candidates"}},
      {"identification",
       {"homographies", "grid_samples", "grid_samples_dma", "cells", "rotations",
        "dictionary_compares"}},
      {"pose", {"poses", "posit_iterations"}},
      {"corner_detection",
       {"corner_frames", "corner_rows", "corner_pixels", "corner_survivors", "corner_bright",
        "corner_points", "corners_found"}},
      {"threshold", {"threshold_frames", "threshold_pixels"}},
      {"blob_check", {"blobs_checked", "quads_spanned", "hulls_tested"}},
      {"quad_fit",
       {"quads_fitted", "quads_refined", "fit_passes", "side_fits", "corners_met", "crossings",
        "crossings_dma", "strips", "level_reads", "level_pixels", "transitions", "points_refitted",
        "lens_steps"}},
      {"code_reading",
       {"codes_read", "code_cells", "code_cells_dma", "code_parts", "code_compares", "code_turns"}},
      {"board_pose", {"board_poses", "pose_steps", "markers_weighted", "marker_weighings"}},
      {"pose_filter", {"tracks_begun", "poses_predicted", "poses_weighed", "poses_corrected"}},
      {"lit_fit",
       {"lit_fits", "lit_corners", "lit_passes", "lit_side_fits", "lit_crossings", "lit_strips",
        "lit_level_reads", "lit_level_pixels", "lit_transitions", "lit_refitted", "lens_bends",
        "lens_angles", "lens_radii", "lens_tangents"}},
      {"inner_edges",
       {"inner_cells", "inner_edges", "inner_strips", "inner_pixels", "inner_blurs"}},
      {"response", {"curves_made"}},
      {"outline",
       {"outlines", "outline_samples", "outline_looks", "outline_points", "outline_distances",
        "outline_fitted", "outline_meets", "outline_covers"}},
      {"packet_sum", {"packets_summed", "words_summed"}},
      {"local_blobs", {"local_frames", "local_rows", "local_pixels", "local_runs", "local_joins"}},
      {"blob_detection",
       {"blob_frames", "blob_rows", "blob_pixels", "blob_dark", "blob_runs", "blob_rivals",
        "blob_labels", "blob_label_checks", "blobs_ended"}},
  };
  return all;
}

std::string kernel_of(const std::string& unit) {
  for (const Kernel& kernel : kernels()) {
    for (const std::string& name : kernel.units) {
      if (name == unit) return kernel.name;
    }
  }
  return "";
}

/// A JSON file whose errors name the file and the entry.
class ProfileFile {
 public:
  using Json = nlohmann::json;

  /// Throws vp::InputError if it cannot be read or is not a JSON object of this version.
  explicit ProfileFile(const std::filesystem::path& path);

  const Json& root() const { return *root_; }
  const std::filesystem::path& path() const { return path_; }

  /// Throws vp::InputError: "profile FILE: problem".
  [[noreturn]] void refuse(const std::string& problem) const;

  /// A member of an object; `where` is the object in words, for the message.
  const Json& member(const Json& object, const std::string& key, const std::string& where) const;
  const Json& object(const Json& object, const std::string& key, const std::string& where) const;
  std::string text(const Json& object, const std::string& key, const std::string& where) const;
  /// From `min` to `max`.
  double number(const Json& object, const std::string& key, const std::string& where, double min,
                double max) const;
  /// Throws if `object` has a key that is not one of `known`, with the nearest of them.
  void only(const Json& object, const std::set<std::string>& known, const std::string& where) const;

 private:
  std::filesystem::path path_;
  std::shared_ptr<const Json> root_;
};

namespace {

constexpr int version = 1;

/// As short as it reads back.
std::string written(double value) {
  return nlohmann::json(value).dump();
}

}  // namespace

ProfileFile::ProfileFile(const std::filesystem::path& path) : path_(path) {
  static host::KeptDocuments<Json> read;
  const std::string what = "profile";
  root_ = read.get(path, vp::read_text(path, what), [&](const std::string& text) {
    return host::parse_json<Json>(text, what + " '" + path.string() + "'");
  });
  if (!root().is_object()) refuse("it is not a JSON object");
  const Json& found = member(root(), "version", "the profile");
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

namespace {

namespace fs = std::filesystem;
using Json = ProfileFile::Json;

// A unit is a few statements; the largest, a pose or a whole frame's set-up, is some 10⁵ cycles.
constexpr double most_cycles = 1e7, most_stall_ns = 1e6;
// Two compilers and two programmers differ by less.
constexpr double least_scale = 0.1, most_scale = 10;
constexpr double least_code_scale = 0.01, most_code_scale = 100;

const char* name_of(Optimisation optimisation) {
  return optimisation == Optimisation::o0 ? "O0" : "O2";
}

/// Where installed profiles may be.
std::vector<fs::path> profile_folders() {
  std::vector<fs::path> folders;
  for (const std::string& folder : host::library_folders()) {
    folders.push_back(fs::path(folder) / "profiles");
  }
  return folders;
}

std::vector<std::string> installed_profiles() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::path& folder : profile_folders()) {
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path profile_path(const std::string& name) {
  if (fs::path(name).extension() == ".json") return name;
  std::error_code ignored;
  for (const fs::path& folder : profile_folders()) {
    fs::path file = folder / (name + ".json");
    if (fs::exists(file, ignored)) return file;
  }
  const std::vector<std::string> names = installed_profiles();
  if (names.empty()) {
    throw vp::InputError("no profile '" + name + "': none are installed in " +
                         profile_folders().front().string() + "; install markervp completely");
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("no profile '" + name + "'" +
                       (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") + ": give " +
                       vp::one_of(names) + ", or a file that ends in .json");
}

void read_units(const ProfileFile& file, const Json& units, const std::vector<std::string>& names,
                const std::string& where, ps::CostTable& costs) {
  for (const std::string& name : names) {
    const Json& unit = file.object(units, name, where);
    const std::string here = "unit '" + name + "' of " + where;
    file.only(unit, {"cycles", "stall_ns", "instructions"}, here);
    costs.set(name, {file.number(unit, "cycles", here, 0, most_cycles),
                     file.number(unit, "stall_ns", here, 0, most_stall_ns)});
  }
}

/// Units of programs that are not ours.
void read_other_units(const ProfileFile& file, ps::CostTable& costs) {
  const Json& root = file.root();
  if (root.find("other_units") == root.end()) return;
  const Json& units = file.object(root, "other_units", "the profile");
  std::vector<std::string> names;
  for (const auto& [name, cost] : units.items()) {
    if (!kernel_of(name).empty()) {
      file.refuse("unit '" + name + "' in other_units belongs to kernel '" + kernel_of(name) + "'");
    }
    names.push_back(name);
  }
  read_units(file, units, names, "other_units", costs);
}

void check_optimisation(const ProfileFile& file, std::optional<Optimisation> optimisation) {
  const std::string built = file.text(file.root(), "optimisation", "the profile");
  if (optimisation && built != name_of(*optimisation)) {
    file.refuse("it is for code compiled with -" + built + ", and sw.opt asks for " +
                name_of(*optimisation));
  }
}

CostProfile read_cost_table(const ProfileFile& file, std::optional<Optimisation> optimisation) {
  const Json& root = file.root();
  file.only(root,
            {"version", "profile", "optimisation", "origin", "date", "measured_digest", "kernels",
             "other_units", "memory", "code_scale"},
            "the profile");
  check_optimisation(file, optimisation);
  CostProfile profile{ps::CostTable(file.text(root, "profile", "the profile")),
                      file.text(root, "origin", "the profile"),
                      file.text(root, "date", "the profile"),
                      {}};
  const Json& all = file.object(root, "kernels", "the profile");
  std::set<std::string> names;
  for (const Kernel& kernel : kernels()) names.insert(kernel.name);
  file.only(all, names, "kernels");
  for (const Kernel& kernel : kernels()) {
    const Json& entry = file.object(all, kernel.name, "kernels");
    const std::string where = "kernel '" + kernel.name + "'";
    file.only(entry, {"source", "cycles_per_instruction", "leave_one_out_percent", "units"}, where);
    const Json& units = file.object(entry, "units", where);
    file.only(units, {kernel.units.begin(), kernel.units.end()}, where);
    read_units(file, units, kernel.units, where, profile.costs);
  }
  read_other_units(file, profile.costs);
  if (root.find("code_scale") != root.end())
    profile.costs.scale_code(
        file.number(root, "code_scale", "the profile", least_code_scale, most_code_scale));
  return profile;
}

/// A constant may hold for the table of one optimisation alone; the other is then taken as it is.
bool holds_for(const ProfileFile& file, const Json& entry, const std::string& where,
               Optimisation optimisation) {
  if (!entry.is_object()) file.refuse(where + " is not an object");
  if (entry.find("optimisation") == entry.end()) return true;
  const std::string only = file.text(entry, "optimisation", where);
  if (only != name_of(Optimisation::o0) && only != name_of(Optimisation::o2)) {
    file.refuse("'optimisation' of " + where + " is '" + only + "': give O0 or O2");
  }
  return only == name_of(optimisation);
}

FittedConstant read_constant(const ProfileFile& file, const Json& entry, const std::string& where,
                             ps::CostTable& costs) {
  FittedConstant constant;
  const Json& published = file.member(entry, "published", where);
  if (!published.is_array() || published.empty()) {
    file.refuse("'published' of " + where + " is not a list of published values");
  }
  for (const Json& id : published) {
    if (!id.is_string()) file.refuse("'published' of " + where + " has an entry that is no text");
    constant.published.push_back(id.get<std::string>());
  }
  if (entry.find("kernel") != entry.end()) {
    file.only(entry, {"kernel", "optimisation", "scale", "published", "note"}, where);
    const std::string name = file.text(entry, "kernel", where);
    const auto& all = kernels();
    const auto kernel =
        std::find_if(all.begin(), all.end(), [&](const Kernel& k) { return k.name == name; });
    if (kernel == all.end()) file.refuse("kernel '" + name + "' of " + where + " is unknown");
    constant.name = "scale of " + name;
    constant.value = file.number(entry, "scale", where, least_scale, most_scale);
    for (const std::string& unit : kernel->units) {
      const ps::WorkCost cost = costs.entries().at(unit);
      costs.set(unit, {cost.cycles * constant.value, cost.stall_ns * constant.value});
    }
    return constant;
  }
  file.only(entry, {"unit", "optimisation", "stall_ns", "published", "note"}, where);
  const std::string unit = file.text(entry, "unit", where);
  if (kernel_of(unit).empty()) file.refuse("unit '" + unit + "' of " + where + " is unknown");
  constant.name = "stall of " + unit;
  constant.value = file.number(entry, "stall_ns", where, 0, most_stall_ns);
  costs.set(unit, {costs.entries().at(unit).cycles, constant.value});
  return constant;
}

CostProfile read_scaled(const ProfileFile& file, Optimisation optimisation) {
  const Json& root = file.root();
  file.only(root, {"version", "profile", "origin", "date", "tables", "fitted"}, "the profile");
  const Json& tables = file.object(root, "tables", "the profile");
  file.only(tables, {"O0", "O2"}, "tables");
  const std::string table = file.text(tables, name_of(optimisation), "tables");
  const CostProfile base =
      read_cost_table(ProfileFile(file.path().parent_path() / (table + ".json")), optimisation);
  const std::string name = file.text(root, "profile", "the profile");
  CostProfile profile{ps::CostTable(optimisation == Optimisation::o0 ? name : name + "-O2"),
                      file.text(root, "origin", "the profile"),
                      file.text(root, "date", "the profile"),
                      {}};
  for (const auto& [unit, cost] : base.costs.entries()) profile.costs.set(unit, cost);
  profile.costs.scale_code(base.costs.code_scale());
  const Json& fitted = file.member(root, "fitted", "the profile");
  if (!fitted.is_array()) file.refuse("'fitted' is not a list");
  if (fitted.size() > max_fitted) {
    file.refuse("it fits " + std::to_string(fitted.size()) + " constants, more than " +
                std::to_string(max_fitted));
  }
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const Json& entry = fitted[i];
    const std::string where = "fitted constant " + std::to_string(i + 1);
    if (!holds_for(file, entry, where, optimisation)) continue;
    FittedConstant constant = read_constant(file, entry, where, profile.costs);
    for (const FittedConstant& other : profile.fitted) {
      if (other.name == constant.name) file.refuse("the " + constant.name + " is fitted twice");
    }
    profile.fitted.push_back(std::move(constant));
  }
  return profile;
}

}  // namespace

Optimisation optimisation_of(const std::string& name) {
  const ProfileFile file(profile_path(name));
  const auto built = file.root().find("optimisation");
  const bool is_o2 = built != file.root().end() && *built == name_of(Optimisation::o2);
  return is_o2 ? Optimisation::o2 : Optimisation::o0;
}

bool holds_for_both(const std::string& name) {
  const ProfileFile file(profile_path(name));
  return file.root().find("tables") != file.root().end();
}

CostProfile load_cost_profile(const std::string& name, std::optional<Optimisation> optimisation) {
  const ProfileFile file(profile_path(name));
  if (file.root().find("tables") == file.root().end()) return read_cost_table(file, optimisation);
  return read_scaled(file, optimisation.value_or(Optimisation::o0));
}

void check_cost_profile(const std::string& name, std::optional<Optimisation> optimisation) {
  const ProfileFile file(profile_path(name));
  if (file.root().find("tables") == file.root().end()) check_optimisation(file, optimisation);
}

}  // namespace platform::profiles

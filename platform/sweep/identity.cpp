#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include <host/document.h>
#include <host/process.h>
#include <input/camera_file.h>
#include <input/frame_source.h>
#include <scene/scene.h>
#include <sweep/identity.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::sweep {

namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), sha_256(), nullptr) == 1);
  }

  void add(std::string_view bytes) {
    check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }

  std::string digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[bytes[i] >> 4];
      text += "0123456789abcdef"[bytes[i] & 15];
    }
    return text;
  }

 private:
  /// Looked up once: EVP_sha256() is, for each digest.
  static const EVP_MD* sha_256() {
    static const std::unique_ptr<EVP_MD, decltype(&EVP_MD_free)> found(
        EVP_MD_fetch(nullptr, "SHA256", nullptr), EVP_MD_free);
    check(found != nullptr);
    return found.get();
  }

  static void check(bool ok) {
    if (!ok) throw std::runtime_error("SHA-256 is not available");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string content_hash(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.digits();
}

std::string file_hash(const std::string& path) {
  vp::InputFile file(path, "file");
  // What is hashed is read once more, to be used.
  if (!file.is_regular())
    throw vp::InputError("'" + path + "' is a pipe, which can be read only once: name a file");
  const auto deadline = vp::InputFile::HostClock::now() + vp::InputFile::patience;
  Digest digest;
  std::array<char, 1 << 16> block;
  while (const std::size_t count = file.read(block.data(), block.size(), deadline))
    digest.add({block.data(), count});
  return digest.digits();
}

namespace {

namespace fs = std::filesystem;

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Parts of an installation that are no data tables.
bool is_table(const fs::path& relative) {
  const std::string first = relative.begin()->string();
  return first != "programs" && first != "studies" && relative.has_parent_path() &&
         relative.extension() != ".so";
}

Json scene_json(const Scene& scene) {
  Json json;
  json["marker"] = scene.marker_id;
  json["camera"] = {scene.camera.fx, scene.camera.fy, scene.camera.cx, scene.camera.cy};
  json["rotation"] = Json::array();
  for (const auto& row : scene.pose.rotation.rowwise()) {
    json["rotation"].push_back(std::vector<double>(row.begin(), row.end()));
  }
  json["translation"] =
      std::vector<double>(scene.pose.translation.begin(), scene.pose.translation.end());
  json["squares"] = Json::array();
  for (const Square& square : scene.squares)
    json["squares"].push_back({square.u, square.v, square.side, square.word});
  const Brightness& light = scene.brightness;
  json["brightness"] = {light.black, light.border,  light.wall,
                        light.floor, light.ceiling, light.side_walls};
  json["room"] = {scene.room.wall_w, scene.room.floor_v, scene.room.ceiling_v, scene.room.side_u};
  const Motion& motion = scene.motion;
  json["motion"] = {motion.velocity.x(), motion.velocity.y(), motion.velocity.z(),
                    motion.spin_deg_per_s, scene.time_s};
  json["shutter"] = {scene.shutter.exposure_s, scene.shutter.readout_s};
  json["vignetting"] = scene.vignetting;
  json["noise"] = scene.noise_sigma;
  json["blur"] = scene.blur_sigma_px;
  json["seed"] = scene.seed;
  return json;
}

input::InputOptions options_of(const InputChoice& choice, input::ImageSize size) {
  input::InputOptions options;
  options.size = size;
  if (choice.fit) options.fit = *choice.fit == "crop" ? input::Fit::crop : input::Fit::scale;
  if (choice.camera) options.camera = input::read_camera_file(*choice.camera);
  return options;
}

/// The tables that a scaled cost profile refers to stand beside it.
void add_named_tables(const fs::path& file, Json& contents) {
  if (file.extension() != ".json") return;
  const Json root = host::read_json<Json>(file, "profile");
  if (!root.is_object() || !root.contains("tables") || !root["tables"].is_object()) return;
  for (const auto& [unused, name] : root["tables"].items()) {
    if (!name.is_string()) continue;
    const fs::path table = file.parent_path() / (name.get<std::string>() + ".json");
    std::error_code ignored;
    if (fs::is_regular_file(table, ignored))
      contents[table.filename().string()] = file_hash(table.string());
  }
}

}  // namespace

Json program_identity(const std::string& version, const std::string& revision) {
  Json json;
  json["version"] = version;
  json["revision"] = revision;
  if (revision.empty() || ends_with(revision, "-dirty"))
    json["executable"] = file_hash("/proc/self/exe");
  return json;
}

Json table_contents() {
  Json json = Json::object();
  std::error_code ignored;
  for (const std::string& folder : host::library_folders()) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
      const fs::path relative = entry.path().lexically_relative(folder);
      if (entry.is_regular_file(ignored) && is_table(relative)) files.push_back(relative);
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      json[file.generic_string()] = file_hash((fs::path(folder) / file).string());
    if (!files.empty()) break;
  }
  return json;
}

Json file_contents(const std::string& program_file,
                   const std::map<std::string, std::string>& configuration) {
  Json json;
  json["program"] = fs::path(program_file).stem().string();
  json["program_file"] = program_file.empty() ? "" : file_hash(program_file);
  json["files"] = Json::object();
  for (const auto& [path, value] : configuration) {
    std::error_code ignored;
    if (fs::path(value).extension().empty() || !fs::is_regular_file(value, ignored)) continue;
    json["files"][path] = file_hash(value);
    add_named_tables(value, json["files"]);
  }
  return json;
}

Json input_contents(const std::vector<std::string>& inputs, const InputChoice& choice,
                    input::ImageSize size) {
  const input::InputOptions options = options_of(choice, size);
  const std::vector<std::string> asked = inputs.empty() ? std::vector<std::string>{"demo"} : inputs;
  Json json = Json::array();
  for (const input::InputItem& item : input::list_inputs(asked, options)) {
    Json entry;
    entry["name"] = item.name;
    if (item.kind == input::InputItem::Kind::scene) {
      const Scene scene = make_scene(item.source, camera_of(options, size));
      entry["scene"] = content_hash(scene_json(scene).dump());
    } else {
      entry["file"] = file_hash(item.source);
    }
    json.push_back(entry);
  }
  if (choice.camera) json.push_back({{"camera", file_hash(*choice.camera)}});
  return json;
}

}  // namespace platform::sweep

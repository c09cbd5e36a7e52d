#include <study/named_point.h>

#include <filesystem>
#include <utility>

#include <study/kept_result.h>
#include <vp/error.h>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

/// Folder and key; the key is empty for a text that is no name.
std::pair<std::string, std::string> parts_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos && colon != 0 && is_key(text.substr(colon + 1)))
    return {text.substr(0, colon), text.substr(colon + 1)};
  const fs::path file(text);
  const std::string key = file.stem().string();
  if (file.extension() != ".json" || file.parent_path().filename() != "points" || !is_key(key))
    return {};
  const fs::path folder = file.parent_path().parent_path();
  return {folder.empty() ? "." : folder.string(), key};
}

NamedPoint kept_point(const std::string& file) {
  KeptResult kept = read_kept(file);
  const fs::path folder = fs::path(file).parent_path().parent_path();
  const Json identity = kept.identity_json();
  return {file,
          folder.empty() ? "." : folder.string(),
          kept.key,
          {std::move(kept.setup), identity.at("markervp")},
          kept.outcome.failed,
          kept.outcome.failure.message,
          std::move(kept.result),
          identity.at("configuration").get<std::map<std::string, std::string>>()};
}

}  // namespace

bool names_point(const std::string& text) {
  return !parts_of(text).second.empty();
}

NamedPoint named_point(const std::string& text) {
  std::error_code ignored;
  if (fs::exists(text, ignored)) return kept_point(text);
  const auto [folder, key] = parts_of(text);
  if (key.empty())
    throw vp::InputError("'" + text +
                         "' names no point of a sweep: name it as out/NAME:KEY, with a key of " +
                         "out/NAME/points.csv");
  if (!fs::is_directory(fs::path(folder) / "runs", ignored))
    throw vp::InputError("'" + folder + "' is no folder of a sweep");
  const Store store(folder);
  if (fs::exists(store.kept_path(key), ignored)) return kept_point(store.kept_path(key));
  const Shards shards(store);
  std::optional<AskedPoint> asked = shards.asked(key);
  if (!asked) throw vp::InputError("'" + folder + "' has no result of a point " + key);
  const Outcome outcome = shards.outcome(key).value();
  return {text, folder, key, *std::move(asked), outcome.failed, outcome.failure.message, {}};
}

}  // namespace platform::study

#include <page/json_file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <vp/error.h>

namespace platform::page {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw vp::InputError("cannot read '" + path.string() + "': " + std::strerror(errno));
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

report::Json parse_json(const std::string& text, const std::filesystem::path& path) {
  try {
    return report::Json::parse(text);
  } catch (const report::Json::exception& error) {
    throw vp::InputError("'" + path.string() + "' is not whole JSON: " + error.what());
  }
}

report::Json parse_first(const std::filesystem::path& path, const std::string& list,
                         std::size_t count) {
  using Event = report::Json::parse_event_t;
  std::ifstream file(path, std::ios::binary);
  std::string key;
  std::size_t seen = 0;
  const auto keep = [&](int depth, Event event, const report::Json& value) {
    if (depth == 1 && event == Event::key) key = value.get<std::string>();
    if (depth != 2 || key != list) return true;
    if (event == Event::object_start) return seen < count;
    if (event == Event::object_end) ++seen;
    return true;
  };
  try {
    return report::Json::parse(file, keep);
  } catch (const report::Json::exception& error) {
    throw vp::InputError("'" + path.string() + "' is not whole JSON: " + error.what());
  }
}

}  // namespace platform::page

#include <page/json_file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <vp/error.h>

namespace platform::page {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw vp::InputError("cannot read '" + path.string() + "': " + std::strerror(errno));
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

report::Json parse_json(const std::string& text, const std::filesystem::path& path) {
  try {
    return report::Json::parse(text);
  } catch (const report::Json::exception& error) {
    throw vp::InputError("'" + path.string() + "' is not whole JSON: " + error.what());
  }
}

}  // namespace platform::page

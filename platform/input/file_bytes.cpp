#include <input/file_bytes.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <vp/error.h>

namespace platform::input {

namespace {

namespace fs = std::filesystem;

std::string kind_name(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
      return "a FIFO";
    case fs::file_type::socket:
      return "a socket";
    default:
      return "a device";
  }
}

}  // namespace

void require_regular_file(const std::string& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::not_found)
    error = make_error_code(std::errc::no_such_file_or_directory);
  if (error) throw vp::InputError("'" + path + "' cannot be read: " + error.message());
  if (type != fs::file_type::regular) {
    throw vp::InputError("'" + path + "' cannot be read: it is " + kind_name(type) +
                         ", and must be a file");
  }
}

std::vector<std::uint8_t> read_bytes(const std::string& path, std::uintmax_t limit) {
  require_regular_file(path);
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) throw vp::InputError("'" + path + "' cannot be read: " + std::strerror(errno));
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  std::vector<std::uint8_t> bytes(error ? 0 : static_cast<std::size_t>(std::min(size, limit)));
  const std::size_t read = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (error || read != bytes.size()) {
    const std::string why = error ? error.message() : std::string("it ends early");
    throw vp::InputError("'" + path + "' cannot be read: " + why);
  }
  if (bytes.empty()) throw vp::InputError("'" + path + "' is empty");
  return bytes;
}

}  // namespace platform::input

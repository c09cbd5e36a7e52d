#include <input/file_bytes.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <vp/error.h>

namespace platform::input {

std::vector<std::uint8_t> read_bytes(const std::string& path, std::uintmax_t limit) {
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) throw vp::InputError("'" + path + "' cannot be read: " + std::strerror(errno));
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
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

#include <marker/input/pgm_stream.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include <marker/input/image_file.h>

namespace platform::input {

namespace {

/// A header with its comments is no longer.
constexpr std::size_t header_bytes = 4096;

class PgmStream : public VideoStream {
 public:
  explicit PgmStream(const std::string& path) : path_(path), file_(path, std::ios::binary) {}

  std::optional<GreyImage> next() override {
    std::vector<std::uint8_t> bytes = read(header_bytes);
    if (bytes.empty()) return std::nullopt;
    const std::size_t size = pgm_bytes(bytes, path_);
    if (size > bytes.size()) {
      const std::vector<std::uint8_t> rest = read(size - bytes.size());
      bytes.insert(bytes.end(), rest.begin(), rest.end());
    }
    at_ += std::min(size, bytes.size());
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(at_));
    bytes.resize(std::min(size, bytes.size()));
    return decode_image(bytes, path_);
  }

  std::uint64_t promised_frames() const override { return 0; }

 private:
  std::vector<std::uint8_t> read(std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(file_.gcount()));
    return bytes;
  }

  std::string path_;
  std::ifstream file_;
  std::uint64_t at_ = 0;
};

}  // namespace

bool is_pgm_stream(const std::string& path) {
  const std::vector<std::uint8_t> beginning = read_bytes(path, header_bytes);
  if (announced_format(beginning) != ImageHeader::Format::pgm) return false;
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(pgm_bytes(beginning, path)));
  std::vector<std::uint8_t> second(format_bytes);
  file.read(reinterpret_cast<char*>(second.data()), static_cast<std::streamsize>(second.size()));
  second.resize(static_cast<std::size_t>(file.gcount()));
  return announced_format(second) == ImageHeader::Format::pgm;
}

std::unique_ptr<VideoStream> open_pgm_stream(const std::string& path) {
  return std::make_unique<PgmStream>(path);
}

}  // namespace platform::input

#include "gzip_source.h"

#include <vp/error.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

namespace vp {

namespace {

class GzipSource final : public ByteSource {
 public:
  GzipSource(std::unique_ptr<ByteSource> source, std::filesystem::path file,
             std::function<void(const std::string&)> note)
      : source_(std::move(source)), file_(std::move(file)), note_(std::move(note)) {}
  ~GzipSource() override {
    if (state_ == State::packed) inflateEnd(&stream_);
  }

  std::size_t read(char* to, std::size_t size) override {
    if (state_ == State::begin) look();
    if (state_ == State::plain) return read_plain(to, size);
    return state_ == State::over ? 0 : read_packed(to, size);
  }
  bool can_seek() const override { return state_ == State::plain && source_->can_seek(); }
  void seek(std::uint64_t offset) override {
    held_ = 0;
    source_->seek(offset);
  }

 private:
  enum class State : std::uint8_t { begin, plain, packed, over };
  static constexpr std::size_t buffer_size = 1 << 16;

  /// The first two bytes tell what it is.
  void look() {
    buffer_.resize(buffer_size);
    held_ = 0;
    for (std::size_t count = 1; held_ < 2 && count != 0; held_ += count)
      count = source_->read(buffer_.data() + held_, buffer_size - held_);
    const bool packed = held_ >= 2 && buffer_[0] == '\x1f' && buffer_[1] == '\x8b';
    state_ = State::plain;
    if (!packed) return;
    constexpr int gzip_only = 15 + 16;
    if (inflateInit2(&stream_, gzip_only) != Z_OK)
      throw InputError("trace '" + file_.string() + "': no memory to unpack it");
    state_ = State::packed;
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_in = static_cast<uInt>(held_);
  }
  std::size_t read_plain(char* to, std::size_t size) {
    if (held_ == 0) return source_->read(to, size);
    const std::size_t count = std::min(size, held_);
    std::memcpy(to, buffer_.data() + given_, count);
    given_ += count;
    held_ -= count;
    return count;
  }
  /// False: there are no more packed bytes.
  bool fill() {
    if (stream_.avail_in != 0) return true;
    const std::size_t count = source_->read(buffer_.data(), buffer_size);
    packed_bytes_ += count;
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_in = static_cast<uInt>(count);
    return count != 0;
  }
  std::size_t read_packed(char* to, std::size_t size) {
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = static_cast<uInt>(std::min<std::size_t>(size, 1U << 30U));
    const uInt wanted = stream_.avail_out;
    while (stream_.avail_out == wanted) {
      if (!fill()) {
        if (!between_) note_("was cut off: its gzip data have no end; everything before is read");
        end();
        break;
      }
      between_ = false;
      const int result = inflate(&stream_, Z_NO_FLUSH);
      if (result == Z_STREAM_END) {
        // Another stream may follow.
        between_ = true;
        inflateReset(&stream_);
      } else if (result != Z_OK && result != Z_BUF_ERROR) {
        fail();
      }
    }
    return wanted - stream_.avail_out;
  }
  [[noreturn]] void fail() {
    const std::string why = stream_.msg ? stream_.msg : "unknown";
    throw InputError("trace '" + file_.string() + "': its gzip data are damaged near byte " +
                     std::to_string(held_ + packed_bytes_ - stream_.avail_in) + " (" + why + ")");
  }
  void end() {
    inflateEnd(&stream_);
    state_ = State::over;
  }

  std::unique_ptr<ByteSource> source_;
  std::filesystem::path file_;
  std::function<void(const std::string&)> note_;
  State state_ = State::begin;
  std::vector<char> buffer_;
  std::size_t held_ = 0, given_ = 0;  ///< of the bytes that were looked at
  std::uint64_t packed_bytes_ = 0;    ///< behind them
  bool between_ = false;              ///< a stream has ended, and no other has begun
  z_stream stream_{};
};

}  // namespace

std::unique_ptr<ByteSource> unpacked(std::unique_ptr<ByteSource> source,
                                     const std::filesystem::path& file,
                                     std::function<void(const std::string&)> note) {
  return std::make_unique<GzipSource>(std::move(source), file, std::move(note));
}

}  // namespace vp

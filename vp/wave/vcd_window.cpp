#include <fcntl.h>
#include <unistd.h>
#include <vp/file.h>

#include <algorithm>
#include <cstring>

#include "wave_input.h"

// The bytes of a VCD.

namespace vp {

namespace {

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& file) : file_(file, "trace") {
    ::posix_fadvise(file_.descriptor(), 0, 0, POSIX_FADV_SEQUENTIAL);
  }

  std::size_t read(char* to, std::size_t size) override {
    return file_.read(to, size, InputFile::HostClock::now() + InputFile::patience);
  }

  bool can_seek() const override { return file_.is_regular(); }
  void seek(std::uint64_t offset) override {
    ::lseek(file_.descriptor(), static_cast<off_t>(offset), SEEK_SET);
  }

 private:
  InputFile file_;
};

}  // namespace

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& file) {
  return std::make_unique<FileSource>(file);
}

bool VcdWindow::refill(const char* from) {
  const auto unused = static_cast<std::size_t>(from - buffer_.data());
  const auto held = static_cast<std::size_t>(end_ - from);
  const bool only_blanks =
      held == 0 && unused == size && std::all_of(buffer_.data(), buffer_.data() + size, is_blank);
  if (held == size || only_blanks) {
    cursor = from;
    too_long_ = true;
    return false;
  }
  line(from);
  counted_ = buffer_.data();
  std::memmove(buffer_.data(), from, held);
  cursor = buffer_.data();
  end_ = buffer_.data() + held;
  std::size_t count = 0;
  const char* last = nullptr;
  do {
    count = source_->read(end_,
                          std::min(chunk_, size - static_cast<std::size_t>(end_ - buffer_.data())));
    chunk_ = std::min(size, chunk_ * 8);
    read_ += count;
    end_ += count;
    last = end_;
    while (last != cursor && !is_blank(last[-1])) --last;
    // A word, and what belongs to it, must come whole: read until there is another blank.
  } while (count != 0 && static_cast<std::size_t>(last - cursor) <= held &&
           end_ != buffer_.data() + size);
  std::memset(end_, ' ', padding);
  safe_ = last;
  return static_cast<std::size_t>(end_ - cursor) > held;
}

std::uint64_t VcdWindow::line(const char* at) const {
  if (at > counted_) {
    lines_ += static_cast<std::uint64_t>(std::count(counted_, at, '\n'));
    counted_ = at;
  }
  return lines_;
}

void VcdWindow::seek(std::uint64_t offset, std::uint64_t line) {
  source_->seek(offset);
  read_ = offset;
  cursor = safe_ = end_ = buffer_.data();
  counted_ = cursor;
  lines_ = line;
  chunk_ = smallest_chunk;
}

}  // namespace vp

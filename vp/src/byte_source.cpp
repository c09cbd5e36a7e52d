#include "byte_source.h"

#include <fcntl.h>
#include <unistd.h>
#include <vp/error.h>
#include <vp/wave_writer.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace vp {

namespace {

[[noreturn]] void cannot_read(const std::filesystem::path& file, int error) {
  throw InputError("cannot read trace '" + file.string() + "': " + std::strerror(error));
}

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& file)
      : file_(file), descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) cannot_read(file, errno);
    ::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_SEQUENTIAL);
  }
  ~FileSource() override { ::close(descriptor_); }
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  std::size_t read(char* to, std::size_t size) override {
    for (;;) {
      const ::ssize_t count = ::read(descriptor_, to, size);
      if (count >= 0) return static_cast<std::size_t>(count);
      if (errno != EINTR) cannot_read(file_, errno);
    }
  }

 private:
  std::filesystem::path file_;
  int descriptor_;
};

/// An FST begins with its header block, type 0, or is packed as a whole, type 254.
bool looks_like_fst(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  FileSource source(file);
  unsigned char first = 'x';
  return source.read(reinterpret_cast<char*>(&first), 1) == 1 && (first == 0 || first == 254);
}

}  // namespace

std::unique_ptr<ByteSource> open_byte_source(const std::filesystem::path& file) {
  if (!looks_like_fst(file)) return std::make_unique<FileSource>(file);
#ifdef MARKERVP_FST
  return open_fst_source(file);
#else
  throw InputError("trace '" + file.string() +
                   "' is an FST (or no trace at all), which this build cannot read; install "
                   "Debian's package verilator and build again, or convert it with fst2vcd");
#endif
}

}  // namespace vp

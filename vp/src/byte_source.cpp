#include "byte_source.h"

#include <fcntl.h>
#include <vp/error.h>
#include <vp/input_file.h>
#include <vp/wave_writer.h>

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

 private:
  InputFile file_;
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

#include <fcntl.h>
#include <fstapi.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vp/error.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

#include "byte_source.h"

namespace vp {

namespace {

[[noreturn]] void corrupt(const std::filesystem::path& file, const std::string& problem) {
  throw InputError("trace '" + file.string() + "': " + problem);
}

/// Every block says its length: the chain of them must end where the file ends.
void check_blocks(const std::filesystem::path& file) {
  constexpr unsigned last_block_type = 8, packed_type = 254, skipped_type = 255;
  const std::uint64_t size = std::filesystem::file_size(file);
  std::ifstream stream(file, std::ios::binary);
  for (std::uint64_t at = 0; at < size;) {
    unsigned char head[9] = {};
    stream.seekg(static_cast<std::streamoff>(at));
    stream.read(reinterpret_cast<char*>(head), sizeof head);
    const std::string place = " at byte " + std::to_string(at);
    if (!stream) corrupt(file, "truncated in the block" + place);
    if (head[0] > last_block_type && head[0] != packed_type && head[0] != skipped_type) {
      corrupt(file, "no FST block" + place + ": the file is corrupt, or no FST");
    }
    std::uint64_t length = 0;
    for (int i = 1; i < 9; ++i) length = length << 8 | head[i];
    if (length < 8 || length > size - at - 1) {
      corrupt(file, "the block" + place + " should be " + std::to_string(length) +
                        " bytes long, but " + std::to_string(size - at - 1) +
                        " follow: the file is truncated or corrupt");
    }
    at += 1 + length;
  }
}

/// In the process of its own: writes the VCD into `descriptor`.
[[noreturn]] void convert(const std::filesystem::path& file, int descriptor) {
  // A corrupt file may ask for any amount of time.
  constexpr rlim_t seconds_at_least = 60, bytes_per_second = 1'000'000;
  const auto seconds =
      static_cast<rlim_t>(seconds_at_least + std::filesystem::file_size(file) / bytes_per_second);
  const rlimit limit{seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &limit);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  const int null = ::open("/dev/null", O_WRONLY);
  ::dup2(null, STDERR_FILENO);
  ::dup2(null, STDOUT_FILENO);
  FILE* out = ::fdopen(descriptor, "w");
  void* reader = fstReaderOpen(file.c_str());
  if (!out || !reader) ::_exit(2);
  fstReaderSetVcdExtensions(reader, 1);
  if (!fstReaderProcessHier(reader, out)) ::_exit(3);
  fstReaderSetFacProcessMaskAll(reader);  // not before: the header's reading forgets it
  if (!fstReaderIterBlocks(reader, nullptr, nullptr, out)) ::_exit(4);
  std::fprintf(out, "#%llu\n", static_cast<unsigned long long>(fstReaderGetEndTime(reader)));
  ::_exit(std::fflush(out) == 0 ? 0 : 5);
}

class FstSource final : public ByteSource {
 public:
  explicit FstSource(const std::filesystem::path& file) : file_(file) {
    check_blocks(file);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) corrupt(file, std::strerror(errno));
    process_ = ::fork();
    if (process_ == 0) convert(file, ends[1]);
    ::close(ends[1]);
    descriptor_ = ends[0];
    if (process_ < 0) corrupt(file, std::strerror(errno));
  }
  ~FstSource() override {
    ::close(descriptor_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  FstSource(const FstSource&) = delete;
  FstSource& operator=(const FstSource&) = delete;

  std::size_t read(char* to, std::size_t size) override {
    for (;;) {
      const ::ssize_t count = ::read(descriptor_, to, size);
      if (count > 0) return static_cast<std::size_t>(count);
      if (count < 0 && errno == EINTR) continue;
      finish();
      return 0;
    }
  }
  bool has_lines() const override { return false; }

 private:
  void finish() {
    if (process_ <= 0) return;
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    corrupt(file_, "corrupt: its blocks are as long as they say (" +
                       std::to_string(std::filesystem::file_size(file_)) +
                       " bytes), but what is in them cannot be read");
  }

  std::filesystem::path file_;
  int descriptor_ = -1;
  pid_t process_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_fst_source(const std::filesystem::path& file) {
  return std::make_unique<FstSource>(file);
}

}  // namespace vp

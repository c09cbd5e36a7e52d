#include <marker/input/standard_input.h>

#include <unistd.h>

#include <algorithm>
#include <vector>

#include <host/guard.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::input {

namespace {

constexpr std::uint64_t most_input_bytes = std::uint64_t{4} << 30;
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;

/// Codecs look at a file more than once, and from both ends.
class KeptInput {
 public:
  KeptInput() {
    if (::isatty(STDIN_FILENO) != 0)
      throw vp::InputError(
          "input '-': nothing is sent to the standard input; write 'PROGRAM | "
          "markervp run -' or 'markervp run - < FILE'");
    vp::InputFile input("/dev/stdin", "input");
    vp::OutputFile output(path_);
    std::vector<char> bytes(chunk_bytes);
    std::uint64_t taken = 0;
    for (;;) {
      const auto deadline = vp::InputFile::HostClock::now() + vp::InputFile::patience;
      const std::size_t count = input.read(bytes.data(), bytes.size(), deadline);
      if (count == 0) break;
      taken += count;
      if (taken > most_input_bytes)
        throw vp::InputError("input '-' is larger than 4 GiB: send fewer pictures");
      output.write({bytes.data(), count});
    }
    if (taken == 0) throw vp::InputError("input '-' is empty");
    output.commit();
  }

  const std::string& path() const { return path_; }

 private:
  host::ScratchFolder folder_{"input"};
  std::string path_ = folder_ / standard_input_name;
};

}  // namespace

const std::string& standard_input_file() {
  static const KeptInput kept;
  return kept.path();
}

}  // namespace platform::input

#include <host/standard_streams.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <ostream>

#include <vp/output_file.h>

namespace platform::host {

namespace {

constexpr const char* standard_output = "standard output";

}  // namespace

void fill_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    // The lowest free number is the one that is missing.
    if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  }
}

void check_written(std::ostream& out) {
  if (!out.flush()) throw vp::OutputError(standard_output, errno);
}

// Closing a copy tells the same as closing the stream, which destructors may still want to write
// to.
void check_standard_output() {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  const int copy = written ? ::dup(STDOUT_FILENO) : -1;
  if (!written || (copy >= 0 && ::close(copy) != 0)) throw vp::OutputError(standard_output, errno);
}

}  // namespace platform::host

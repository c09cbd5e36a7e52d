#include <zynq/working_folder.h>

#include <fcntl.h>
#include <unistd.h>

namespace platform {

WorkingFolder::WorkingFolder() : descriptor_(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)) {}

WorkingFolder::~WorkingFolder() {
  restore();
  if (descriptor_ >= 0) ::close(descriptor_);
}

void WorkingFolder::restore() const {
  if (descriptor_ >= 0) static_cast<void>(!::fchdir(descriptor_));
}

}  // namespace platform

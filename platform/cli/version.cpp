#include <cli/version.h>

namespace platform::cli {

std::string program_version() {
  return MARKERVP_VERSION;
}

std::string source_revision() {
  return MARKERVP_REVISION;
}

std::string version_text() {
  const std::string revision = source_revision();
  return "markervp " + program_version() + (revision.empty() ? "" : " (" + revision + ")");
}

}  // namespace platform::cli

#pragma once

#include <string>

namespace platform::cli {

/// "0.1.0".
std::string program_version();
/// The state of the sources as git described it when the build was configured; may be empty.
std::string source_revision();
/// What --version prints.
std::string version_text();

}  // namespace platform::cli

#pragma once

#include <string>
#include <vector>

namespace platform::input {

/// Where the program's plug-ins are: `lib/markervp` beside the folder of the running executable, in
/// the build tree as where it is installed; the system's library folder name
/// (`lib/x86_64-linux-gnu`) is tried too.
std::vector<std::string> library_folders();

}  // namespace platform::input

#pragma once

#include <string>
#include <vector>

/// The machine that the program runs on, and where the program is installed on it.
namespace platform::host {

/// Its name; "unknown" if it has none.
std::string host_name();

/// Its time as results are dated: "2024-05-01T12:34:56Z".
std::string utc_now();

/// Where the program's plug-ins and data are: `lib/markervp` beside the folder of the running
/// executable, in the build tree as where it is installed; the system's library folder name
/// (`lib/x86_64-linux-gnu`) is tried too.
std::vector<std::string> library_folders();

}  // namespace platform::host

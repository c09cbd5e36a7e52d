#pragma once

#include <string>

namespace platform::report {

/// The host's time as results are dated: "2024-05-01T12:34:56Z".
std::string utc_now();

}  // namespace platform::report

#pragma once

#include <string>

namespace platform::sweep {

/// What `markervp run` said last, without its name.
std::string last_line(const std::string& text);

}  // namespace platform::sweep

#pragma once

#include <string>
#include <string_view>

namespace vp {

/// What to say of a shared object that dlopen() refused; `said` is the text of dlerror(). Continues
/// "cannot load program 'x.so': ".
std::string load_problem(const std::string& path, std::string_view said);

}  // namespace vp

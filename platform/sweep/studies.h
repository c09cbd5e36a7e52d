#pragma once

#include <string>
#include <vector>

namespace platform::sweep {

/// A sweep that comes with the program.
struct Study {
  std::string name;
  std::string title;
  std::string file;
};

/// All of them, by name.
std::vector<Study> studies();

/// The file of a sweep: `name` itself if it is one, or a study of that name. Throws vp::InputError
/// with the nearest name.
std::string sweep_file(const std::string& name);

}  // namespace platform::sweep

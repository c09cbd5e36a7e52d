#pragma once

#include <string>
#include <vector>

#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>

namespace platform {

/// The object of type T that a user names by its path, or by the end of it where that is
/// unambiguous. Throws vp::InputError for none, with the nearest path, and for several, with all.
/// `what`: "a link of a bus".
template <class T>
T& place_named(const std::string& name, const std::string& what) {
  std::vector<T*> found;
  std::vector<std::string> paths;
  for (T* object : vp::all_objects<T>()) {
    const std::string path = object->name();
    if (path == name) return *object;
    paths.push_back(path);
    const bool ends = path.size() > name.size() && path[path.size() - name.size() - 1] == '.' &&
                      path.compare(path.size() - name.size(), name.size(), name) == 0;
    if (ends) found.push_back(object);
  }
  if (found.size() == 1) return *found.front();
  if (found.empty()) {
    const std::string nearest = vp::nearest_match(name, paths);
    throw vp::InputError("'" + name + "' is not the path of " + what +
                         (nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
  }
  std::vector<std::string> several;
  for (const T* object : found) several.push_back(object->name());
  throw vp::InputError("'" + name + "' may be " + vp::one_of(several) + ": write the whole path");
}

}  // namespace platform

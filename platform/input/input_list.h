#pragma once

#include <string>
#include <vector>

#include <input/input_options.h>

namespace platform::input {

/// One input that can be opened.
struct InputItem {
  enum class Kind { scene, image, video };

  Kind kind;
  std::string source;  ///< scene name or path
  std::string name;    ///< without folders
};

/// The inputs with groups and folders resolved, each looked at (see open_inputs).
std::vector<InputItem> list_inputs(const std::vector<std::string>& inputs,
                                   const InputOptions& options);

/// True if `a` comes before `b` when runs of digits count as numbers: "a9" before "a10". A total
/// order.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace platform::input

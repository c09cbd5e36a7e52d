#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace platform::cli {

/// What a value on the command line is, for a shell that completes it.
struct ValueKind {
  enum class Kind { none, file, folder, choice, input, scene_group, any };

  Kind kind = Kind::none;  ///< none: a flag
  std::vector<std::string> choices;
};

struct OptionDescription {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for what stands alone
  std::string documentation;
  ValueKind value;
};

struct CommandDescription {
  std::string name;
  std::string documentation;
  std::vector<OptionDescription> options;
  ValueKind positional;  ///< none: takes none
};

/// The commands of the program as it parses them.
std::vector<CommandDescription> describe_commands(const CLI::App& app);

/// Scripts for the shells, made from the description: they cannot fall behind the program.
std::string bash_completion(const std::vector<CommandDescription>& commands);
std::string zsh_completion(const std::vector<CommandDescription>& commands);
std::string fish_completion(const std::vector<CommandDescription>& commands);

}  // namespace platform::cli

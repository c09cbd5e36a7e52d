#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>

#include <cli/app.h>
#include <cli/commands.h>
#include <cli/program.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

ValueKind value_kind(const CLI::Option& option) {
  using Kind = ValueKind::Kind;
  if (option.get_expected_max() == 0) return {};
  const std::string type = option.get_type_name();
  if (type == "FILE") return {Kind::file, {}};
  if (type == "DIR") return {Kind::folder, {}};
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const bool says_kind = std::any_of(type.begin(), type.end(), is_capital);
  if (!type.empty() && !says_kind) return {Kind::choice, vp::split(type, '|')};
  if (option.get_name() == "INPUT") return {Kind::input, {}};
  return {Kind::any, {}};
}

OptionDescription describe(const CLI::Option& option) {
  OptionDescription result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.documentation = option.get_description();
  result.value = value_kind(option);
  return result;
}

}  // namespace

std::vector<CommandDescription> describe_commands(const CLI::App& app) {
  std::vector<CommandDescription> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_group().empty()) continue;  // hidden
    CommandDescription description{command->get_name(), command->get_description(), {}, {}};
    // Some have commands of their own: their names come first.
    for (const CLI::App* inner : command->get_subcommands({})) {
      description.positional.kind = ValueKind::Kind::choice;
      description.positional.choices.push_back(inner->get_name());
    }
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional()) {
        description.positional = value_kind(*option);
      } else {
        description.options.push_back(describe(*option));
      }
    }
    commands.push_back(description);
  }
  return commands;
}

int print_completion(const CLI::App& app, std::ostream& out) {
  out << bash_completion(describe_commands(app));
  return done;
}

namespace {

using Kind = ValueKind::Kind;

/// Every way to write an option, one name each.
std::string all_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return vp::join(names, " ");
}

std::string command_names(const std::vector<CommandDescription>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CommandDescription& command : commands) names.push_back(command.name);
  return vp::join(names, " ");
}

std::string bash_values(const ValueKind& value) {
  switch (value.kind) {
    case Kind::file:
      return "mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); compopt -o filenames";
    case Kind::folder:
      return "mapfile -t COMPREPLY < <(compgen -d -- \"$word\"); compopt -o filenames";
    case Kind::choice:
      return fmt::format("mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")",
                         vp::join(value.choices, " "));
    case Kind::input:
      if (!application().input_command) return bash_values({Kind::file, {}});
      return fmt::format(
          "mapfile -t COMPREPLY < <(compgen -W \"$(\"$program\" {} 2>/dev/null)\" -- "
          "\"$word\"; compgen -f -- \"$word\"); compopt -o filenames",
          application().input_command);
    default:
      return ":";
  }
}

std::string bash_command(const CommandDescription& command) {
  std::string text = fmt::format("    {})\n      case $previous in\n", command.name);
  for (const OptionDescription& option : command.options) {
    if (option.value.kind == Kind::none) continue;
    text += fmt::format("        {}) {}; return ;;\n", vp::join(option.names, "|"),
                        bash_values(option.value));
  }
  text += fmt::format(
      "      esac\n"
      "      if [[ $word == -* ]]; then\n"
      "        mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")\n"
      "      else\n"
      "        {}\n"
      "      fi ;;\n",
      all_names(command), bash_values(command.positional));
  return text;
}

}  // namespace

std::string bash_completion(const std::vector<CommandDescription>& commands) {
  std::string text =
      "# bash completion of markervp, made by 'markervp completion bash'\n"
      "_markervp() {\n"
      "  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]}\n"
      "  local previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}\n"
      "  COMPREPLY=()\n"
      "  if (( COMP_CWORD == 1 )); then\n";
  text += fmt::format(
      "    mapfile -t COMPREPLY < <(compgen -W '{} --help --version' -- \"$word\")\n"
      "    return\n"
      "  fi\n"
      "  case $command in\n",
      command_names(commands));
  for (const CommandDescription& command : commands) text += bash_command(command);
  return text + "  esac\n}\ncomplete -F _markervp markervp\n";
}

}  // namespace platform::cli

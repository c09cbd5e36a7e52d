#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>

#include <cli/app.h>
#include <cli/commands.h>
#include <cli/program.h>
#include <scene/scene.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

ValueKind value_kind(const CLI::Option& option) {
  using Kind = ValueKind::Kind;
  if (option.get_expected_max() == 0) return {};
  const std::string type = option.get_type_name();
  if (type == "FILE") return {Kind::file, {}};
  if (type == "DIR") return {Kind::folder, {}};
  if (type.find('|') != std::string::npos) return {Kind::choice, vp::split(type, '|')};
  if (option.get_name() == "INPUT") return {Kind::input, {}};
  if (option.get_name() == "GROUP") {
    std::vector<std::string> groups;
    for (const SceneGroup& group : scene_groups()) groups.push_back(group.name);
    return {Kind::scene_group, groups};
  }
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

int print_completion(const CompletionOptions& options, const CLI::App& app, std::ostream& out) {
  const std::vector<CommandDescription> commands = describe_commands(app);
  if (options.shell == "bash") {
    out << bash_completion(commands);
  } else if (options.shell == "zsh") {
    out << zsh_completion(commands);
  } else {
    out << fish_completion(commands);
  }
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

/// Text between single quotes of any shell.
std::string quotable(std::string text) {
  std::replace(text.begin(), text.end(), '\'', '"');
  return text;
}

// ---- bash
// -----------------------------------------------------------------------------------------------------------

std::string bash_values(const ValueKind& value) {
  switch (value.kind) {
    case Kind::file:
      return "mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); compopt -o filenames";
    case Kind::folder:
      return "mapfile -t COMPREPLY < <(compgen -d -- \"$word\"); compopt -o filenames";
    case Kind::choice:
    case Kind::scene_group:
      return fmt::format("mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")",
                         vp::join(value.choices, " "));
    case Kind::input:
      return "mapfile -t COMPREPLY < <(compgen -W \"$(\"$program\" scenes --names 2>/dev/null)\" "
             "-- "
             "\"$word\"; compgen -f -- \"$word\"); compopt -o filenames";
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

// ---- zsh
// ------------------------------------------------------------------------------------------------------------

std::string zsh_values(const ValueKind& value) {
  switch (value.kind) {
    case Kind::file:
      return "_files";
    case Kind::folder:
      return "_files -/";
    case Kind::choice:
    case Kind::scene_group:
      return "(" + vp::join(value.choices, " ") + ")";
    case Kind::input:
      return "_markervp_inputs";
    default:
      return " ";
  }
}

/// Brackets and colons have a meaning in _arguments.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : quotable(text)) {
    if (c == '[' || c == ']' || c == ':') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_command(const CommandDescription& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.name);
  for (const OptionDescription& option : command.options) {
    const bool repeats = option.names.back() == "--config" || option.names.back() == "--set";
    for (const std::string& name : option.names) {
      text += fmt::format(" \\\n        '{}{}[{}]", repeats ? "*" : "", name,
                          zsh_text(option.documentation));
      if (option.value.kind != Kind::none) text += ": :" + zsh_values(option.value);
      text += "'";
    }
  }
  if (command.positional.kind != Kind::none) {
    text += " \\\n        '*: :" + zsh_values(command.positional) + "'";
  }
  return text + " ;;\n";
}

// ---- fish
// -----------------------------------------------------------------------------------------------------------

std::string fish_values(const ValueKind& value) {
  switch (value.kind) {
    case Kind::none:
      return "";
    case Kind::file:
      return " -r -F";
    case Kind::folder:
      return " -x -a '(__fish_complete_directories)'";
    case Kind::choice:
    case Kind::scene_group:
      return " -x -a '" + vp::join(value.choices, " ") + "'";
    case Kind::input:
      return " -k -a '(markervp scenes --names)' -F";
    default:
      return " -x";
  }
}

std::string fish_option(const std::string& condition, const OptionDescription& option) {
  std::string text = "complete -c markervp -n '" + condition + "'";
  for (const std::string& name : option.names) {
    text += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return text + fish_values(option.value) + " -d '" + quotable(option.documentation) + "'\n";
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

std::string zsh_completion(const std::vector<CommandDescription>& commands) {
  std::string text =
      "#compdef markervp\n"
      "# zsh completion of markervp, made by 'markervp completion zsh'\n"
      "_markervp_inputs() {\n"
      "  compadd -- ${(f)\"$(markervp scenes --names 2>/dev/null)\"}\n"
      "  _files\n"
      "}\n"
      "_markervp() {\n"
      "  if (( CURRENT == 2 )); then\n"
      "    local -a commands=(\n";
  for (const CommandDescription& command : commands) {
    text += fmt::format("      '{}:{}'\n", command.name, zsh_text(command.documentation));
  }
  text +=
      "    )\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n";
  for (const CommandDescription& command : commands) text += zsh_command(command);
  return text +
         "  esac\n}\n"
         "if [ \"$funcstack[1]\" = _markervp ]; then _markervp \"$@\"; else compdef _markervp "
         "markervp; fi\n";
}

std::string fish_completion(const std::vector<CommandDescription>& commands) {
  std::string text =
      "# fish completion of markervp, made by 'markervp completion fish'\n"
      "complete -c markervp -f\n";
  for (const CommandDescription& command : commands) {
    text += fmt::format("complete -c markervp -n __fish_use_subcommand -a {} -d '{}'\n",
                        command.name, quotable(command.documentation));
  }
  for (const CommandDescription& command : commands) {
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    for (const OptionDescription& option : command.options) text += fish_option(condition, option);
    if (command.positional.kind == Kind::none) continue;
    text += "complete -c markervp -n '" + condition + "'" + fish_values(command.positional) + "\n";
  }
  return text;
}

}  // namespace platform::cli

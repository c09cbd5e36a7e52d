#include <cli/completion.h>

#include <CLI/CLI.hpp>
#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <scene/catalogue.h>
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
    // `trace` has commands of its own: their names come first.
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

}  // namespace platform::cli

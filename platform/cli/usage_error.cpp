#include <CLI/CLI.hpp>

#include <cli/app.h>
#include <scene/catalogue.h>
#include <vp/text.h>

namespace platform::cli {

namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    const bool hidden = command->get_group().empty();
    if (!hidden) names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = vp::nearest_match(word, names);
  return nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
}

/// The command that was chosen, or the program as a whole.
const CLI::App& chosen(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

std::string see_help(const CLI::App& app) {
  const CLI::App& command = chosen(app);
  return &command == &app ? "'markervp --help' shows how"
                          : "'markervp " + command.get_name() + " --help' shows how";
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::string hint = did_you_mean(word, command_names(app));
  if (hint.empty() && is_scene(word)) hint = "did you mean 'markervp run " + word + "'? ";
  return "unknown command '" + word + "': " + hint + "there are " +
         vp::join(command_names(app), ", ");
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& arguments) {
  if (arguments.empty()) return "a command is missing: " + vp::one_of(command_names(app));
  const CLI::App& command = chosen(app);
  const bool is_word = arguments.front().rfind('-', 0) != 0;
  if (&command == &app && is_word) return unknown_command(app, arguments.front());
  const std::vector<std::string> extras = app.remaining(true);
  if (!extras.empty()) {
    const std::string name = extras.front().substr(0, extras.front().find('='));
    const std::string kind = name.rfind('-', 0) == 0 ? "unknown option '" : "unexpected argument '";
    return kind + name + "': " + did_you_mean(name, option_names(command)) + see_help(app);
  }
  return std::string(error.what()) + ": " + see_help(app);
}

}  // namespace platform::cli

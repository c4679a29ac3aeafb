// sculpt completion: what shells need to complete our command line, made from the options themselves.
#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "clients/cli/commands/commands.hpp"
#include "clients/cli/exit_code.hpp"
#include "core/cell/shipped_cells.hpp"

namespace sculpt::cli {

namespace {

struct Word {
  std::string text, help;
  std::string values = {};  ///< what may follow, with blanks between; empty: anything
};

/// Those of --robot are asked for when they are needed: `sculpt completion cells` prints them.
const std::string cells = "(cells)";

/// What may stand behind `sculpt NAME`; for an empty name behind `sculpt`.
struct Command {
  Word word;  ///< its values are those of what must follow
  std::vector<Word> options;
};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// CLI11 writes what an option is checked for behind its type: TEXT:{ndjson,binary,csv}.
std::string values_of(const CLI::Option& option) {
  if (option.check_lname("robot") || option.get_type_name() == "CELL") return cells;
  if (option.check_lname("search")) return "sweep octree voxel mill";
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  std::string values = type.substr(begin + 1, end - begin - 1);
  std::replace(values.begin(), values.end(), ',', ' ');
  return values;
}

std::vector<Word> options_of(const CLI::App& app) {
  std::vector<Word> words;
  for (const CLI::Option* option : app.get_options()) {
    const std::string help = first_line(option->get_description()), values = values_of(*option);
    for (const std::string& name : option->get_lnames()) words.push_back({"--" + name, help, values});
    for (const std::string& name : option->get_snames()) words.push_back({"-" + name, help, values});
  }
  return words;
}

std::string positional_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional()) return values_of(*option);
  return "";
}

/// With the names and options of the commands in it: `sculpt cell` takes `new` and what that takes.
Command command_of(const CLI::App& app) {
  Command command{{app.get_name(), first_line(app.get_description()), positional_values(app)}, options_of(app)};
  for (const CLI::App* inner : app.get_subcommands([](const CLI::App*) { return true; })) {
    command.word.values += (command.word.values.empty() ? "" : " ") + inner->get_name();
    for (const Word& option : options_of(*inner))
      if (std::none_of(command.options.begin(), command.options.end(),
                       [&](const Word& known) { return known.text == option.text; }))
        command.options.push_back(option);
  }
  return command;
}

std::vector<Command> commands_of(const CLI::App& app) {
  std::vector<Command> commands{{{}, options_of(app)}};
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
    commands.push_back(command_of(*sub));
  return commands;
}

std::string joined(const std::vector<Word>& words) {
  std::string text;
  for (const Word& word : words) text += (text.empty() ? "" : " ") + word.text;
  return text;
}

std::vector<Word> names_of(const std::vector<Command>& commands) {
  std::vector<Word> names;
  for (const Command& command : commands)
    if (!command.word.text.empty()) names.push_back(command.word);
  return names;
}

/// Options that some values may follow, each once.
std::vector<Word> choosy_options(const std::vector<Command>& commands) {
  std::vector<Word> choosy;
  for (const Command& command : commands)
    for (const Word& option : command.options)
      if (!option.values.empty() &&
          std::none_of(choosy.begin(), choosy.end(), [&](const Word& known) { return known.text == option.text; }))
        choosy.push_back(option);
  return choosy;
}

/// In single quotes, as all three shells read them.
std::string quoted(std::string text) {
  std::erase_if(text, [](char c) { return c == '\'' || c == '\\'; });
  return "'" + text + "'";
}

/// With a command that prints the names of cells in place of `cells`.
std::string with_cells(std::string values, const std::string& command) {
  if (const std::size_t at = values.find(cells); at != std::string::npos) values.replace(at, cells.size(), command);
  return values;
}

const std::string bash_cells = "$(\"${COMP_WORDS[0]}\" completion cells 2>/dev/null)",
                  zsh_cells = "$($words[1] completion cells 2>/dev/null)", fish_cells = "(sculpt completion cells)";

std::string bash_script(const std::vector<Command>& commands) {
  std::string script =
      "# bash completion of sculpt\n"
      "_sculpt() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= words= choices= i\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case ${COMP_WORDS[i]} in\n";
  for (const Word& name : names_of(commands))
    script += "      " + name.text + ") command=" + name.text + "; break ;;\n";
  script += "    esac\n  done\n  case $command in\n";
  for (const Command& command : commands)
    script += "    '" + command.word.text + "') words='" +
              (command.word.text.empty() ? joined(names_of(commands)) + " " : "") + joined(command.options) +
              "' choices=\"" + with_cells(command.word.values, bash_cells) + "\" ;;\n";
  script +=
      "  esac\n"
      "  if [[ -z $command || $word == -* ]]; then choices=$words; fi\n"
      "  case $before in\n";
  for (const Word& option : choosy_options(commands))
    script +=
        "    " + option.text + ") choices=" + (option.values == cells ? bash_cells : quoted(option.values)) + " ;;\n";
  return script +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$choices\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F _sculpt sculpt\n";
}

std::string zsh_list(const std::vector<Word>& words) {
  std::string list;
  for (const Word& word : words) list += " " + quoted(word.text + ":" + word.help);
  return list;
}

std::string zsh_script(const std::vector<Command>& commands) {
  std::string script =
      "#compdef sculpt\n"
      "_sculpt() {\n"
      "  local -a choices; local command= word\n"
      "  case $words[CURRENT-1] in\n";
  for (const Word& option : choosy_options(commands))
    script += "    " + option.text + ") compadd -- " + with_cells(option.values, zsh_cells) + "; " +
              (option.values == cells ? "_files; " : "") + "return ;;\n";
  script +=
      "  esac\n"
      "  for word in ${words[2,CURRENT-1]}; do [[ $word != -* ]] && { command=$word; break }; done\n"
      "  case $command in\n";
  for (const Command& command : commands) {
    const std::vector<Word> first = command.word.text.empty() ? names_of(commands) : std::vector<Word>{};
    script += "    '" + command.word.text + "') choices=(" + zsh_list(first) + zsh_list(command.options) + " )";
    if (!command.word.values.empty())
      script += "; [[ $PREFIX != -* ]] && { compadd -- " + with_cells(command.word.values, zsh_cells) + "; return }";
    script += " ;;\n";
  }
  return script +
         "  esac\n"
         "  if [[ -z $command || $PREFIX == -* ]]; then _describe sculpt choices; else _files; fi\n"
         "}\n"
         "compdef _sculpt sculpt\n";
}

std::string fish_script(const std::vector<Command>& commands) {
  std::string script = "# fish completion of sculpt\n";
  for (const Command& command : commands) {
    const std::string& name = command.word.text;
    const std::string when =
        name.empty() ? " -n __fish_use_subcommand" : " -n '__fish_seen_subcommand_from " + name + "'";
    if (!name.empty())
      script += "complete -c sculpt -n __fish_use_subcommand -a " + name + " -d " + quoted(command.word.help) + "\n";
    if (!command.word.values.empty())
      script += "complete -c sculpt" + when + " -a " + quoted(with_cells(command.word.values, fish_cells)) + "\n";
    for (const Word& option : command.options) {
      const bool is_long = option.text.starts_with("--");
      script += "complete -c sculpt" + when + (is_long ? " -l " : " -s ") + option.text.substr(is_long ? 2 : 1);
      if (!option.values.empty()) script += " -r -a " + quoted(with_cells(option.values, fish_cells));
      script += " -d " + quoted(option.help) + "\n";
    }
  }
  return script;
}

}  // namespace

void add_completion(CLI::App& app, Invocation& invocation) {
  const auto shell = std::make_shared<std::string>();
  CLI::App& command =
      add_command(app, invocation, "completion", "Print the completion script of a shell", [&app, shell] {
        if (*shell == "cells") {
          for (const std::string& name : cell_names(shipped_cell_folders())) std::cout << name << "\n";
          return exit_fine;
        }
        const std::vector<Command> commands = commands_of(app);
        std::cout << (*shell == "bash"  ? bash_script(commands)
                      : *shell == "zsh" ? zsh_script(commands)
                                        : fish_script(commands));
        return exit_fine;
      });
  command.group("");  // for packagers, not in --help
  command.add_option("shell", *shell, "bash, zsh or fish; cells: the names that those ask for")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish", "cells"}));
}

}  // namespace sculpt::cli

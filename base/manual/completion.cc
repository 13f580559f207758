// SPDX-License-Identifier: BSD-3-Clause
// Completion in bash and zsh: commands, options, and values where they are known.
#include <CLI/CLI.hpp>
#include <sstream>

#include "base/manual/manual.h"
#include "base/manual/shown.h"

namespace strainwave {

namespace {

/// `text` in single quotes for a shell.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? "'\\''" : std::string(1, c);
  return safe + "'";
}

/// Escapes the characters that are syntax in zsh's descriptions.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']') safe += '\\';
    safe += c;
  }
  return safe;
}

std::string words(const std::vector<std::string>& list) {
  std::string line;
  for (const std::string& word : list) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::vector<std::string> option_words(const CLI::App& app) {
  std::vector<std::string> all;
  for (const CLI::Option* option : shown_options(app))
    for (const std::string& name : spellings(*option)) all.push_back(name);
  return all;
}

/// All options of the program and its commands that take a value.
std::string options_with_values(const CLI::App& app) {
  std::string all;
  for (const CLI::Option* option : shown_options(app))
    if (option->get_items_expected_max() > 0)
      for (const std::string& name : spellings(*option)) all += name + " ";
  for (const CLI::App* command : commands_of(app)) all += options_with_values(*command);
  return all;
}

/// Possible values of `option`: the words of its check, "{a,b}", or those that the manual has for its name or type. Empty if unknown.
std::string offered_values(const CLI::Option& option, const Manual& manual) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  if (begin != std::string::npos) {
    std::string list = type.substr(begin + 1, type.find('}', begin) - begin - 1);
    for (char& c : list) c = c == ',' ? ' ' : c;
    return list;
  }
  for (const auto& [name, values] : manual.values)
    if (name == option.get_name(true) || name == type) return values;
  return "";
}

/// Branches of a shell's `case` over "COMMAND PREVIOUS-WORD", which offer the values of options.
std::string option_branches(const CLI::App& app, const std::string& command, const Manual& manual) {
  std::string text;
  for (const CLI::Option* option : shown_options(app)) {
    const std::string values = offered_values(*option, manual);
    if (values.empty()) continue;
    for (const std::string& name : spellings(*option))
      text.append("    ")
          .append(command)
          .append("' ")
          .append(name)
          .append("') offered=\"")
          .append(values)
          .append("\" ;;\n");
  }
  return text;
}

/// Branches over "COMMAND NUMBER-OF-ARGUMENTS-BEFORE", which offer the values of arguments.
std::string argument_branches(const CLI::App& command, const Manual& manual) {
  std::string text;
  int place = 0;
  for (const CLI::Option* option : shown_options(command)) {
    if (!option->get_positional()) continue;
    const std::string values = offered_values(*option, manual);
    const bool repeats = option->get_items_expected_max() > 1;
    if (!values.empty())
      text += "      '" + command.get_name() + " '" + (repeats ? "*" : std::to_string(place)) +
              ") offered=\"" + values + "\" ;;\n";
    ++place;
  }
  return text;
}

/// Shell code that sets `offered` from `command`, `last` and `place`; valid in bash and in zsh.
std::string find_values(const CLI::App& app, const Manual& manual) {
  std::string options = option_branches(app, "*", manual);
  std::string arguments;
  for (const CLI::App* command : commands_of(app)) {
    options += option_branches(*command, command->get_name(), manual);
    arguments += argument_branches(*command, manual);
  }
  return "  case \"$command $last\" in\n" + options +
         "    *) ;;\n  esac\n"
         "  if [[ -z $offered && $valued != *\" $last \"* ]]; then\n"
         "    case \"$command $place\" in\n" +
         arguments + "      *) ;;\n    esac\n  fi\n";
}

std::string identifier(std::string program) {
  for (char& c : program) c = c == '-' ? '_' : c;
  return "_" + program;
}

}  // namespace

std::string bash_completion(const CLI::App& app, const Manual& manual) {
  std::ostringstream text;
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  const std::string function = identifier(manual.program);
  text << "# bash completion of " << manual.program << "; made from its command line (" << manual.program
       << " --manual bash)\n"
       << function << "() {\n"
       << "  local word=${COMP_WORDS[COMP_CWORD]} commands=" << quoted(words(names)) << "\n"
       << "  local valued=" << quoted(" " + options_with_values(app)) << "\n"
       << "  local command= place=0 last= offered= candidate\n"
       << "  for candidate in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
       << "    if [[ $candidate != -* && $valued != *\" $last \"* ]]; then\n"
       << "      if [[ -n $command ]]; then ((place += 1))\n"
       << "      elif [[ \" $commands \" == *\" $candidate \"* ]]; then command=$candidate\n"
       << "      fi\n"
       << "    fi\n"
       << "    last=$candidate\n"
       << "  done\n"
       << "  local options=" << quoted(words(option_words(app))) << "\n"
       << "  case $command in\n";
  for (const CLI::App* command : commands_of(app))
    text << "    " << command->get_name() << ") options+=" << quoted(" " + words(option_words(*command)))
         << " ;;\n";
  text << "  esac\n"
       << "  if [[ $word == -* ]]; then\n"
       << "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
       << "    return\n"
       << "  fi\n"
       << find_values(app, manual) << "  if [[ -n $offered ]]; then\n"
       << "    COMPREPLY=($(compgen -W \"$offered\" -- \"$word\"))\n"
       << "  elif [[ -z $command && -n $commands && $valued != *\" $last \"* ]]; then\n"
       << "    COMPREPLY=($(compgen -W \"$commands\" -- \"$word\"))\n"
       << "  fi\n"
       << "}\n"
       << "complete -o default -F " << function << " " << manual.program << "\n";
  return text.str();
}

std::string zsh_completion(const CLI::App& app, const Manual& manual) {
  std::ostringstream text;
  const auto describe = [&](const CLI::App& of, const std::string& indent) {
    text << indent << "options=(\n";
    for (const CLI::Option* option : shown_options(of))
      for (const std::string& name : spellings(*option))
        text << indent << "  " << quoted(name + ":" + zsh_text(option->get_description())) << "\n";
    text << indent << ")\n" << indent << "all+=(\"${options[@]}\")\n";
  };
  text << "#compdef " << manual.program << "\n# made from its command line (" << manual.program
       << " --manual zsh)\n"
       << "local -a commands options all\nlocal word command= place=0 last= offered=\n"
       << "local valued=" << quoted(" " + options_with_values(app)) << "\n"
       << "commands=(\n";
  for (const CLI::App* command : commands_of(app))
    text << "  " << quoted(command->get_name() + ":" + zsh_text(command->get_description())) << "\n";
  text << ")\n"
       << "for word in \"${words[@]:1:$((CURRENT - 2))}\"; do\n"
       << "  if [[ $word != -* && $valued != *\" $last \"* ]]; then\n"
       << "    if [[ -n $command ]]; then ((place += 1))\n"
       << "    elif [[ -n ${(M)commands:#$word:*} ]]; then command=$word\n"
       << "    fi\n"
       << "  fi\n"
       << "  last=$word\n"
       << "done\n";
  describe(app, "");
  text << "case $command in\n";
  for (const CLI::App* command : commands_of(app)) {
    text << "  " << command->get_name() << ")\n";
    describe(*command, "    ");
    text << "    ;;\n";
  }
  text << "esac\n"
       << "if [[ $PREFIX == -* ]]; then _describe option all; return; fi\n"
       << find_values(app, manual) << "if [[ -n $offered ]]; then compadd -- ${=offered}\n"
       << "elif [[ -z $command && -n $commands && $valued != *\" $last \"* ]]; then _describe command "
          "commands\n"
       << "else _files\nfi\n";
  return text.str();
}

}  // namespace strainwave

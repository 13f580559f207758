#include "base/manual/manual.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>
#include <vector>

namespace strainwave {

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Text that roff takes literally; behind a comma its line may end, spaces or not.
std::string roff(const std::string& text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool line_begins = i == 0 || text[i - 1] == '\n';
    if (line_begins && (text[i] == '.' || text[i] == '\'')) safe += "\\&";
    if (text[i] == '\\') {
      safe += "\\e";
    } else {
      safe += text[i] == '-' ? "\\-" : std::string(1, text[i]);
    }
    if (text[i] == ',') safe += "\\:";
  }
  return safe;
}

/// Text between single quotes of a shell, and for zsh without what its descriptions take for syntax.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? "'\\''" : std::string(1, c);
  return safe + "'";
}
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']') safe += '\\';
    safe += c;
  }
  return safe;
}

/// Options that are shown: not the hidden ones.
std::vector<const CLI::Option*> shown_options(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// "-h", "--help": every way to write it; none for a positional.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

std::string value_name(const CLI::Option& option) {
  return option.get_items_expected_max() == 0 ? "" : option.get_type_name();
}

std::string man_option(const CLI::Option& option) {
  std::ostringstream text;
  text << ".TP\n";
  std::string names;
  for (const std::string& name : spellings(option)) names += (names.empty() ? "" : ", ") + name;
  text << "\\fB" << roff(names.empty() ? option.get_name(true) : names) << "\\fR";
  if (const std::string value = value_name(option); !names.empty() && !value.empty())
    text << " \\fI" << roff(value) << "\\fR";
  text << "\n" << roff(option.get_description());
  if (!option.get_default_str().empty()) text << " (default: " << roff(option.get_default_str()) << ")";
  if (!option.get_envname().empty()) text << ". Environment: " << roff(option.get_envname());
  text << ".\n";
  return text.str();
}

std::string man_command(const CLI::App& command) {
  std::string usage = "\\fB" + roff(command.get_name()) + "\\fR";
  std::string options;
  for (const CLI::Option* option : shown_options(command)) {
    if (option->get_positional()) usage += " \\fI" + roff(option->get_name(true)) + "\\fR";
    if (option != command.get_help_ptr()) options += man_option(*option);
  }
  return ".SS \"" + roff(command.get_name()) + "\"\n" + usage + "\n.PP\n" + roff(command.get_description()) +
         ".\n" + options;
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

std::string identifier(std::string program) {
  for (char& c : program) c = c == '-' ? '_' : c;
  return "_" + program;
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& program) {
  std::ostringstream text;
  text << ".TH " << upper(program) << " 1 \"\" \"strainwave " << STRAINWAVE_VERSION << "\"\n";
  text << ".ad l\n";  // lists of values leave no room to stretch a line
  text << ".SH NAME\n" << roff(program) << " \\- " << roff(app.get_description()) << "\n";
  text << ".SH SYNOPSIS\n\\fB" << roff(program) << "\\fR [\\fIOPTIONS\\fR]";
  if (!commands_of(app).empty()) text << " \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]";
  text << "\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(app)) text << man_option(*option);
  if (!commands_of(app).empty()) text << ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) text << man_command(*command);
  if (!app.get_footer().empty()) text << ".SH NOTES\n.nf\n" << roff(app.get_footer()) << "\n.fi\n";
  return text.str();
}

std::string bash_completion(const CLI::App& app, const std::string& program) {
  std::ostringstream text;
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  const std::string function = identifier(program);
  text << "# bash completion of " << program << "; made from its command line (" << program
       << " --manual bash)\n"
       << function << "() {\n"
       << "  local word=${COMP_WORDS[COMP_CWORD]} commands=" << quoted(words(names))
       << " command= candidate\n"
       << "  for candidate in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
       << "    case \" $commands \" in *\" $candidate \"*) command=$candidate && break ;; esac\n"
       << "  done\n"
       << "  local options=" << quoted(words(option_words(app))) << "\n"
       << "  case $command in\n";
  for (const CLI::App* command : commands_of(app))
    text << "    " << command->get_name() << ") options+=" << quoted(" " + words(option_words(*command)))
         << " ;;\n";
  text << "  esac\n"
       << "  if [[ $word == -* ]]; then\n"
       << "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
       << "  elif [[ -z $command && -n $commands ]]; then\n"
       << "    COMPREPLY=($(compgen -W \"$commands\" -- \"$word\"))\n"
       << "  fi\n"
       << "}\n"
       << "complete -o default -F " << function << " " << program << "\n";
  return text.str();
}

std::string zsh_completion(const CLI::App& app, const std::string& program) {
  std::ostringstream text;
  const auto describe = [&](const CLI::App& of, const std::string& indent) {
    text << indent << "options=(\n";
    for (const CLI::Option* option : shown_options(of))
      for (const std::string& name : spellings(*option))
        text << indent << "  " << quoted(name + ":" + zsh_text(option->get_description())) << "\n";
    text << indent << ")\n" << indent << "all+=(\"${options[@]}\")\n";
  };
  text << "#compdef " << program << "\n# made from its command line (" << program << " --manual zsh)\n"
       << "local -a commands options all\nlocal word command=\n"
       << "commands=(\n";
  for (const CLI::App* command : commands_of(app))
    text << "  " << quoted(command->get_name() + ":" + zsh_text(command->get_description())) << "\n";
  text << ")\n"
       << "for word in \"${words[@]:1:$((CURRENT - 2))}\"; do\n"
       << "  if [[ -n ${(M)commands:#$word:*} ]]; then command=$word; break; fi\n"
       << "done\n";
  describe(app, "");
  text << "case $command in\n";
  for (const CLI::App* command : commands_of(app)) {
    text << "  " << command->get_name() << ")\n";
    describe(*command, "    ");
    text << "    ;;\n";
  }
  text << "esac\n"
       << "if [[ $PREFIX == -* ]]; then _describe option all; elif [[ -z $command && -n $commands ]]; then "
          "_describe command "
          "commands; else _files; fi\n";
  return text.str();
}

void add_manual_option(CLI::App& app, const std::string& program) {
  app.add_option_function<std::string>(
         "--manual",
         [&app, program](const std::string& kind) {
           std::cout << (kind == "man"    ? man_page(app, program)
                         : kind == "bash" ? bash_completion(app, program)
                                          : zsh_completion(app, program));
           throw CLI::Success();
         },
         "print the man page or a shell's completion")
      ->check(CLI::IsMember({"man", "bash", "zsh"}))
      ->group("");
}

}  // namespace strainwave

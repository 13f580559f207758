// SPDX-License-Identifier: BSD-3-Clause
#include "base/manual/manual.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "base/manual/shown.h"

namespace strainwave {

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Escapes `text` for roff. A line may break after a comma, even without a space.
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

/// "FILE", "TEXT:{a,b}"; empty for a flag.
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

/// "\fIJOINT\fR", "[\fIJOINT\fR ...]": as the man page shows it after the command.
std::string man_positional(const CLI::Option& option) {
  std::string text = "\\fI" + roff(option.get_name(true)) + "\\fR";
  if (option.get_items_expected_max() > 1 && option.get_name(true).front() != '[') text += " ...";
  return option.get_required() ? text : "[" + text + "]";
}

std::string man_command(const CLI::App& command) {
  std::string usage = "\\fB" + roff(command.get_name()) + "\\fR";
  std::string options;
  for (const CLI::Option* option : shown_options(command)) {
    if (option->get_positional()) usage += " " + man_positional(*option);
    if (option != command.get_help_ptr()) options += man_option(*option);
  }
  return ".SS \"" + roff(command.get_name()) + "\"\n" + usage + "\n.PP\n" + roff(command.get_description()) +
         ".\n" + options;
}

/// A section of entries; nothing when there are none.
std::string man_entries(const std::string& title, const Manual::Entries& entries) {
  std::string text = entries.empty() ? "" : ".SH " + title + "\n";
  for (const auto& [what, meaning] : entries)
    text += ".TP\n\\fB" + roff(what) + "\\fR\n" + roff(meaning) + ".\n";
  return text;
}

std::string man_see_also(const std::vector<std::string>& pages) {
  std::string text = pages.empty() ? "" : ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::size_t section = std::min(pages[i].find('('), pages[i].size());
    text += "\\fB" + roff(pages[i].substr(0, section)) + "\\fR" + roff(pages[i].substr(section)) +
            (i + 1 < pages.size() ? ",\n" : "\n");
  }
  return text;
}

}  // namespace

const Manual::Entries& exit_statuses() {
  static const Manual::Entries kStatuses{
      {"0", "done"},
      {"1", "the program tried, but was refused or did not reach its aim; it prints the reason"},
      {"2", "the command line or a file is wrong"},
      {"3", "no answer: no daemon, no such joint, no acknowledgement in time, no LCM on this PC"},
      {"130", "interrupted while waiting"}};
  return kStatuses;
}

std::string man_page(const CLI::App& app, const Manual& manual) {
  std::ostringstream text;
  text << ".TH " << upper(manual.program) << " " << manual.section << " \"" << STRAINWAVE_DATE
       << "\" \"strainwave " << STRAINWAVE_VERSION << "\"\n";
  text << ".ad l\n";  // left-aligned: justified lines with long lists of values would have wide gaps
  text << ".SH NAME\n" << roff(manual.program) << " \\- " << roff(app.get_description()) << "\n";
  text << ".SH SYNOPSIS\n\\fB" << roff(manual.program) << "\\fR [\\fIOPTIONS\\fR]";
  if (!commands_of(app).empty()) text << " \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]";
  text << "\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(app)) text << man_option(*option);
  if (!commands_of(app).empty()) text << ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) text << man_command(*command);
  text << man_entries("EXIT STATUS", exit_statuses()) << man_entries("FILES", manual.files)
       << man_entries("EXAMPLES", manual.examples) << man_see_also(manual.see_also);
  return text.str();
}

void add_manual_option(CLI::App& app, const Manual& manual) {
  app.add_option_function<std::string>(
         "--manual",
         [&app, manual](const std::string& kind) {
           std::cout << (kind == "man"    ? man_page(app, manual)
                         : kind == "bash" ? bash_completion(app, manual)
                                          : zsh_completion(app, manual));
           throw CLI::Success();
         },
         "print the man page or a shell's completion")
      ->check(CLI::IsMember({"man", "bash", "zsh"}))
      ->group("");
}

}  // namespace strainwave

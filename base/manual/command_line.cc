#include "base/manual/command_line.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include <algorithm>
#include <iostream>

#include "base/input_error.h"
#include "base/nearest_word.h"
#include "base/printable.h"
#include "base/program_error.h"

namespace strainwave {

namespace {

std::string exit_status_footer() {
  std::string text = "Exit status:\n";
  for (const auto& [number, meaning] : exit_statuses())
    text.append("  ").append(number).append("  ").append(meaning).append("\n");
  return text;
}

/// The command that was chosen, down to the innermost.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : innermost(*chosen.front());
}

void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  add_option_names(app, names);
  if (const CLI::App& command = innermost(app); &command != &app) add_option_names(command, names);
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// Words that nothing took, in the order in which they were typed.
std::vector<std::string> left_over(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> left = app.remaining(true);
  std::vector<std::string> ordered;
  for (const std::string& word : words) {
    const auto found = std::find(left.begin(), left.end(), word);
    if (found == left.end()) continue;
    ordered.push_back(word);
    left.erase(found);
  }
  return ordered;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string* nearest = nearest_word(word, known);
  return nearest != nullptr ? "; did you mean " + *nearest + "?" : "";
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What is wrong with words that nothing took.
std::string explain(const CLI::App& app, const std::vector<std::string>& left) {
  const auto option =
      std::find_if(left.begin(), left.end(), [](const std::string& word) { return word.starts_with("-"); });
  if (option != left.end()) {
    const std::string name = option->substr(0, option->find('='));
    return name + " is not an option" + suggestion(name, option_names(app));
  }
  const std::vector<std::string> commands = command_names(app);
  if (app.get_subcommands().empty() && !commands.empty()) {
    const std::string hint = suggestion(left.front(), commands);
    return "'" + left.front() + "' is not a command" +
           (hint.empty() ? "; there are " + list(commands) : hint);
  }
  std::string words;
  for (const std::string& word : left) words += " '" + word + "'";
  return "unexpected:" + words;
}

/// What was given, in one sentence without line ends.
std::string explain(const CLI::App& app, const CLI::ParseError& error,
                    const std::vector<std::string>& words) {
  const std::vector<std::string> left = left_over(app, words);
  if (!left.empty()) return explain(app, left);
  std::string text = error.what();
  if (app.get_subcommands().empty() &&
      error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError) && !command_names(app).empty())
    text = "a command is required: " + list(command_names(app));
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ConversionError))
    text += ": a number is allowed";
  return text;
}

}  // namespace

void configure_program(CLI::App& app, const Manual& manual) {
  app.name(manual.program);
  app.set_version_flag("--version", manual.program + " " + STRAINWAVE_VERSION);
  add_manual_option(app, manual);
  app.footer(exit_status_footer());
}

std::optional<ExitStatus> parse_command_line(CLI::App& app, std::vector<std::string> words, std::ostream& out,
                                             std::ostream& err) {
  for (std::string& word : words)
    if (word.starts_with("-.")) word.insert(1, "0");  // which CLI11 would take for an option
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 wants the last first
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error, out, err);
      return ExitStatus::kDone;
    }
    err << app.get_name() << ": " << printable_paragraph(explain(app, error, words)) << "; see "
        << app.get_name() << " --help\n";
    return ExitStatus::kUsage;
  }
}

ExitStatus run_program(CLI::App& app, int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                       const CommandBody& action) {
  const auto fail = [&](ExitStatus status, const std::string& why) {
    err << app.get_name() << ": " << printable_paragraph(why) << '\n';
    return status;
  };
  try {
    if (const auto status = parse_command_line(app, {argv + 1, argv + argc}, out, err)) return *status;
    return action();
  } catch (const ProgramError& error) {
    return fail(error.status(), error.what());
  } catch (const NotAchieved& error) {
    return fail(ExitStatus::kRefused, error.what());
  } catch (const InputError& error) {
    return fail(ExitStatus::kUsage, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitStatus::kUsage, error.what());
  } catch (const std::exception& error) {
    return fail(ExitStatus::kNoAnswer, error.what());
  }
}

int run_program(CLI::App& app, int argc, const char* const* argv, const CommandBody& action) {
  return static_cast<int>(run_program(app, argc, argv, std::cout, std::cerr, action));
}

}  // namespace strainwave

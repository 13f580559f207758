// SPDX-License-Identifier: BSD-3-Clause
#include "base/manual/command_line.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <sstream>

#include "base/input_error.h"
#include "base/nearest_word.h"
#include "base/printable.h"
#include "strainwave/program_error.h"

namespace strainwave {

namespace {

// End of CLI11's message about a flag with a value.
constexpr std::string_view kFlagWithValue = "disallowed flag override";

/// CLI11 would take "--wait=3" for "--wait".
void refuse_values_of_flags(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (option->get_expected_max() == 0) option->disable_flag_override();
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    refuse_values_of_flags(*command);
}

std::string exit_status_footer() {
  std::string text = "Exit status:\n";
  for (const auto& [number, meaning] : exit_statuses())
    text.append("  ").append(number).append("  ").append(meaning).append("\n");
  return text;
}

/// The innermost subcommand on the command line, or `app` if there is none.
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

/// Words that no command or option accepted, in the order in which they were typed.
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

/// Explains what is wrong with words that no command or option accepted.
std::string explain(const CLI::App& app, const std::vector<std::string>& left) {
  const std::vector<std::string> commands = command_names(app);
  const bool no_command = app.get_subcommands().empty() && !commands.empty();
  const auto option =
      std::find_if(left.begin(), left.end(), [](const std::string& word) { return word.starts_with("-"); });
  // After an unknown command, every option is unknown. The message is then about the command.
  if (option != left.end() && !(no_command && option != left.begin())) {
    const std::string name = option->substr(0, option->find('='));
    double value = 0.0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), value);
    if (error == std::errc() && end == name.data() + name.size() && !std::isfinite(value))
      return "'" + name + "' is not a finite number";
    return name + " is not an option" + suggestion(name, option_names(app));
  }
  if (no_command) {
    const std::string hint = suggestion(left.front(), commands);
    return "'" + left.front() + "' is not a command" +
           (hint.empty() ? "; the commands are " + list(commands) : hint);
  }
  std::string words;
  for (const std::string& word : left) words += " '" + word + "'";
  return "unexpected:" + words;
}

/// The option with which CLI11's message begins, looked up in the innermost command; null if there is none.
const CLI::Option* option_of(const CLI::App& app, const std::string& message) {
  const std::string name = message.substr(0, message.find(':'));
  return innermost(app).get_option_no_throw(name);
}

/// "--weights takes 4 values (cost: integral,position,velocity,torque): 3 were given", in place of CLI11's "At least 4 required".
std::string explain_count(const CLI::App& app, const std::string& message) {
  const CLI::Option* option = option_of(app, message);
  const std::size_t last = message.find_last_of(' ');
  if (option == nullptr || option->get_expected_min() <= 1 ||
      option->get_expected_min() != option->get_expected_max() ||
      message.find("received") == std::string::npos)
    return message;
  return option->get_name() + " takes " + std::to_string(option->get_expected_min()) + " values (" +
         option->get_description() + "): " + message.substr(last + 1) + " were given";
}

/// "--wait takes no value: '3' was given; --tolerance_rad takes one", in place of CLI11's "disallowed flag override".
std::string explain_flag(const CLI::App& app, const std::string& message,
                         const std::vector<std::string>& words) {
  const std::string name = "--" + message.substr(0, message.find(' '));
  const auto given = std::find_if(words.begin(), words.end(),
                                  [&](const std::string& word) { return word.starts_with(name + "="); });
  std::string text = name + " takes no value";
  if (given != words.end()) text += ": '" + given->substr(name.size() + 1) + "' was given";
  const CLI::App& command = innermost(app);
  std::vector<std::string> others;
  if (&command != &app && command.get_option_no_throw(name) != nullptr)
    for (const CLI::Option* option : command.get_options())
      if (!option->get_lnames().empty() && option->get_expected_max() > 0)
        others.push_back("--" + option->get_lnames().front());
  if (!others.empty()) text += "; " + list(others) + (others.size() == 1 ? " takes one" : " take one");
  return text;
}

/// "--model: 'fuzy' is none of exponential, fuzzy, both; did you mean fuzzy?", in place of CLI11's "fuzy not in {...}".
std::string explain_choice(const std::string& message) {
  constexpr std::string_view kNotIn = " not in {";
  const std::size_t colon = message.find(": ");
  const std::size_t set = message.rfind(kNotIn);
  if (colon == std::string::npos || set == std::string::npos || set < colon + 2 || !message.ends_with('}'))
    return message;
  std::vector<std::string> allowed;
  std::istringstream words(message.substr(set + kNotIn.size(), message.size() - set - kNotIn.size() - 1));
  for (std::string word; std::getline(words, word, ',');) allowed.push_back(word);
  const std::string given = message.substr(colon + 2, set - colon - 2);
  return message.substr(0, colon) + ": '" + given + "' is none of " + list(allowed) +
         suggestion(given, allowed);
}

/// Says what is allowed in place of the last word of `message`, which CLI11 could not convert to a number.
std::string explain_number(const std::string& message) {
  const std::string_view given = std::string_view(message).substr(message.find_last_of(" =") + 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), value);
  if (error == std::errc::invalid_argument || end != given.data() + given.size())
    return "a number is allowed";
  if (given.find_first_not_of("-0123456789") != std::string_view::npos) return "a whole number is allowed";
  return value < 0.0 ? "a number of 0 or more is allowed" : "a smaller number is allowed";
}

/// Explains a parse error in one sentence without line feeds.
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
    return text + ": " + explain_number(text);
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ArgumentMismatch))
    return text.ends_with(kFlagWithValue) ? explain_flag(app, text, words) : explain_count(app, text);
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ValidationError)) return explain_choice(text);
  return text;
}

/// Returns a status if help, version or manual was printed, otherwise nothing. Throws ProgramError (usage).
std::optional<ExitStatus> parse(CLI::App& app, std::vector<std::string> words, std::ostream& out) {
  for (std::string& word : words)
    if (word.starts_with("-.")) word.insert(1, "0");  // CLI11 would take "-.5" for an option
  refuse_values_of_flags(app);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 expects the last word first
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      throw ProgramError(ExitStatus::kUsage,
                         explain(app, error, words) + "; see " + app.get_name() + " --help");
    app.exit(error, out, out);
    return ExitStatus::kDone;
  }
}

}  // namespace

void configure_program(CLI::App& app, const Manual& manual) {
  app.name(manual.program);
  app.set_version_flag("--version", manual.program + " " + STRAINWAVE_VERSION);
  add_manual_option(app, manual);
  app.footer(exit_status_footer());
}

void tell_failure(const CLI::App& app, std::ostream& err, const ProgramFailure& failure) {
  err << app.get_name() << ": " << failure.why << '\n';
}

ExitStatus run_program(CLI::App& app, int argc, const char* const* argv, std::ostream& out,
                       const FailureTeller& tell, const CommandBody& action) {
  const auto fail = [&](ExitStatus status, const std::exception& error) {
    tell({status, printable_paragraph(error.what()), error});
    return status;
  };
  try {
    if (const auto status = parse(app, {argv + 1, argv + argc}, out)) return *status;
    return action();
  } catch (const ProgramError& error) {
    return fail(error.status(), error);
  } catch (const NotAchieved& error) {
    return fail(ExitStatus::kRefused, error);
  } catch (const InputError& error) {
    return fail(ExitStatus::kUsage, error);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitStatus::kUsage, error);
  } catch (const std::exception& error) {
    return fail(ExitStatus::kNoAnswer, error);
  }
}

int run_program(CLI::App& app, int argc, const char* const* argv, const CommandBody& action) {
  const auto tell = [&](const ProgramFailure& failure) { tell_failure(app, std::cerr, failure); };
  return static_cast<int>(run_program(app, argc, argv, std::cout, tell, action));
}

}  // namespace strainwave

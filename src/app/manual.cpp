#include "app/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/version.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <set>
#include <sstream>

#include "app/commands.hpp"

namespace gnomon::app {

namespace {

/// Text as roff prints it unchanged.
std::string roff(const std::string& text) {
  std::string result;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    begins = c == '\n';
  }
  return result;
}

/// A section whose lines stay as they are.
std::string section(const std::string& title, const std::string& text) {
  return fmt::format(".SH {}\n.nf\n{}\n.fi\n", title, roff(text));
}

std::string option_text(const CLI::Option& option) {
  const std::string value = option.get_items_expected_max() > 0 ? option.get_type_name() : "";
  return fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", roff(option.get_name(false, true)), roff(value),
                     roff(option.get_description()));
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string command_text(const CLI::App& command, const std::string& parent) {
  std::string arguments, options;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional())
      arguments += " " + option->get_name(true);
    else if (option->get_name(false, true) != "-h,--help")
      options += option_text(*option);
  const std::string words = parent + " " + command.get_name();
  std::string text = fmt::format(".SS {}{}\n{}.\n{}", roff(words), roff(arguments),
                                 roff(command.get_description()), options);
  for (const CLI::App* part : commands(command)) text += command_text(*part, words);
  return text;
}

/// The keys of all scenes that have a fixed name.
std::set<std::string> fixed_keys() {
  std::set<std::string> names;
  for (const Problem& problem : Problems::all())
    for (const Key& key : key_table(problem.name))
      if (key.name.find_first_of("*#\"") == std::string::npos) names.insert(key.name);
  return names;
}

std::string long_options(const CLI::App& app) {
  std::string words;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
  return words;
}

constexpr const char* environment_text =
    R"(GNOMON_PLUGINS   plug-ins to load, separated by colons
GNOMON_PREFIX    the folder of the installation, where it is not found beside the program
OMP_NUM_THREADS  threads of assembly and factorizations)";

constexpr const char* completion_head = R"(# bash completion of gnomon
_gnomon() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command= words= i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
      --plugin) ((i++)) ;;
      -*) ;;
      *) command=${COMP_WORDS[i]}; break ;;
    esac
  done
)";

constexpr const char* completion_tail = R"(  esac
  COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
}
complete -o filenames -F _gnomon gnomon
)";

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH GNOMON 1 \"\" \"gnomon {}\"\n.SH NAME\ngnomon \\- {}\n.SH SYNOPSIS\n\\fBgnomon\\fR "
      "[\\-\\-plugin FILE.so] COMMAND [OPTIONS]\n.SH OPTIONS\n",
      version, "computes how wear changes the shape of bodies over time");
  for (const CLI::Option* option : app.get_options()) text += option_text(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands(app)) text += command_text(*command, "gnomon");
  for (const std::string& topic : help_topics()) {
    std::string title = topic == "exit-codes" ? "EXIT STATUS" : topic;
    std::transform(title.begin(), title.end(), title.begin(), ::toupper);
    text += section(title, topic_text(topic));
  }
  return text + section("ENVIRONMENT", environment_text);
}

std::string bash_completion(const CLI::App& app) {
  std::string text = completion_head;
  text += fmt::format(
      "  case $previous in\n"
      "    --integrator) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n"
      "    --set) COMPREPLY=($(compgen -S = -W \"{}\" -- \"$word\")); compopt -o nospace; return "
      ";;\n"
      "  esac\n",
      fmt::join(Integrators::names(), " "), fmt::join(fixed_keys(), " "));
  std::string names;
  for (const CLI::App* command : commands(app)) names += command->get_name() + " ";
  text +=
      fmt::format("  case $command in\n    \"\") words=\"{}{}\" ;;\n", names, long_options(app));
  for (const CLI::App* command : commands(app)) {
    std::string words = long_options(*command);
    if (command->get_name() == "list") words += fmt::format("{}", fmt::join(list_subjects(), " "));
    for (const CLI::App* part : commands(*command)) words += part->get_name() + " ";
    if (command->get_name() == "help")
      words += fmt::format("{} commands {}", fmt::join(help_topics(), " "), names);
    text += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), words);
  }
  return text + completion_tail;
}

}  // namespace gnomon::app

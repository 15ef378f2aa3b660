#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/version.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <map>
#include <set>

#include "app/command_line.hpp"
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
  const bool named = !option.get_positional();
  const std::string value =
      named && option.get_items_expected_max() > 0 ? option.get_type_name() : "";
  return fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", roff(option.get_name(!named, named)), roff(value),
                     roff(option.get_description()));
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string command_text(const CLI::App& command, const std::string& parent) {
  std::string arguments, explained, options;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      arguments += " " + option->get_name(true);
      explained += option_text(*option);
    } else if (option->get_name(false, true) != "-h,--help") {
      options += option_text(*option);
    }
  }
  const std::string words = parent + " " + command.get_name();
  std::string text = fmt::format(".SS {}{}\n{}.\n{}{}", roff(words), roff(arguments),
                                 roff(command.get_description()), explained, options);
  for (const CLI::App* part : commands(command)) text += command_text(*part, words);
  return text;
}

/// In place of the values of a key that names a file; no value has a blank.
constexpr const char* names_of_files = "names of files";

/// The keys of all scenes that have a fixed name, each with the names that it accepts: none where
/// it accepts others, or numbers.
std::map<std::string, std::set<std::string>> fixed_keys() {
  std::map<std::string, std::set<std::string>> keys;
  for (const Problem& problem : Problems::all())
    for (const Key& key : key_table(problem.name)) {
      if (key.name.find_first_of("*#\"") != std::string::npos) continue;
      std::set<std::string>& values = keys[key.name];
      values.insert(key.choices.begin(), key.choices.end());
      if (key.kind == KeyKind::flag) values = {"false", "true"};
      if (key.names_file) values = {names_of_files};
    }
  return keys;
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
  local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD-1]}
  local command= part= key= prefix= words= i
  # Where bash takes words apart at "=", as it does by default: --set KEY = VALUE, --option = VALUE.
  if [[ $word == "=" ]]; then
    key=$option word=
  elif [[ $option == "=" ]]; then
    key=${COMP_WORDS[COMP_CWORD-2]}
  elif [[ $option == --set && $word == *=* ]]; then
    key=${word%%=*} prefix=$key= word=${word#*=}
  fi
  [[ $key == --* ]] && option=$key key=
  for ((i = 1; i < COMP_CWORD; i++)); do
    case $command:${COMP_WORDS[i]} in
      :--plugin) ((i++)) ;;
      *:-* | *:=) ;;
      :*) command=${COMP_WORDS[i]} ;;
      help:scene | study:plan | study:run | study:collect) part=${COMP_WORDS[i]} ;;
    esac
  done
)";

constexpr const char* completion_tail = R"(  esac
  COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
}
complete -o filenames -F _gnomon gnomon
)";

/// What stands behind `--set KEY=`, and behind options with names as values.
std::string completion_of_values() {
  std::string keys, values;
  for (const auto& [key, names] : fixed_keys()) {
    keys += key + " ";
    if (names.contains(names_of_files))
      values +=
          fmt::format("      {}) COMPREPLY=($(compgen -P \"$prefix\" -f -- \"$word\")) ;;\n", key);
    else if (!names.empty())
      values += fmt::format("      {}) words=\"{}\" ;;\n", key, fmt::join(names, " "));
  }
  return fmt::format(
      "  if [[ $key ]]; then\n"
      "    case $key in\n{}    esac\n"
      "    [[ $words ]] && COMPREPLY=($(compgen -P \"$prefix\" -W \"$words\" -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case $option in\n"
      "    --integrator) COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return ;;\n"
      "    --executor) COMPREPLY=($(compgen -W \"local slurm\" -- \"$word\")); return ;;\n"
      "    --set)\n"
      "      COMPREPLY=($(compgen -S = -W \"{}\" -- \"$word\"))\n"
      "      compopt -o nospace +o filenames  # which would write KEY\\=\n"
      "      return ;;\n"
      "  esac\n",
      values, fmt::join(Integrators::names(), " "), keys);
}

/// What stands where a command takes it: its options, the names of its parts and subjects.
std::string words_of(const CLI::App& command) {
  std::string words = long_options(command);
  for (const CLI::App* part : commands(command)) words += part->get_name() + " ";
  if (command.get_name() == "list") words += fmt::format("{}", fmt::join(list_subjects(), " "));
  return words;
}

/// What `gnomon help` explains; scene is a topic and a command.
std::string topics(const CLI::App& app) {
  std::set<std::string> names(help_topics().begin(), help_topics().end());
  names.insert("commands");
  for (const CLI::App* command : commands(app)) names.insert(command->get_name());
  return fmt::format("{}", fmt::join(names, " "));
}

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
  std::string names, cases;
  for (const CLI::App* command : commands(app)) names += command->get_name() + " ";
  const auto add = [&](const std::string& given, const std::string& words) {
    cases += fmt::format("    \"{}\") words=\"{}\" ;;\n", given, words);
  };
  add(" ", names + long_options(app));
  for (const CLI::App* command : commands(app)) {
    const std::string name = command->get_name();
    add(name + " ", name == "help" ? topics(app) : words_of(*command));
    for (const CLI::App* part : commands(*command))
      add(name + " " + part->get_name(), words_of(*part));
  }
  add("help scene", fmt::format("{}", fmt::join(Problems::names(), " ")));
  return completion_head + completion_of_values() +
         fmt::format("  case \"$command $part\" in\n{}", cases) + completion_tail;
}

}  // namespace gnomon::app

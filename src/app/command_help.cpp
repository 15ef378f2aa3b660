// gnomon help TOPIC and gnomon --version.

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/study/study.hpp>
#include <gnomon/study/versions.hpp>

#include "app/commands.hpp"
#include "app/help_texts.hpp"
#include "app/program.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

std::string scene_help(const std::optional<std::string>& problem) {
  if (problem) return describe_keys(key_table(*problem));
  std::string text =
      fmt::format("{}\nKEYS OF EVERY SCENE\n\n{}", scene_topic, describe_keys(run_keys()));
  for (const Problem& entry : Problems::all())
    text += fmt::format("\nKEYS OF {}: {}\n\n{}", entry.name, entry.help,
                        describe_keys(own_keys(entry)));
  return text;
}

std::string integrators_help() {
  std::string text;
  for (const Integrator& entry : Integrators::all())
    text += fmt::format("{}: {}\n    {}; order {}; stability {}; error {}; driven by {}\n",
                        entry.name, entry.help, entry.family, entry.order, entry.stability,
                        entry.error_estimate, entry.driver);
  return text + "\n" + integrators_topic;
}

}  // namespace

int help_command(const std::string& topic, const std::optional<std::string>& problem,
                 const std::vector<std::string>& further_topics) {
  if (topic == "scene") {
    fmt::print("{}", scene_help(problem));
  } else if (topic == "studies") {
    fmt::print("{}{}", studies_topic, describe_study_keys());
  } else if (topic == "integrators") {
    fmt::print("{}", integrators_help());
  } else if (topic == "units") {
    fmt::print("{}", units_topic);
  } else if (topic == "output") {
    fmt::print("{}", output_topic);
  } else if (topic == "exit-codes") {
    fmt::print("{}", exit_codes_topic);
  } else {
    std::vector<std::string> topics = {"scene", "studies", "integrators", "commands",
                                       "units", "output",  "exit-codes"};
    topics.insert(topics.end(), further_topics.begin(), further_topics.end());
    const std::string near = nearest_name(topic, topics);
    throw InputError(
        fmt::format("unknown topic `{}`, {}", topic,
                    near.empty() ? "see `gnomon help`" : "did you mean `" + near + "`?"));
  }
  return success;
}

int version_command() {
  const auto versions = library_versions();
  fmt::print("gnomon {}\n", versions.at("gnomon"));
  for (const auto& [name, version] : versions)
    if (name != "gnomon") fmt::print("  {} {}\n", name, version);
  return success;
}

}  // namespace gnomon::app

// gnomon help TOPIC and gnomon --version.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/versions.hpp>
#include <gnomon/study/study.hpp>

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
  for (const Integrator& entry : Integrators::all())
    if (!entry.keys.empty())
      text += fmt::format("\nFURTHER KEYS OF {}\n\n{}", entry.name, describe_keys(entry.keys));
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
                        entry.error_estimate, entry.driver) +
            describe_keys(entry.keys);
  return text + "\n" + integrators_topic;
}

}  // namespace

const std::vector<std::string>& help_topics() {
  static const std::vector<std::string> topics = {"scene", "studies", "integrators",
                                                  "units", "output",  "exit-codes"};
  return topics;
}

std::string topic_text(const std::string& topic) {
  if (topic == "scene") return scene_help({});
  if (topic == "studies") return studies_topic + describe_study_keys();
  if (topic == "integrators") return integrators_help();
  if (topic == "units") return units_topic;
  if (topic == "output") return output_topic;
  return exit_codes_topic;
}

int help_command(const std::string& topic, const std::optional<std::string>& problem,
                 const std::vector<std::string>& further_topics) {
  std::vector<std::string> topics = help_topics();
  if (std::find(topics.begin(), topics.end(), topic) == topics.end()) {
    topics.insert(topics.end(), further_topics.begin(), further_topics.end());
    const std::string near = nearest_name(topic, topics);
    throw InputError(
        fmt::format("unknown topic `{}`, {}", topic,
                    near.empty() ? "see `gnomon help`" : "did you mean `" + near + "`?"));
  }
  fmt::print("{}", topic == "scene" ? scene_help(problem) : topic_text(topic));
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

// gnomon compare: a table of results, with their errors against one of them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <optional>
#include <set>

#include "app/commands.hpp"
#include "app/program.hpp"
#include "app/result_errors.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

using Align = TextTable::Align;

/// None if another version of gnomon wrote it; everything else can still be compared.
std::optional<Scene> scene_of(const RunHeader& header, const std::filesystem::path& file) {
  try {
    return parse_scene(header.scene, file.string(), {}, key_table);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The setting that determines the run's accuracy: "step 5 s" or "rtol 1e-4".
std::string setting(const std::optional<Scene>& scene) {
  if (!scene) return "?";
  if (scene->has("integrator.step"))
    return fmt::format("step {:g} s", scene->real("integrator.step"));
  return fmt::format("rtol {:g}", scene->real("integrator.rtol"));
}

/// Compares scenes with the first one given, except for keys of integration and output.
class SceneDifferences {
public:
  void add(const std::filesystem::path& file) {
    const auto scene = scene_of(ResultReader(file).header(), file);
    if (!scene) {
      unreadable_.insert(file.string());
    } else if (!first_) {
      first_ = scene;
    } else {
      for (const std::string& key : Scene::differing_keys(*first_, *scene))
        if (!key.starts_with("integrator.") && !key.starts_with("output.")) keys_.insert(key);
    }
  }
  std::string notes() const {
    std::string text;
    for (const std::string& file : unreadable_)
      text += fmt::format("\nnote: the scene of {} was not compared, this version cannot read it\n",
                          file);
    if (!keys_.empty())
      text += fmt::format("\nnote: the scenes differ in {}\n", fmt::join(keys_, ", "));
    return text;
  }

private:
  std::optional<Scene> first_;
  std::set<std::string> keys_;
  std::set<std::string> unreadable_;
};

std::string worn_volume(const HistoryRow& row) {
  const Scalar* const worn = find_scalar(row.scalars, "worn_volume");
  return worn ? fmt::format("{:.6g} {}", worn->value, worn->unit) : "-";
}

/// The file, and how its run ended unless it finished.
std::string name_and_status(const std::filesystem::path& file, const ResultReader& result,
                            double t) {
  const std::string status = result.status();
  if (status == "finished") return file.filename().string();
  return fmt::format("{} (at t = {:g} s: {})", file.filename().string(), t, status);
}

void add_row(TextTable& table, const std::filesystem::path& file, const ResultErrors& errors) {
  const ResultReader result(file);
  const std::vector<HistoryRow> history = result.history();
  const HistoryRow last = history.empty() ? HistoryRow{} : history.back();
  const Counters& c = last.counters;
  const ResultError error = errors.against(file, result);
  const auto count = [](long value) { return fmt::format("{}", value); };
  table.add({result.header().integrator, setting(scene_of(result.header(), file)), count(c.steps),
             count(c.rejected_steps), count(c.newton_iterations), count(c.factorizations),
             fmt::format("{:.2f}", result.wall_seconds()), worn_volume(last), error.shape,
             error.pressure, name_and_status(file, result, last.t)});
}

}  // namespace

int compare_command(const std::vector<std::filesystem::path>& results,
                    const std::filesystem::path& reference) {
  const std::filesystem::path& chosen = reference.empty() ? results.back() : reference;
  const ResultErrors errors{chosen};
  TextTable table({{"integrator"},
                   {"setting"},
                   {"steps", Align::right},
                   {"rejected", Align::right},
                   {"Newton", Align::right},
                   {"factors", Align::right},
                   {"wall [s]", Align::right},
                   {"worn volume", Align::right},
                   {"shape error [mm]", Align::right},
                   {"pressure error [MPa]", Align::right},
                   {"result"}});
  for (const auto& file : results) add_row(table, file, errors);
  fmt::print(
      "{}\nshape error: Euclidean norm of the differences of worn contact-node positions to the\n"
      "reference, {}, in the last stored state;\n"
      "pressure error: largest difference of a nodal contact pressure\n",
      table.text(), chosen.string());
  SceneDifferences differences;
  differences.add(chosen);
  for (const auto& file : results)
    if (!std::filesystem::equivalent(file, chosen)) differences.add(file);
  fmt::print("{}", differences.notes());
  return success;
}

}  // namespace gnomon::app

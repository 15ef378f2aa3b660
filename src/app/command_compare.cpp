// gnomon compare: a table of results, with their errors against one of them.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/base/error.hpp>
#include <gnomon/base/same_time.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/results/surface_difference.hpp>
#include <optional>
#include <set>

#include "app/commands.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

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

/// In what the scenes of these results differ from the first one, except for keys of integration
/// and output.
std::string notes_on_scenes(const std::vector<std::filesystem::path>& files) {
  std::optional<Scene> first;
  std::set<std::string> keys, unreadable;
  for (const auto& file : files) {
    const auto scene = scene_of(ResultReader(file).header(), file);
    if (!scene) unreadable.insert(file.string());
    if (!first) first = scene;
    if (!scene) continue;
    for (const std::string& key : Scene::differing_keys(*first, *scene))
      if (!key.starts_with("integrator.") && !key.starts_with("output.")) keys.insert(key);
  }
  std::string text;
  for (const std::string& file : unreadable)
    text += fmt::format("\nnote: the scene of {} was not compared, this version cannot read it\n",
                        file);
  if (!keys.empty())
    text += fmt::format("\nnote: the scenes differ in {}\n", fmt::join(keys, ", "));
  return text;
}

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

/// As texts: numbers, or why there are none.
struct ResultError {
  std::string shape;     ///< the paper's error [length]; "other time", "other dimension"
  std::string pressure;  ///< largest difference of a nodal contact pressure [stress]; "-" for none
};

/// The result with which others are compared.
struct Reference {
  explicit Reference(const std::filesystem::path& name) : file(name) {
    const ResultReader result(file);
    surface = result.contact(std::nullopt);
    time = result.stored_times().back();
  }
  std::filesystem::path file;
  ContactSurface surface;
  double time = 0;
};

/// Errors of the last stored state of `result`, read from `file`.
ResultError error_of(const std::filesystem::path& file, const ResultReader& result,
                     const Reference& reference) {
  if (std::filesystem::equivalent(file, reference.file)) return {"reference", "-"};
  if (result.stored_times().empty()) return {"nothing stored", "-"};
  const ContactSurface surface = result.contact(std::nullopt);
  if (!same_time(result.stored_times().back(), reference.time)) return {"other time", "-"};
  if (surface.dim != reference.surface.dim) return {"other dimension", "-"};
  return {fmt::format("{:.3e}", shape_error(surface, reference.surface)),
          fmt::format("{:.3e}", pressure_error(surface, reference.surface))};
}

void add_row(TextTable& table, const std::filesystem::path& file, const Reference& reference) {
  const ResultReader result(file);
  const std::vector<HistoryRow> history = result.history();
  const HistoryRow last = history.empty() ? HistoryRow{} : history.back();
  const Counters& c = last.counters;
  const ResultError error = error_of(file, result, reference);
  const auto count = [](long value) { return fmt::format("{}", value); };
  table.add({result.header().integrator, setting(scene_of(result.header(), file)), count(c.steps),
             count(c.rejected_steps), count(c.newton_iterations), count(c.factorizations),
             fmt::format("{:.2f}", result.wall_seconds()), worn_volume(last), error.shape,
             error.pressure, name_and_status(file, result, last.t)});
}

}  // namespace

void compare_command(const std::vector<std::filesystem::path>& results,
                     const std::filesystem::path& reference) {
  const std::filesystem::path& chosen = reference.empty() ? results.back() : reference;
  const Reference chosen_result(chosen);
  TextTable table("llrrrrrrrrl",
                  {"integrator", "setting", "steps", "rejected", "Newton", "factors", "wall [s]",
                   "worn volume", "shape error [mm]", "pressure error [MPa]", "result"});
  for (const auto& file : results) add_row(table, file, chosen_result);
  fmt::print(
      "{}\nshape error: Euclidean norm of the differences of worn contact-node positions to the\n"
      "reference, {}, in the last stored state (docs/studies.md);\n"
      "pressure error: largest difference of a nodal contact pressure\n",
      table.text(), chosen.string());
  std::vector<std::filesystem::path> files = {chosen};
  for (const auto& file : results)
    if (!std::filesystem::equivalent(file, chosen)) files.push_back(file);
  fmt::print("{}", notes_on_scenes(files));
}

}  // namespace gnomon::app

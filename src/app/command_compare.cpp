// gnomon compare: results side by side, with the paper's error against one of them.

#include <fmt/format.h>

#include <gnomon/error.hpp>
#include <gnomon/problem.hpp>
#include <gnomon/results.hpp>

#include "app/commands.hpp"
#include "app/program.hpp"
#include "app/shape_error.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

using Align = TextTable::Align;

/// What the run's accuracy was asked for with: "step 5 s" or "rtol 1e-4".
std::string setting(const RunHeader& header, const std::string& file) {
  try {
    const Scene scene = parse_scene(header.scene, file, {}, key_table);
    if (scene.has("integrator.step"))
      return fmt::format("step {:g} s", scene.real("integrator.step"));
    return fmt::format("rtol {:g}", scene.real("integrator.rtol"));
  } catch (const InputError&) {
    return "?";  // written by another version of gnomon; all else can still be compared
  }
}

std::string worn_volume(const HistoryRow& row) {
  for (const Scalar& scalar : row.scalars)
    if (scalar.name == "worn_volume") return fmt::format("{:.6g} {}", scalar.value, scalar.unit);
  return "-";
}

/// The file, and how its run ended if not well.
std::string name_and_status(const std::filesystem::path& file, const ResultReader& result,
                            double t) {
  const std::string status = result.status();
  if (status == "finished") return file.filename().string();
  return fmt::format("{} (at t = {:g} s: {})", file.filename().string(), t, status);
}

void add_row(TextTable& table, const std::filesystem::path& file, const ShapeErrors& errors) {
  const ResultReader result(file);
  const std::vector<HistoryRow> history = result.history();
  const HistoryRow last = history.empty() ? HistoryRow{} : history.back();
  const Counters& c = last.counters;
  const auto count = [](long value) { return fmt::format("{}", value); };
  table.add({result.header().integrator, setting(result.header(), file.string()), count(c.steps),
             count(c.rejected_steps), count(c.newton_iterations), count(c.factorizations),
             fmt::format("{:.2f}", result.wall_seconds()), worn_volume(last),
             errors.against(file, result), name_and_status(file, result, last.t)});
}

}  // namespace

int compare_command(const std::vector<std::filesystem::path>& results,
                    const std::filesystem::path& reference) {
  const std::filesystem::path& chosen = reference.empty() ? results.back() : reference;
  const ShapeErrors errors{chosen};
  TextTable table({{"integrator"},
                   {"setting"},
                   {"steps", Align::right},
                   {"rejected", Align::right},
                   {"Newton", Align::right},
                   {"factors", Align::right},
                   {"wall [s]", Align::right},
                   {"worn volume", Align::right},
                   {"shape error", Align::right},
                   {"result"}});
  for (const auto& file : results) add_row(table, file, errors);
  fmt::print(
      "{}\nshape error: Euclidean norm of the differences of worn contact-node positions to the\n"
      "reference, {}, in the last stored state\n",
      table.text(), chosen.string());
  return success;
}

}  // namespace gnomon::app

// gnomon compare: results side by side, with the paper's error against one of them.

#include <cmath>

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
    const Integrator& integrator = Integrators::find(header.integrator, "integrator");
    if (integrator.step_control == "adaptive")
      return fmt::format("rtol {:g}", scene.real("integrator.rtol"));
    return fmt::format("step {:g} s",
                       scene.real_if("integrator.step").value_or(scene.real("time.end") / 200));
  } catch (const InputError&) {
    return "?";  // written by another version of gnomon; all else can still be compared
  }
}

std::string scalar_text(const HistoryRow& row, const std::string& name) {
  for (const Scalar& scalar : row.scalars)
    if (scalar.name == name) return fmt::format("{:.6g}", scalar.value);
  return "-";
}

std::string error_text(const ShapeErrors& errors, const ResultReader& result) {
  if (result.stored_times().empty()) return "-";
  return errors.against(result);
}

void add_row(TextTable& table, const std::filesystem::path& file, const ShapeErrors& errors) {
  const ResultReader result(file);
  const std::vector<HistoryRow> history = result.history();
  const HistoryRow last = history.empty() ? HistoryRow{} : history.back();
  const Counters& c = last.counters;
  const auto count = [](long value) { return fmt::format("{}", value); };
  const std::string status = result.status();
  table.add({file.stem().string(), result.header().integrator,
             setting(result.header(), file.string()), fmt::format("{:g}", last.t), count(c.steps),
             count(c.rejected_steps), count(c.newton_iterations), count(c.factorizations),
             fmt::format("{:.2f}", result.wall_seconds()), scalar_text(last, "worn_volume"),
             error_text(errors, result), status == "finished" ? "" : status});
}

}  // namespace

int compare_command(const std::vector<std::filesystem::path>& results,
                    const std::filesystem::path& reference) {
  const std::filesystem::path& chosen = reference.empty() ? results.back() : reference;
  const ShapeErrors errors{chosen};
  TextTable table({{"result"},
                   {"integrator"},
                   {"setting"},
                   {"t [s]", Align::right},
                   {"steps", Align::right},
                   {"rejected", Align::right},
                   {"Newton", Align::right},
                   {"factor.", Align::right},
                   {"wall [s]", Align::right},
                   {"worn volume", Align::right},
                   {"shape error", Align::right},
                   {}});
  for (const auto& file : results) add_row(table, file, errors);
  fmt::print("{}\nshape error [mm]: Euclidean norm of the difference of worn contact-node positions "
             "in the last\nstored state to {}\n",
             table.text(), chosen.string());
  return success;
}

}  // namespace gnomon::app

// gnomon info, contact, scene and history: the contents of a result file.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/counter_names.hpp>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/budget.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/run/summary.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <optional>
#include <sstream>

#include "app/commands.hpp"
#include "app/text_table.hpp"
#include "study/table.hpp"

namespace gnomon::app {

namespace {

std::string blocks_text(const std::vector<BlockSize>& blocks) {
  std::vector<std::string> parts;
  long total = 0;
  for (const BlockSize& block : blocks) {
    parts.push_back(fmt::format("{} {}", block.name, block.size));
    total += block.size;
  }
  return fmt::format("{} ({})", total, fmt::join(parts, ", "));
}

/// At most one or two lines, also for many stored times.
std::string times_text(const std::vector<double>& times) {
  constexpr std::size_t most = 12;
  if (times.empty()) return "none";
  if (times.size() <= most) return fmt::format("{:g}", fmt::join(times, ", "));
  const std::vector<double> first(times.begin(), times.begin() + most / 2);
  const std::vector<double> last(times.end() - most / 2, times.end());
  return fmt::format("{:g}, ..., {:g} ({} in total)", fmt::join(first, ", "), fmt::join(last, ", "),
                     times.size());
}

/// A line of a scene, where arrays of many numbers are shortened: "times = [50, 100, ..., 1000]  #
/// 20 in total".
std::string shortened(const std::string& line) {
  constexpr std::size_t most = 12;  // numbers
  const std::size_t open = line.find("= ["), close = line.find(']');
  if (open == std::string::npos || close == std::string::npos) return line;
  const std::string inside = line.substr(open + 3, close - open - 3);
  const auto count = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), ',')) + 1;
  if (count <= most || inside.find('"') != std::string::npos) return line;
  std::size_t second = inside.find(',', inside.find(',') + 1);
  return fmt::format("{}{}, ...,{}]  # {} in total{}", line.substr(0, open + 3),
                     inside.substr(0, second), inside.substr(inside.rfind(',') + 1), count,
                     line.substr(close + 1));
}

std::string shortened_scene(const std::string& scene) {
  std::string result, line;
  for (std::istringstream lines(scene); std::getline(lines, line);)
    result += shortened(line) + "\n";
  return result;
}

void print_history(const HistoryRow& last) {
  TextTable table("lrl");
  table.add({"t", fmt::format("{:.8g}", last.t), "s"});
  for (const Scalar& scalar : last.scalars)
    table.add({scalar.name, fmt::format("{:.8g}", scalar.value), scalar.unit});
  for (const NamedCounter& counter : named_counters) {
    const bool of_block_solver = counter.value == &Counters::krylov_iterations ||
                                 counter.value == &Counters::preconditioner_setups;
    if (!of_block_solver || last.counters.preconditioner_setups > 0)
      table.add({counter.name, fmt::format("{}", last.counters.*counter.value), ""});
  }
  fmt::print("\nat the end:\n{}", table.text());
  if (const std::string ledger = ledger_text(last.scalars); !ledger.empty())
    fmt::print("{}\n", ledger);
}

/// For each node of the contact surface the name of its wearing surface, that of the first in the
/// scene where two meet; empty where the scene has one wearing surface, or does not name it.
std::vector<std::string> surface_names(const ResultReader& result, const ContactSurface& contact,
                                       const std::filesystem::path& file) {
  const std::optional<Grid> grid = result.grid();
  if (!grid || grid->parts.empty()) return {};  // of a built-in problem
  const Scene scene = scene_of_result(result, file);
  if (!scene.knows("wear.on") || scene.texts("wear.on").size() < 2) return {};
  std::map<int, std::string> name_of;
  for (const std::string& name : scene.texts("wear.on"))
    for (const MeshPart& part : grid->parts)
      if (part.kind == MeshPart::Kind::facets && part.name == name)
        for (int node : part.nodes) name_of.try_emplace(node, name);
  std::vector<std::string> names;
  for (int node : contact.node) names.push_back(name_of[node]);
  return names;
}

void print_contact_row(const ContactSurface& surface, std::size_t i, const std::string& end) {
  std::string row = fmt::format("{}", surface.node[i]);
  for (const auto* points : {&surface.initial, &surface.worn, &surface.current})
    for (int component = 0; component < surface.dim; ++component)
      row += fmt::format(",{}", (*points)[i][static_cast<std::size_t>(component)]);
  fmt::print("{},{},{},{}{}\n", row, surface.pressure[i], surface.wear_depth[i], surface.active[i],
             end);
}

}  // namespace

void info_command(const std::filesystem::path& file) {
  const ResultReader result(file);
  const RunHeader& header = result.header();
  TextTable table("ll");
  table.add({"problem", header.problem});
  table.add({"integrator", header.integrator});
  table.add({"status", result.status()});
  const double seconds = result.wall_seconds();
  table.add({"wall time", seconds > 0 ? fmt::format("{:.3g} s", seconds)
                                      : "not known: the run goes on, or was killed"});
  table.add({"unknowns", blocks_text(header.blocks)});
  if (const auto grid = result.grid())
    table.add(
        {"mesh", fmt::format("{} points, {} cells", grid->points.size(), grid->cell_count())});
  const std::vector<std::string> fields = result.field_names();
  table.add({"fields", fields.empty() ? "none" : fmt::format("{}", fmt::join(fields, ", "))});
  table.add({"stored at t", times_text(result.stored_times())});
  std::vector<std::string> versions;
  for (const auto& [name, version] : header.versions)
    versions.push_back(fmt::format("{} {}", name, version));
  table.add({"versions", fmt::format("{}", fmt::join(versions, ", "))});
  fmt::print("{}", table.text());
  const auto history = result.history();
  if (history.empty())
    fmt::print("\nno state is recorded, not even the start\n");
  else
    print_history(history.back());
  if (const std::string text = phase_error_text(result.phase_errors()); !text.empty())
    fmt::print("{}\n", text);
  if (const std::string budget = result.budget(); !budget.empty())
    fmt::print("error budget:\n{}", budget_text(budget_of_json(budget)));
  fmt::print("\nscene (gnomon scene prints it in full):\n{}", shortened_scene(header.scene));
}

void scene_command(const std::filesystem::path& file) {
  const ResultReader result(file);
  const std::optional<Grid> grid = result.grid();
  if (grid && !grid->parts.empty())  // else the problem makes its mesh itself
    fmt::print(
        "# The mesh is in the result too: gnomon mesh {} -o PART.msh writes it, for mesh.file "
        "in the place of what\n# [mesh] says below.\n\n",
        file.string());
  fmt::print("{}", result.header().scene);
}

void history_command(const std::filesystem::path& file) {
  const auto history = ResultReader(file).history();
  if (history.empty())
    throw InputError(file.string() + ": no state is recorded, not even the start");
  fmt::print("t,step,order,newton_iterations,factorizations");
  for (const Scalar& scalar : history.front().scalars)
    fmt::print(",{}", study::csv_text(scalar.unit.empty()
                                          ? scalar.name
                                          : fmt::format("{} [{}]", scalar.name, scalar.unit)));
  fmt::print("\n");
  for (const HistoryRow& row : history) {
    fmt::print("{},{},{},{},{}", row.t, row.step.step, row.step.order,
               row.counters.newton_iterations, row.counters.factorizations);
    for (const Scalar& scalar : row.scalars) fmt::print(",{}", scalar.value);
    fmt::print("\n");
  }
}

void contact_command(const std::filesystem::path& file, const std::string& time) {
  const ResultReader result(file);
  std::optional<double> stored;
  if (!time.empty()) stored = stored_time(result.stored_times(), time, file.string());
  const ContactSurface surface = result.contact(stored);
  const std::vector<std::string> names = surface_names(result, surface, file);
  std::string header = "node";
  for (const char* ending : {"XYZ0", "XYZ", "xyz"})
    for (int i = 0; i < surface.dim; ++i)
      header += fmt::format(",{}{} [mm]", ending[i], ending[3] ? "0" : "");
  fmt::print("{},pressure [MPa],wear_depth [mm],active{}\n", header,
             names.empty() ? "" : ",surface");
  for (std::size_t i = 0; i < surface.node.size(); ++i)
    print_contact_row(surface, i,
                      names.empty() ? "" : fmt::format(",{}", study::csv_text(names[i])));
}

}  // namespace gnomon::app

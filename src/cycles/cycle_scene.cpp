#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/profile.hpp>

#include "expressions/expression_tables.hpp"

namespace gnomon {

namespace {

constexpr double most_phases = 4096;

/// Where the scene gives their number, or no phases at all.
std::optional<Scene> with_scaled_phases(const Scene& scene, double factor) {
  constexpr double usual = 16, fewest = 4;
  if (!scene.has("cycle.period") || chooses_phases(scene)) return {};
  const std::vector<double> phases =
      scene.given("cycle.phases") ? scene.reals("cycle.phases") : std::vector<double>{usual};
  if (phases.size() != 1 || phases[0] < 1) return {};
  const double count = std::round(phases[0] / factor);
  if (count < (factor > 1 ? fewest : 1) || count > most_phases) return {};
  return with_phases(scene, static_cast<long>(count));
}

/// For a plan, where the scene does not say.
std::optional<Scene> with_first_phases(const Scene& scene) {
  if (scene.is_set("cycle.phases")) return {};
  return with_scaled_phases(scene, 1);
}

std::vector<Key> make_keys() {
  return {
      real_key("cycle.period", "s", absent("no cycle"), positive_quantity,
               "duration of a cycle of motion and load, over which wear is averaged"),
      resumable(real_key("time.cycles", "", absent("time.end is given"), positive_quantity,
                         "end of the run in cycles, instead of time.end")),
      {.name = "cycle.phases",
       .kind = KeyKind::reals,
       .absent_meaning = "needed by cycle.period; chosen where accuracy.within is given",
       .range = {.min = 0, .max = most_phases},
       .or_single = Range{.min = 1, .max = most_phases},
       .or_text = "auto",
       .help = "phases of a cycle: their number, their positions in [0, 1), ascending, or "
               "\"auto\": a number that fits integrator.rtol",
       .controls = ErrorControl{.source = ErrorSource::phases,
                                .scaled = with_scaled_phases,
                                .chosen = with_first_phases}},
      cycle_function_key(
          "cycle.x", "mm",
          std::string("displacement of the counter-body along x") + cycle_function_form),
      cycle_function_key("cycle.y", "mm", "along y"),
      cycle_function_key("cycle.z", "mm",
                         "along z; in plane strain out of the plane, axisymmetric along the axis"),
      cycle_function_key(
          "cycle.rotation", "rad",
          "rotation of the counter-body about counter_body.motion.center (in 3D about "
          ".axis) from its place"),
      cycle_function_key("cycle.force", "N",
                         "force along counter_body.press.direction, instead of .force; above zero"),
      cycle_function_key("cycle.load", "", "factor of all [[load]]")};
}

/// Of the counter-body, and of bodies that the scene moves.
std::vector<std::string> function_names(const Scene& scene) {
  std::vector<std::string> names = {"cycle.x",        "cycle.y",     "cycle.z",
                                    "cycle.rotation", "cycle.force", "cycle.load"};
  for (const std::string of : {"x", "y", "z", "rotation"})
    for (const std::string& entry : scene.chosen_names("motion.#.cycle." + of))
      names.push_back(fmt::format("motion.{}.cycle.{}", entry, of));
  names.emplace_back("counter_body.press.cycle");
  for (const std::string& entry : scene.chosen_names("counter_body.press.#.cycle"))
    names.push_back("counter_body.press." + entry + ".cycle");
  for (const std::string& entry : scene.chosen_names("load.#.cycle"))
    names.push_back("load." + entry + ".cycle");
  return names;
}

bool is_file(const std::string& text) {
  return text.ends_with(".csv");
}

struct Points {
  std::vector<double> x, y;
};

Points points_of_file(const Scene& scene, const std::string& key) {
  Points points;
  for (const Vector<2>& point : read_points(scene, key)) {
    const double tau = point[0];
    if (!(tau >= 0 && tau <= 1) || (!points.x.empty() && tau < points.x.back()))
      throw InputError(fmt::format("{}: {}: expected ascending tau in [0, 1], got {:g} in point {}",
                                   scene.where(key), scene.text(key), tau, points.x.size() + 1));
    points.x.push_back(tau);
    points.y.push_back(point[1]);
  }
  return points;
}

ExpressionNames names_of(const Scene& scene) {
  ExpressionNames names;
  names.variables = {"tau"};
  add_tables(scene, names);
  return names;
}

/// The name of the table of a function in the scene of a result.
std::string file_table(const std::string& key) {
  std::string name = "file_" + (key.starts_with("cycle.") ? key.substr(6) : key);
  std::ranges::replace(name, '.', '_');
  return name;
}

/// The key of its arguments (x) or values (y).
Key table_key(const std::string& name, char axis) {
  for (Key key : worn_body_keys(2))
    if (key.name == std::string("tables.*.") + axis) {
      key.name.replace(key.name.find('*'), 1, name);
      return key;
    }
  return {};
}

std::optional<CycleFunction> read_function(const Scene& scene, const std::string& key,
                                           ExpressionNames names) {
  if (!scene.given(key)) return {};
  std::string text = scene.text(key);
  if (is_file(text)) {
    const std::string name = file_table(key);
    const Points points = points_of_file(scene, key);
    names.tables.insert_or_assign(name, linear_table(points.x, points.y, scene.where(key)));
    text = name + "(tau)";
  }
  try {
    CycleFunction function{Expression(text, names)};
    for (int k = 0; k < 1000; ++k)
      if (!std::isfinite(function.value(k / 1000.0)))
        throw InputError(
            fmt::format("{}: expected a finite value at all tau in [0, 1), got {} at tau = {:g}",
                        scene.where(key), function.value(k / 1000.0), k / 1000.0));
    return function;
  } catch (const ExpressionError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

/// Without a period nothing of [cycle] has a meaning.
void require_nothing_else(const Scene& scene) {
  for (const Key& key : cycle_keys())
    if (scene.given(key.name))
      throw InputError(scene.where(key.name) + ": expected also cycle.period");
}

}  // namespace

Key cycle_function_key(const std::string& name, const std::string& unit, const std::string& help) {
  return {.name = name,
          .kind = KeyKind::text,
          .unit = unit,
          .absent_meaning = "does not change over the cycle",
          .help = help};
}

std::optional<CycleFunction> read_cycle_function(const Scene& scene, const std::string& key) {
  return read_function(scene, key, names_of(scene));
}

const std::vector<Key>& cycle_keys() {
  static const std::vector<Key> keys = make_keys();
  return keys;
}

std::optional<Cycle> read_cycle(const Scene& scene) {
  if (!scene.knows("cycle.period")) return {};
  if (!scene.has("cycle.period")) {
    require_nothing_else(scene);
    return {};
  }
  if (!scene.has("cycle.phases"))
    throw InputError(scene.where("cycle.period") + ": expected also cycle.phases");
  Cycle cycle;
  cycle.period = scene.real("cycle.period");
  const auto read = [&scene, names = names_of(scene)](const char* key) {
    return read_function(scene, key, names);
  };
  cycle.displacement = {read("cycle.x"), read("cycle.y"), read("cycle.z")};
  cycle.rotation = read("cycle.rotation");
  cycle.force = read("cycle.force");
  cycle.load = read("cycle.load");
  return cycle;
}

std::vector<std::string> cycle_expressions(const Scene& scene) {
  std::vector<std::string> texts;
  for (const std::string& key : function_names(scene))
    if (scene.given(key) && !is_file(scene.text(key))) texts.push_back(scene.text(key));
  return texts;
}

CycleQuadrature read_cycle_quadrature(const Scene& scene, std::vector<double> kinks) {
  if (chooses_phases(scene))
    throw InputError(scene.where("cycle.phases") +
                     ": expected a number of phases, or positions: this problem does not choose "
                     "them");
  const std::vector<double>& phases = scene.reals("cycle.phases");
  const auto refuse = [&](const std::string& got) {
    throw InputError(
        fmt::format("{}: expected a number of phases, or ascending positions in [0, 1), got {}",
                    scene.where("cycle.phases"), got));
  };
  if (phases.empty()) refuse("none");
  if (phases.size() == 1 && phases[0] >= 1) {
    if (phases[0] != std::round(phases[0])) refuse(fmt::format("{}", phases[0]));
    return {static_cast<int>(phases[0]), std::move(kinks)};
  }
  for (std::size_t p = 0; p < phases.size(); ++p)
    if (!(phases[p] < 1) || (p > 0 && !(phases[p] > phases[p - 1])))
      refuse(fmt::format("{} at place {}", phases[p], p + 1));
  return {phases, std::move(kinks)};
}

bool chooses_phases(const Scene& scene) {
  return scene.knows("cycle.phases") && scene.has_text_instead("cycle.phases");
}

Scene with_phases(const Scene& scene, long count) {
  return scene.with("cycle.phases", std::vector<double>{static_cast<double>(count)});
}

double phase_tolerance(const Scene& scene) {
  return scene.has("integrator.step") ? phase_tolerance_of_fixed_steps
                                      : scene.real("integrator.rtol");
}

Scene with_cycle_tables(const Scene& scene) {
  if (!scene.knows("cycle.period")) return scene;
  Scene result = scene;
  for (const std::string& key : function_names(scene)) {
    if (!scene.given(key) || !is_file(scene.text(key))) continue;
    const Points points = points_of_file(scene, key);
    const std::string name = file_table(key);
    result = result.with(table_key(name, 'x'), points.x)
                 .with(table_key(name, 'y'), points.y)
                 .with(key, name + "(tau)");
  }
  return result;
}

}  // namespace gnomon

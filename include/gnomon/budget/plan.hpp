// Accuracy as one number: the settings that meet accuracy.within at the least cost, found by pilot
// runs on coarse meshes.
#pragma once

#include <gnomon/budget/budget.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// One choice of settings, with what the pilot runs predict for it.
struct PlanLine {
  double within = 0;     ///< error that may be, relative
  std::string settings;  ///< "mesh.factor = 0.5, integrator.rtol = 0.001"
  /// Relative errors, the largest of the wanted values. NaN where no pilot run tells.
  double mesh = 0, time = 0;
  double rest = 0;  ///< of models, phases and a mesh that is given
  double cpu_seconds = 0;

  double error() const { return mesh + time + rest; }
};

struct Plan {
  Scene scene;                    ///< with the chosen settings, and without accuracy.within
  std::vector<PlanLine> lines;    ///< for twice the error, the asked one, half and a quarter of it
  std::vector<BudgetPart> known;  ///< by pilot runs: of the models, and of a mesh that is given
  double pilot_seconds = 0;       ///< CPU time of the pilot runs [s]
  /// What the given settings cost or spoil, what could not be measured; one line each.
  std::vector<std::string> remarks;

  const PlanLine& chosen() const { return lines.at(1); }
};

/// Throws InputError where the scene has no accuracy.within, where accuracy.of names what has no
/// value, and SolutionError where no pilot run succeeds.
Plan plan_of(const Scene& scene, const BudgetHooks& hooks);

/// The budget of a planned run that has ended: what mesh, time and phases are wrong by, surely, and
/// of its models and of a mesh that is given what the plan knows. `scene` as Setup::scene has it.
Budget find_budget(const Plan& plan, const Scene& scene, const Goals& goals, BudgetHooks hooks);

/// The largest error of the values that the scene wants, by its budget. A part that cannot be told
/// of a value counts as a whole one; one of which nothing is known (BudgetPart::unknown) as none,
/// which accuracy_text() says.
double wanted_error(const Scene& scene, const Budget& budget);

/// Other settings for a planned run, of which `runs` have been made, the last one with `settings`:
/// such that the errors which its budget shows come within the asked one. Nothing if they are
/// (after the first run: within 0.85 of it), after three runs, or if no free key helps.
std::optional<Scene> refined(const Plan& plan, const Scene& asked, const Scene& settings,
                             const Budget& shown, int runs);

/// A table for a terminal.
std::string plan_text(const Plan& plan);
/// In one line: "asked for 1 % in depth, volume, pressure: 0.41 %, that of inner_pressure, mostly
/// by mesh.factor".
std::string accuracy_text(const Scene& asked, const Budget& shown);
/// What would lower the largest part of the error of a run with `settings`, as "mesh.factor = 0.5".
/// Empty where the error is within the asked one, and where no key of the scene lowers that part.
std::string finer_text(const Scene& asked, const Scene& settings, const Budget& shown);

}  // namespace gnomon

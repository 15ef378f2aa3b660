// The cycle that a scene describes: [cycle].
#pragma once

#include <gnomon/cycles/cycle.hpp>
#include <gnomon/cycles/cycle_quadrature.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// cycle.*: period, phases, motions and loads. All are optional.
const std::vector<Key>& cycle_keys();

/// The cycle of a scene that has these keys; nothing where it has no cycle.period. Throws
/// InputError for an expression or a file that cannot be read, and for keys without a period.
std::optional<Cycle> read_cycle(const Scene& scene);

/// What such a function is, for the help of a key.
inline constexpr const char* cycle_function_form =
    ": an expression of tau in [0, 1), or a file (.csv) of tau and values";
/// A key of such a function.
Key cycle_function_key(const std::string& name, const std::string& unit, const std::string& help);
/// The function of such a key; nothing where the scene does not give it.
std::optional<CycleFunction> read_cycle_function(const Scene& scene, const std::string& key);

/// The expressions of tau that the scene gives.
std::vector<std::string> cycle_expressions(const Scene& scene);

/// cycle.phases: so many phases, or at chosen positions, of a cycle with these kinks. Throws
/// InputError, also where the program is to choose their number.
CycleQuadrature read_cycle_quadrature(const Scene& scene, std::vector<double> kinks);

/// Whether the program is to choose the number of phases: cycle.phases = "auto".
bool chooses_phases(const Scene& scene);
/// The same scene with this number of phases.
Scene with_phases(const Scene& scene, long count);
/// What the error of the mean over the phases is compared with: integrator.rtol; for fixed steps,
/// which have no tolerance, this.
inline constexpr double phase_tolerance_of_fixed_steps = 1e-3;
double phase_tolerance(const Scene& scene);

/// The same scene with the tables of files (*.csv) in it.
Scene with_cycle_tables(const Scene& scene);

}  // namespace gnomon

// Follows the equilibria of a growing load, from zero to the whole load: that of a worn body at
// frozen shape, computed from the unloaded state.
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/newton/newton.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Increments are fractions of the load.
struct RampOptions {
  double first = 1;        ///< first increment, in (0, 1]
  double largest = 1;      ///< upper bound of increments
  double smallest = 1e-4;  ///< lower bound, except for the last; the ramp ends if this one fails
  int most = 1000;         ///< largest number of solves: for absurd loads increments are tiny
  double begin = 0;        ///< fraction at which y is an equilibrium
  /// Whether an equilibrium has left this part of what its equations are valid for; it is none
  /// beyond the whole, and beyond the half the ramp ends.
  std::function<bool(std::span<const double> y, double part)> strays{};
  int good_iterations =
      3;  ///< Newton iterations per increment: with fewer the next grows, with more it shrinks
};

struct RampReport {
  double reached = 0;  ///< fraction of the load that is in equilibrium; 1 on success
  int increments = 0;  ///< number that converged
  int failures = 0;    ///< number of attempts that did not
  std::string reason;  ///< of the last failure when reached < 1
};

/// Solves for the equilibrium at a fraction of the load, in place, from a guess.
using LoadSolve = std::function<NewtonReport(double fraction, std::span<double> y)>;

/// From y at RampOptions::begin to y with all of the load. The guess of each increment is the
/// secant through the last two equilibria; a failed increment is halved, and the next one grows by
/// at most a half. If the ramp fails, y is the last equilibrium.
RampReport ramp_load(const LoadSolve& solve, const RampOptions& options, std::vector<double>& y);

/// The best increments of the load of this body. An increment from rest is limited by the change of
/// volume that a linear step causes at second order in the strain: lambda resists this change, mu
/// resists the strain. So the first increment causes a mean strain (pressure divided by Young's
/// modulus) of a few times mu / lambda, or is the whole load if that is less.
/// Measured on the pin (E = 10 and 20
/// MPa, nu = 0.499, 20x20): twice as much fails.
template <int dim>
RampOptions ramp_options(const Assembly<dim>& body);

/// Brings `values` (zero displacement, or an equilibrium at RampOptions::begin; any shape) into
/// equilibrium with the whole load, at t = 0 or the time at which `contact` is frozen with the
/// shape, by a ramp.
/// Increments below the whole load are solved only roughly, because they only give first guesses.
/// `contact`: the system of WornBodyEquations::deformation(); its load fraction keeps the value at
/// which the ramp ended. `passed`: where history matters, told where the bodies first touch, then
/// every equilibrium, which is then solved for exactly.
template <int dim>
RampReport find_equilibrium(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& contact,
                            const RampOptions& options, FieldValues<dim>& values,
                            Counters& counters,
                            const std::function<void(std::span<double> y)>& passed = {});

/// Whether a body is far from where the mesh is, as no load moves it that has a partner; `from`:
/// from where it touched, which nothing moves it as far from.
template <int dim>
bool flies_away(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                const FieldValues<dim>* from = nullptr);

/// Why there is no equilibrium in a phase, for the user.
template <int dim>
std::string failure_of(const RampReport& ramp, const Assembly<dim>& assembly,
                       const Phase<dim>& phase);

}  // namespace gnomon

// The paper's two balls on meshes of its proportions: the first Newton iteration of a step by the
// block solver.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <memory>
#include <vector>

#include "newton/krylov.hpp"
#include "stopwatch.hpp"

namespace gnomon::bench {

struct Example {
  std::shared_ptr<const Assembly<3>> body;
  double radius;  // of the ball [mm]
  double force;   // on the whole ball [N]
};

/// The ball that wears a groove into a half-space. `refinement` 1 is the paper's mesh of 40 x 82 x
/// 20 elements (65,600); lengths of elements scale with its inverse. All other keys are those of
/// the scene of small deformations.
Example groove(double refinement, bool multigrid);

/// The ball that wears on a flat, likewise; 1 is 16,320 elements. Its shape is unknown in a volume.
Example worn_ball(double refinement, bool multigrid);

/// The same ball as a part of tetrahedra, subdivided into hexahedra, which have no grid lines; 1 is
/// the mesh of its geometry file.
Example ball_of_tetrahedra(double refinement, bool multigrid);

/// A Newton iteration on the whole system of the body or on a part of it, at the Hertzian guess of
/// the pressure, undeformed. alpha = 1/50 s.
class NewtonIteration {
public:
  /// `coupled`: with the shape; otherwise the contact problem alone. `kept`: after the first run,
  /// Jacobians keep the derivatives of the cells, as most do in a run.
  NewtonIteration(const Example& example, bool coupled, bool kept);

  /// Residual, Jacobian, a set-up of the preconditioner, and a solve down to 1e-4.
  void run();
  /// Resets the times, so that earlier runs do not count.
  void forget();

  const Structure& structure() const { return system_.structure(); }
  /// Processor time [s], medians over the runs.
  double assembly() const { return residual_.median() + jacobian_.median(); }
  double set_up() const { return set_up_.median(); }
  double solve() const { return solve_.median(); }
  double all() const { return assembly() + set_up() + solve(); }
  /// Krylov iterations of a solve.
  double krylov() const;

private:
  FieldValues<3> guess(const Example& example) const;

  WornBodyEquations<3> equations_;
  ComposedSystem<3> system_;
  std::vector<double> y_, rest_, F_, J_, solution_;
  ActiveSet branch_;
  bool kept_;
  SlowPart slow_;
  Counters counters_;
  long runs_ = 0;
  sundials::BlockSolver solver_;
  Stopwatch residual_, jacobian_, set_up_, solve_;
};

}  // namespace gnomon::bench

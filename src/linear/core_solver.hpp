// The rows of displacements, contact multipliers, worn surface and rigid motions of a coupled
// Jacobian, solved together.
#pragma once

#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <span>

namespace gnomon {

/// An approximate inverse of these rows. Vectors have the system's size.
class CoreSolver {
public:
  virtual ~CoreSolver() = default;

  /// Takes the values of a new Jacobian, which must outlive their use. The set-up stays.
  virtual void refresh(std::span<const double> J) = 0;
  /// The cost of update(), in applications.
  virtual double update_cost() const = 0;
  /// Includes what has changed since the last set-up, without a new set-up.
  virtual void update() = 0;
  /// Sets up the solver of the stiffness for the Jacobian of refresh(); `whole`: keeps nothing.
  /// Throws RecoverableError where it is singular. Returns how many factorizations were made.
  virtual int set_up(bool whole) = 0;
  /// The cost of set_up(), in applications; 0 where the system has no such rows.
  virtual double set_up_cost() const = 0;
  /// z from s over these rows; s is changed.
  virtual void solve(std::span<double> s, std::span<double> z) = 0;
};

/// Closed nodes are springs in the matrix that is set up (contact_elimination.hpp): for one contact
/// state. References must outlive the solver; throws as StiffnessBlock.
std::unique_ptr<CoreSolver> make_spring_core(const Structure& structure,
                                             const InnerSolverMaker& inner);

/// For several contact states of the same bodies, which share one stiffness without springs
/// (compliance_core.cpp).
std::unique_ptr<CoreSolver> make_compliance_core(const Structure& structure,
                                                 const InnerSolverMaker& inner);

/// For states along a path, where friction may stick (path_core.cpp).
std::unique_ptr<CoreSolver> make_path_core(const Structure& structure,
                                           const InnerSolverMaker& inner);

}  // namespace gnomon

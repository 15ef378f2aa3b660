// Wear laws that jump: what fixed steps cost, and nodes that slide along a jump.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/system/system.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Follows the switching functions at which rates may jump (Structure::switch_jumps): what fixed
/// steps cost that pass over jumps, and nodes that slide along one, because the rates on either
/// side drive them back to it. Between such rates there is no solution.
class JumpLedger {
public:
  JumpLedger(const System& system, const IntegratorSettings& settings);
  /// Of an accepted step. Throws SolutionError where a node slides.
  void add(const State& before, const State& after);
  /// For the user, at the end of a run in fixed steps; empty: nothing of importance.
  std::string warning(const State& last) const;
  /// For the user, where no step from a state succeeds: that a node is at a jump. Else empty.
  std::string suspicion(const State& last) const;

private:
  bool is_jump(const State& before, const State& after, std::size_t function) const;

  const System& system_;
  bool passes_over_;                // steps that do not follow jumps
  std::vector<std::size_t> jumps_;  // the switching functions
  std::vector<double> error_;       // of each unknown, at most
  std::vector<int> turns_;          // of each of `jumps_`: crossings that have followed each other
  bool has_told_ = false;           // by the error of add()
  double largest_ = 0;              // of their values so far
};

}  // namespace gnomon

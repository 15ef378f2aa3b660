// What ends a run whose numbers would be worthless, or which would not end: fixed steps that
// amplify the fastest mode, or hardly damp it; chattering, contact nodes that open and close again
// and again, as in steps above the critical one; and a lack of progress, where every step succeeds,
// but needs ever more work for ever less time.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// Whether fixed steps of the method can be too long for stiff modes: explicit methods, and those
/// with |R| near one or above at infinity.
bool may_fail_to_damp(const Integrator& integrator, const IntegratorSettings& settings);

class DampingWatch {
public:
  /// Only if may_fail_to_damp(). Keeps references.
  DampingWatch(const Model& model, const Integrator& integrator,
               const IntegratorSettings& settings);
  /// Throws SolutionError if a step doubles the fastest mode at this state, or if more than half of
  /// it is left at the end of the run although it should have decayed. Does nothing if the spectrum
  /// cannot be computed.
  void require_damping(const State& state);
  /// The same check if contact is wider than at the last check: a single node in contact has no
  /// fast mode, a wide contact does.
  void require_damping_in_wider_contact(const State& state, const Observation& observed);
  /// Whether any of these states had a mode that decays. If contact is at a single node at every
  /// check, steps may still be far too long.
  bool has_seen_a_mode() const { return seen_; }

private:
  const Model& model_;
  const Integrator& integrator_;
  const IntegratorSettings& settings_;
  double widest_ = -1;  // contact nodes
  bool seen_ = false;
};

/// Throws SolutionError if nodes chatter.
void require_no_chattering(long chattering_nodes, const Integrator& integrator);

class ProgressWatch {
public:
  /// For a run that is at t, has done this work and ends at `end` [time].
  ProgressWatch(double t, const Counters& counters, double end);
  /// Called after every step. Throws SolutionError when the last most_newton_iterations
  /// (integrators/stop_times.hpp) have advanced the run by less than 1e-5 of its length: at that
  /// rate the whole run would take 5e8 iterations, that is six days at a millisecond each.
  void require(double t, const Counters& counters);

private:
  double t_;                // time at which the present count of iterations began
  long newton_iterations_;  // counted by then
  double end_;
};

class Chattering {
public:
  /// Takes the contact surface after a step; a model without one never chatters.
  void add(const std::optional<ContactSurface>& surface);
  /// Called at a breakpoint of the load: a node may leave contact once more.
  void begin_anew();
  /// Nodes that have left contact twice or more between two breakpoints of the load.
  long nodes() const;

  void pack_into(std::vector<double>& numbers) const;
  void unpack_from(Unpacker& numbers);

private:
  std::vector<char> active_;
  std::vector<int> losses_;  // losses of contact, one entry per node
};

}  // namespace gnomon

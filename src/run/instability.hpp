// Ends runs whose fixed steps amplify the fastest mode, or hardly damp it: they would finish
// without an error, but their numbers would be worthless.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>

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

/// Throws SolutionError if nodes chatter (run/chattering.hpp).
void require_no_chattering(long chattering_nodes, const Integrator& integrator);

}  // namespace gnomon

// A run that is made for its goals alone.
#pragma once

#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/budget.hpp>
#include <limits>
#include <optional>
#include <string>

namespace gnomon {

/// The user has ended the search.
class Interrupted : public Error {
public:
  using Error::Error;
};

/// Another size of elements makes the same mesh.
class MeshUnchanged : public InputError {
public:
  using InputError::InputError;
};

/// CPU time of this process until now [s].
double cpu_seconds();

namespace budget {

/// Does something that may fail; returns the reason, or nothing where it has not failed. Throws
/// Interrupted.
std::optional<std::string> failure_of(const std::function<void()>& attempt);

struct Trial {
  Scene scene;  ///< complete: with what was chosen where the model was made
  Goals goals;
  double cpu_seconds = 0;  ///< with making the model
  double work = 0;         ///< Newton iterations times nonzeros of the Jacobian
};

/// Makes the model of a scene and integrates it, nothing is stored. Throws InputError where the
/// scene has no worn surface, SolutionError where the run fails, and Interrupted.
/// `interrupted` is asked after each step and within start and steps, with the work until then.
/// More than `most_work` fails. `unlike`: a mesh with as many nodes as that of this run is refused
/// before the run, by MeshUnchanged.
Trial try_scene(const Scene& scene, const std::function<bool(double work)>& interrupted,
                const Goals* unlike = nullptr,
                double most_work = std::numeric_limits<double>::infinity());

/// Nodes under pressure at the end.
long touching_nodes(const Goals& goals);

/// The scene of companions, which end at the time at which the run did.
Scene ending_at(const Scene& scene, double time);

}  // namespace budget

}  // namespace gnomon

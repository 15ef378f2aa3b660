// Scenes in steady rolling (docs/rolling.md): the table [rolling].
#pragma once

#include <gnomon/model/magnitudes.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <vector>

namespace gnomon::part {

/// Cosine between what is along a surface and its normal, at most.
inline constexpr double along_surface = 1e-3;

std::vector<Key> rolling_keys();

/// Whether a scene gives a table [rolling].
bool rolls(const Scene& scene);

/// Throws InputError where the bodies have what steady rolling does not go with.
void require_steady_bodies(const Scene& scene);

/// How the material passes the counter-body, which knows where it touches first and what creeps
/// (let_creep()), and whose motion becomes a creepage; nothing without [rolling]. `outward`: the
/// mean normal of what wears. Throws InputError for what does not go with it, also for a creepage
/// that a force determines.
template <int dim>
std::optional<Rolling<dim>> read_rolling(const Scene& scene, const Vector<dim>& outward,
                                         CounterBody<dim>& other);

/// The guides of a counter-body that lie along the surface are creepages beside [rolling]. Throws
/// InputError where they are not free.
template <int dim>
void let_creep(const Scene& scene, const Vector<dim>& outward, CounterBody<dim>& other);

/// Whether a creepage is given, and none found by forces: only then slip is known before a run.
template <int dim>
bool slips_as_given(const AssemblyParts<dim>& parts);

/// The speed that scales are made with: by the creepage, or by what friction shears the contact
/// [length / time].
template <int dim>
double speed_of_rolling(const AssemblyParts<dim>& parts, const Magnitudes& expected);

/// Scales unknown creepages by half of the width of the contact.
template <int dim>
void scale_creepages(const Magnitudes& expected, AssemblyParts<dim>& parts);

/// Of the slave's material on the master, of the first pair. Throws InputError.
template <int dim>
Rolling<dim> rolling_of(const Scene& scene, const AssemblyParts<dim>& parts);

/// Makes pairs that may stick, without a cycle, roll by the velocities of their bodies. Throws
/// InputError where these do not roll.
template <int dim>
void let_roll(const Scene& scene, AssemblyParts<dim>& parts);

}  // namespace gnomon::part

// Forces along the surface that are more than friction carries, known before a run.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>

namespace gnomon::part {

/// When forces on a counter-body are first more than friction holds, if a scene tells that they
/// are.
template <int dim>
std::string remark_on_friction(const Scene& scene, const AssemblyParts<dim>& parts);

/// The largest part of what friction holds that forces on a counter-body use in a run; nothing
/// where they are not known.
template <int dim>
std::optional<double> used_friction(const Scene& scene, const AssemblyParts<dim>& parts);

/// Throws InputError where forces along several guides press a counter-body on no part of the
/// surface in a phase of a cycle. They may go round in a bore.
template <int dim>
void require_pressing(const Scene& scene, const AssemblyParts<dim>& parts);

/// Throws InputError where such forces, of pairs those beside loads on a body that nothing else
/// holds, are more than friction carries in steady rolling, as far as a scene tells.
template <int dim>
void require_balanced_rolling(const Scene& scene, const AssemblyParts<dim>& parts);

}  // namespace gnomon::part

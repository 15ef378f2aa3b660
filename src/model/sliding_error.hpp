// Bodies of pairs that loads, wear and contact move otherwise than [[motion]] says.
#pragma once

#include <gnomon/model/examination.hpp>
#include <gnomon/model/wear_model.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// Material slides by spin x (x - centre), also where its body has moved from there. The motion of
/// a body is the mean displacement of its contact, by the contact forces; the error is that of the
/// mean speed. Absent where nothing turns or slides.
template <int dim>
std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<dim>& equations,
                                         const FieldValues<dim>& values,
                                         const std::vector<PhaseContact<dim>>& contacts);

/// Absent without a cycle of at least four phases, and where friction may stick.
template <int dim>
std::optional<UnseenSliding> find_unseen_sliding(const WornBodyEquations<dim>& equations,
                                                 const FieldValues<dim>& values,
                                                 const std::vector<PhaseContact<dim>>& contacts);

}  // namespace gnomon

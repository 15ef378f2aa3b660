// How much of a body is behind its contact nodes.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <vector>

namespace gnomon {

/// By contact node: from it along its initial normal through its body, to the other side or to the
/// bond with another body [length]; infinite where nothing is met, and for nodes that do not wear.
template <int dim>
std::vector<double> thickness_behind(const Assembly<dim>& assembly);

}  // namespace gnomon

// Where facets of pairs are found that may meet (Assembly::near).
#pragma once

#include <gnomon/model/assembly.hpp>
#include <memory>
#include <vector>

namespace gnomon {

/// Of the nodes of the mesh, deformed, in the frames of the bodies [length].
template <int dim>
std::vector<Vector<dim>> deformed(const Mesh<dim>& mesh, const NodalField<dim>& d,
                                  const NodalField<dim>& u);

/// Whether surfaces of pairs, with nodes at x, have left this part of the margin in which the
/// facets of a phase were found.
template <int dim>
bool have_strayed(const Assembly<dim>& body, const Phase<dim>& phase,
                  const std::vector<Vector<dim>>& x, double part);

/// With those of a phase found where the nodes are at x.
template <int dim>
std::shared_ptr<const Assembly<dim>> with_facets_near(const Assembly<dim>& body,
                                                      const Phase<dim>& phase,
                                                      std::vector<Vector<dim>> x);

}  // namespace gnomon

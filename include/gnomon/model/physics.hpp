// A physics on a mesh declares its unknowns and equations, a Composition of fields and terms, and
// says what is observed of a state. The rest of a model follows from the composition and the mesh.
#pragma once

#include <array>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/system/composed_system.hpp>
#include <gnomon/terms/material.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// What remains to a physics: observe(), fields(), contact(), differential_scale, and its
/// abilities.
template <int dim>
class Physics : public Model {
public:
  const ComposedSystem<dim>& system() const final { return system_; }
  /// From zero, by the algebraic stages.
  State start(Counters& counters) const override;

protected:
  /// With blocks and grid; blocks of one name are listed as one.
  Physics(std::shared_ptr<const Composition<dim>> composition, const Mesh<dim>& mesh);

private:
  ComposedSystem<dim> system_;
};

/// A vector at each node of a mesh, of one block where it is not held.
template <int dim>
Field field_at_nodes(const std::string& name, const NodalFlags<dim>& held, int block,
                     double row_scale, double unknown_scale);

/// In 2D, z is zero.
template <int dim>
std::array<double, 3> point_in_space(const Vector<dim>& v);
template <int dim>
std::vector<std::array<double, 3>> points_in_space(const std::vector<Vector<dim>>& points);

/// A cell with its nodal values, one row per node.
template <int dim>
struct CellState {
  CellNodal<dim> initial, X, u;  ///< X^, X = X^ + d, u

  CellState(const Mesh<dim>& mesh, const typename Mesh<dim>::Cell& cell, const NodalField<dim>& d,
            const NodalField<dim>& displacement)
      : initial(mesh.positions(cell)), X(initial) {
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) {
      X.row(a) += d.row(cell[a]);
      u.row(a) = displacement.row(cell[a]);
    }
  }
};

/// The fields displacement, shape, equivalent_stress and element_quality of elastic bodies.
/// `body_of`: by cell, the position of its body; empty where there is one.
template <int dim>
std::vector<GridField> solid_fields(const Mesh<dim>& mesh, const std::vector<Body>& bodies,
                                    const std::vector<int>& body_of, const NodalField<dim>& d,
                                    const NodalField<dim>& u);

/// The nodes of these patches, moved by d and u, and how far d moved them; without contact.
template <int dim>
ContactSurface surface_of(const Mesh<dim>& mesh, std::span<const ContactPatch<dim>> patches,
                          const NodalField<dim>& d, const NodalField<dim>& u);

}  // namespace gnomon

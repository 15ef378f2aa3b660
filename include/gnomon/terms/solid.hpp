// An elastic cell whose reference configuration moves: residual of eq. (24), integrated over the
// undeformed configuration X = X^ + d, and its derivatives with respect to u and to d. Three
// choices make a cell, each independent of the others: how the element treats its change of volume,
// whether strains are finite or small, and the material.
#pragma once

#include <array>
#include <gnomon/mesh/section.hpp>
#include <gnomon/terms/cell_point.hpp>
#include <string>

namespace gnomon {

/// How an element treats its change of volume (solid_kernels.hpp states the forces).
enum class ElementTechnology {
  plain,             ///< that of the displacement
  f_bar,             ///< that of the centroid, E. A. de Souza Neto et al. (1996)
  f_bar_variational  ///< the same strain, forces from its energy, eq. (32)
};

/// Names in scenes, in the order of the enumeration.
inline constexpr std::array<const char*, 3> technology_names = {"plain", "f-bar",
                                                                "f-bar-variational"};
/// Throws InputError that names the nearest one.
ElementTechnology technology_of(const std::string& name);

/// Whether the element uses the change of volume of the centroid.
constexpr bool averaged(ElementTechnology technology) {
  return technology != ElementTechnology::plain;
}
constexpr bool variational(ElementTechnology technology) {
  return technology == ElementTechnology::f_bar_variational;
}

/// The properties of an element that do not depend on its material.
struct Element {
  ElementTechnology technology = ElementTechnology::f_bar;
  Kinematics kinematics = Kinematics::finite;
  Section section = Section::plane;  ///< of a body of revolution: with hoop strains and 2 pi R
};

/// The functions of a cell [1 << dim nodes], by one law, technology and kinematics. X: undeformed
/// positions X^ + d, u: displacements, R: nodal forces (rows of nodes). Those that return a bool
/// return false when the cell is inverted.
template <int dim>
struct CellKernel {
  bool (*residual)(const ElasticModuli&, const CellNodal<dim>& X, const CellNodal<dim>& u,
                   CellNodal<dim>& R);
  /// K_u = dR/du; K_d is not computed.
  bool (*tangent_u)(const ElasticModuli&, const CellNodal<dim>& X, const CellNodal<dim>& u,
                    CellNodal<dim>& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d);
  /// K_u = dR/du and K_d = dR/dd.
  bool (*tangent_ud)(const ElasticModuli&, const CellNodal<dim>& X, const CellNodal<dim>& u,
                     CellNodal<dim>& R, CellMatrix<dim>& K_u, CellMatrix<dim>& K_d);
  /// Mean over the cell's Gauss points of the von Mises equivalent of the Cauchy stress (of sigma
  /// with small strains) [stress].
  double (*equivalent_stress)(const ElasticModuli&, const CellNodal<dim>& X,
                              const CellNodal<dim>& u);
};

/// Kernels of one law, by element technology.
template <int dim>
using CellKernels = std::array<CellKernel<dim>, technology_names.size()>;

/// Kernels of one law: plane strain, in space, and of bodies of revolution.
struct LawKernels {
  CellKernels<2> plane;
  CellKernels<3> space;
  CellKernels<2> meridian;

  template <int dim>
  const CellKernel<dim>& of(ElementTechnology technology, Section section = Section::plane) const {
    const auto k = static_cast<std::size_t>(technology);
    if constexpr (dim == 2)
      return section == Section::plane ? plane[k] : meridian[k];
    else
      return space[k];
  }
};

/// Kernels of the linear law, which all materials use with small strains.
extern const LawKernels small_strain_kernels;

/// Volume of a cell [length^dim]: in 2D its area, or the volume of its whole revolution [length^3].
template <int dim>
double cell_volume(const CellNodal<dim>& X, Section section = Section::plane);

/// Scaled Jacobian: the least, over the corners, of det(dX/dxi) divided by the product of the
/// lengths of the edges at that corner; 1 for a rectangle, <= 0 when inverted.
template <int dim>
double scaled_jacobian(const CellNodal<dim>& X);

}  // namespace gnomon

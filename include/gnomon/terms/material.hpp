// The material of a body: moduli, and the kernels of an elastic law.
#pragma once

#include <gnomon/terms/solid.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// A value type.
struct Material {
  ElasticModuli moduli;
  const LawKernels* finite_kernels = nullptr;  ///< of its law; static, never freed
  double collapse_force = 1;                   ///< that of its law
  double young_modulus = 0;                    ///< of the linearized law, as given [stress]
  double poisson_ratio = 0;

  template <int dim>
  const CellKernel<dim>& kernel(const Element& element) const {
    const bool small = element.kinematics == Kinematics::small;
    return (small ? small_strain_kernels : *finite_kernels)
        .template of<dim>(element.technology, element.section);
  }
};

/// Cells of a mesh that are one body. Bodies that share nodes are bonded.
struct Body {
  std::string name{};        ///< empty where there is one
  std::vector<int> cells{};  ///< ascending; of the only body empty: all
  Material material{};
  Element element{};
  double density = 0;  ///< mass by volume; 0: not known
};

/// The elastic energy of the auxiliary problem that moves the mesh, which is free to choose
/// (sec. 2.5): of plain elements at finite strains.
struct MeshMotionLaw {
  Material material;
  double stiffening = 0;  ///< chi: a cell is (mean volume / its volume)^chi as stiff
};

/// By cell of a mesh that has so many: the position of its body. Throws InputError where the bodies
/// are not all cells, each once.
std::vector<int> body_of_cells(const std::vector<Body>& bodies, std::size_t cells);

/// A material by the name of its law (material_law.hpp). Throws InputError that names the nearest
/// one.
Material make_material(const std::string& law, const ElasticModuli& moduli);

/// CellKernel::equivalent_stress of the material.
template <int dim>
double equivalent_stress(const Element& element, const Material& material, const CellNodal<dim>& X,
                         const CellNodal<dim>& u) {
  return material.kernel<dim>(element).equivalent_stress(material.moduli, X, u);
}

}  // namespace gnomon

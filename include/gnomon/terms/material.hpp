// The material of a body: moduli, and the kernels of an elastic law.
#pragma once

#include <gnomon/terms/solid.hpp>
#include <string>

namespace gnomon {

/// A value type.
struct Material {
  ElasticModuli moduli;
  const LawKernels* finite_kernels = nullptr;  ///< of its law; static, never freed
  double collapse_force = 1;                   ///< that of its law

  template <int dim>
  const CellKernel<dim>& kernel(const Element& element) const {
    const bool small = element.kinematics == Kinematics::small;
    return (small ? small_strain_kernels : *finite_kernels)
        .template of<dim>(element.technology, element.section);
  }
};

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

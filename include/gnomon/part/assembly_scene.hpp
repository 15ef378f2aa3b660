// What all scenes with wearing bodies say by the same keys, worn_body_keys(): a problem gives the
// mesh, its supports and loads, and its partner.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/scene/scene.hpp>
#include <memory>
#include <string>

namespace gnomon {

/// A body by the keys of its table, without its group of elements. Throws InputError.
Body read_body(const Scene& scene, Section section = Section::plane,
               const std::string& table = "body");

/// wear.normal
NormalRule read_normal_rule(const Scene& scene);

/// Contact of a surface that wears by the law of the scene, with its friction and normal rule. By
/// the conservative rule its nodes know the named parts of the boundary beside it.
template <int dim>
Interface<dim> read_interface(const Scene& scene, const Mesh<dim>& mesh,
                              std::vector<typename Mesh<dim>::Facet> surface);

/// shape.*: the law of the mesh motion and the form of the constraint, for a shape that is held
/// where these flags are set.
template <int dim>
ShapeMotion<dim> read_shape_motion(const Scene& scene, NodalFlags<dim> held,
                                   NodalProjectors<dim> along = {});

/// The parts with what follows from all of them: rho, the initial gap, the
/// linear solver and its memory. `facet`: a typical length of a contact facet. Throws InputError
/// like required_memory().
template <int dim>
AssemblyParts<dim> completed(const Scene& scene, double facet, AssemblyParts<dim> parts);

/// The model of the completed parts, whose first surface wears by the law of the scene. Throws
/// InputError like required_law(), completed() and Assembly.
template <int dim>
std::unique_ptr<Model> make_wear_model(const Scene& scene, double facet, AssemblyParts<dim> parts);

/// What the wear laws of an assembly meet in a run.
template <int dim>
WearCircumstances wear_circumstances(const AssemblyParts<dim>& parts);

/// The history of a force that keeps the bodies together, from `PREFIX.times` and `PREFIX.factors`.
/// Throws InputError if they do not define one.
LoadHistory read_load_history(const Scene& scene, const std::string& prefix = "load");

/// The integral of the force over the run [force time]: wear is proportional to it.
double load_impulse(const Scene& scene);

/// Flags of the sides of a plane body, "left" and "right", that are held laterally.
NodalFlags<2> held_sides(const Mesh<2>& mesh);

/// load.force, which presses the top of a body down.
Load<2> read_load_on_top(const Scene& scene, const Mesh<2>& mesh);

/// Nodal dead loads of a uniform traction on facets, `load` [stress], or where this `is_resultant`
/// its integral over them [force; per thickness of a plane body; of a body of revolution the area
/// is that of the whole circumference, so that the component r is no resultant].
template <int dim>
NodalField<dim> surface_load(const Mesh<dim>& mesh,
                             const std::vector<typename Mesh<dim>::Facet>& facets,
                             const Vector<dim>& load, bool is_resultant,
                             Section section = Section::plane);
/// The resultant on a boundary part.
NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part, const Vector<2>& resultant,
                           Section section = Section::plane);

/// Nodal dead loads of a uniform force per initial volume, like gravity [force / length^dim; per
/// length^3 in a body of revolution]. `cells`: null: all.
template <int dim>
NodalField<dim> volume_load(const Mesh<dim>& mesh, const Vector<dim>& density,
                            Section section = Section::plane,
                            const std::vector<int>* cells = nullptr);

}  // namespace gnomon

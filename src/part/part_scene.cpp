#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/part/part_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>

#include "part/body_meshes.hpp"
#include "part/graded_mesh.hpp"
#include "part/groups.hpp"
#include "part/histories.hpp"
#include "part/loads.hpp"
#include "part/pair_keys.hpp"
#include "part/phases.hpp"
#include "part/stick_path.hpp"
#include "part/stored_part.hpp"
#include "part/supports.hpp"

namespace gnomon {

namespace {

using namespace part;

template <int dim>
std::unique_ptr<Model> model_of(const Scene& scene, const ImportedBody<dim>& part) {
  const auto with = [&](long phases) { return read_part<dim>(with_phases(scene, phases), part); };
  return std::make_unique<WearModel<dim>>(!chooses_phases(scene) ? read_part<dim>(scene, part)
                                          : may_stick(scene)
                                              ? with_chosen_path<dim>(scene, with)
                                              : with_chosen_phases<dim>(scene, with));
}

template <int dim>
std::unique_ptr<Model> model_of_file(const Scene& scene, ImportedMesh mesh) {
  return model_of<dim>(scene, check_bodies<dim>(scene, std::move(mesh),
                                                static_cast<int>(scene.integer("mesh.split"))));
}

/// 2 or 3 by the numbers of the counter-body's vectors; 0 if it has none.
std::size_t dimension_of(const Scene& scene) {
  for (const char* key : {"counter_body.press.direction", "counter_body.center"})
    if (scene.given(key)) return scene.reals(key).size();
  const std::string velocity = "counter_body.motion.velocity";  // of a plane one also out of it
  return scene.given(velocity) && scene.reals(velocity).size() == 2 ? 2 : 0;
}

/// The mistakes that can be found without the mesh.
void find_mistakes_without_mesh(const Scene& scene, Mistakes& mistakes) {
  find_conflicts(scene, mistakes);
  find_mistakes_of_supports(scene, mistakes);
  find_mistakes_of_loads(scene, mistakes);
  const std::size_t dim = has_pairs(scene) ? 0 : dimension_of(scene);
  if (dim == 2) mistakes.collect([&] { read_counter_body<2>(scene, section_of(scene)); });
  if (dim == 3) mistakes.collect([&] { read_counter_body<3>(scene, Section::plane); });
}

}  // namespace

std::unique_ptr<Model> make_part(const Scene& scene) {
  ImportedMesh mesh;
  Mistakes mistakes;
  find_mistakes_of_pairs(scene, mistakes);
  mistakes.require_none();
  if (!mistakes.collect([&] { mesh = read_graded_mesh(scene); }))
    find_mistakes_without_mesh(scene, mistakes);
  mistakes.require_none();
  return mesh.dimension == 2 ? model_of_file<2>(scene, std::move(mesh))
                             : model_of_file<3>(scene, std::move(mesh));
}

std::unique_ptr<Model> remake_part(const Scene& scene, const Grid& grid) {
  if (grid.cell == Grid::Cell::quadrilateral)
    return model_of<2>(scene, part_of_grid<2>(grid, scene.path().string()));
  return model_of<3>(scene, part_of_grid<3>(grid, scene.path().string()));
}

void find_mistakes_of_groups(const Scene& scene, Mistakes& mistakes) {
  find_conflicts(scene, mistakes);
  mistakes.collect([&] {
    ImportedMesh mesh = read_mesh(scene);
    const std::vector<std::string> separate = separate_bodies(scene);
    if (mesh.dimension == 2)
      find_unknown_groups(scene, check_mesh<2>(std::move(mesh), {}, 0, separate), mistakes);
    else
      find_unknown_groups(scene, check_mesh<3>(std::move(mesh), {}, 0, separate), mistakes);
  });
}

}  // namespace gnomon

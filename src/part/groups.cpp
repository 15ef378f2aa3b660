#include "part/groups.hpp"

#include <gnomon/base/error.hpp>

#include "part/histories.hpp"

namespace gnomon::part {

template <int dim>
const std::vector<typename Mesh<dim>::Facet>& group_facets(const Scene& scene,
                                                           const std::string& key,
                                                           const std::string& name,
                                                           const ImportedBody<dim>& part) try {
  return boundary_part(part, name);
} catch (const InputError& error) {
  throw InputError(scene.where(key) + ": " + error.what());
}

template <int dim>
std::vector<int> group_nodes(const Scene& scene, const std::string& key, const std::string& name,
                             const ImportedBody<dim>& part) try {
  return gnomon::group_nodes(part, name);
} catch (const InputError& error) {
  throw InputError(scene.where(key) + ": " + error.what());
}

template <int dim>
void find_unknown_groups(const Scene& scene, const ImportedBody<dim>& part, Mistakes& mistakes) {
  for (const char* table : {"support", "load"})
    for (const std::string& number : scene.chosen_names(std::string(table) + ".#.on")) {
      const std::string key = std::string(table) + "." + number + ".on";
      if (given(scene, key))
        mistakes.collect([&] { group_nodes(scene, key, scene.text(key), part); });
    }
  for (const char* key : {"wear.on", "shape.hold", "shape.slide"}) {
    if (!given(scene, key)) continue;
    for (const std::string& name : scene.texts(key))
      mistakes.collect([&] { group_facets(scene, key, name, part); });
  }
}

template const std::vector<Mesh<2>::Facet>& group_facets(const Scene&, const std::string&,
                                                         const std::string&,
                                                         const ImportedBody<2>&);
template const std::vector<Mesh<3>::Facet>& group_facets(const Scene&, const std::string&,
                                                         const std::string&,
                                                         const ImportedBody<3>&);
template std::vector<int> group_nodes(const Scene&, const std::string&, const std::string&,
                                      const ImportedBody<2>&);
template std::vector<int> group_nodes(const Scene&, const std::string&, const std::string&,
                                      const ImportedBody<3>&);
template void find_unknown_groups(const Scene&, const ImportedBody<2>&, Mistakes&);
template void find_unknown_groups(const Scene&, const ImportedBody<3>&, Mistakes&);

}  // namespace gnomon::part

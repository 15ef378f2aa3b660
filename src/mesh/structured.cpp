#include <algorithm>
#include <gnomon/mesh.hpp>

namespace gnomon {

template <int dim>
std::vector<int> Mesh<dim>::boundary_nodes(const std::string& name) const {
  std::vector<int> result;
  for (const Facet& facet : boundary.at(name))
    result.insert(result.end(), facet.begin(), facet.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

template std::vector<int> Mesh<2>::boundary_nodes(const std::string&) const;
template std::vector<int> Mesh<3>::boundary_nodes(const std::string&) const;

Mesh<2> structured_quadrilaterals(int nx, int ny,
                                  const std::function<Vector<2>(double s, double t)>& place) {
  Mesh<2> mesh;
  const auto node = [nx](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.nodes.push_back(place(double(i) / nx, double(j) / ny));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      mesh.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  for (int i = 0; i < nx; ++i) {
    mesh.boundary["bottom"].push_back({node(i, 0), node(i + 1, 0)});
    mesh.boundary["top"].push_back({node(i + 1, ny), node(i, ny)});
  }
  for (int j = 0; j < ny; ++j) {
    mesh.boundary["left"].push_back({node(0, j + 1), node(0, j)});
    mesh.boundary["right"].push_back({node(nx, j), node(nx, j + 1)});
  }
  return mesh;
}

}  // namespace gnomon

// A block of hexahedra on the image of a cube.
#pragma once

#include <functional>
#include <gnomon/mesh/extrusion.hpp>
#include <utility>

namespace gnomon::testing {

/// nx by ny by nz hexahedra on the image of the unit cube under `place(r, s, t)`, nodes numbered
/// along r, then s, then t; boundary parts "left" (r = 0), "right" (r = 1), "front" (s = 0), "back"
/// (s = 1), "bottom" (t = 0), "top" (t = 1). The map must keep orientation.
inline Mesh<3> structured_hexahedra(
    int nx, int ny, int nz, const std::function<Vector<3>(double r, double s, double t)>& place) {
  const Mesh<2> section =
      structured_quadrilaterals(ny, nz, [](double s, double t) { return Vector<2>(s, t); });
  std::vector<double> lines(nx + 1);
  for (int i = 0; i <= nx; ++i) lines[i] = double(i) / nx;
  Mesh<3> mesh = extrude(section, lines).mesh;
  for (Vector<3>& X : mesh.nodes) X = place(X[0], X[1], X[2]);
  const auto rename = [&mesh](const char* from, const char* to) {
    auto part = mesh.boundary.extract(from);
    part.key() = to;
    mesh.boundary.insert(std::move(part));
  };
  rename("left", "front");
  rename("right", "back");
  rename("begin", "left");
  rename("end", "right");
  return mesh;
}

}  // namespace gnomon::testing

#include "gmsh/geometry.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>

#include "gmsh/model_mesh.hpp"
#include "gmsh/size_check.hpp"

namespace gnomon::gmsh_reader {

namespace {

void set(const char* option, double value) {
  gmsh::option::setNumber(option, value);
}

double get(const char* option) {
  double value = 0;
  gmsh::option::getNumber(option, value);
  return value;
}

/// Whether all elements of the highest dimension are quadrilaterals or hexahedra.
bool is_of_bricks(int dimension) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension);
  constexpr int quadrilateral = 3, hexahedron = 5;
  return std::all_of(types.begin(), types.end(), [dimension](int type) {
    return type == (dimension == 2 ? quadrilateral : hexahedron);
  });
}

bool is_meshed(int dimension) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension);
  return !types.empty();
}

}  // namespace

void ask_for_factor(double factor) {
  set("Mesh.MeshSizeFactor", factor);
}

void mesh_geometry(double size, double factor, bool has_options,
                   std::vector<std::string>& remarks) {
  const int dimension = gmsh::model::getDimension();
  if (dimension < 2)
    throw Refusal("has no surface and no volume to be meshed (a Plane Surface is missing?)");
  if (is_meshed(dimension)) {  // by the commands of the script
    if (size != 0 || factor != 1)
      throw Refusal("the script has commands that mesh, so it takes no size");
    return;
  }
  set("Mesh.ElementOrder", 1);
  if (size > 0) {
    set("Mesh.MeshSizeMax", std::min(size, get("Mesh.MeshSizeMax")));
    set("Mesh.MeshSizeMin", std::min(size, get("Mesh.MeshSizeMin")));
  }
  // A STEP file cannot ask for small elements at small holes and edges, where large ones fold.
  constexpr double by_turn = 24;
  if (!has_options) set("Mesh.MeshSizeFromCurvature", by_turn);
  const double there = get("Mesh.MeshSizeFactor");
  const double own_factor = there == factor ? factor : there * factor;  // a script has set its own
  set("Mesh.MeshSizeFactor", own_factor);
  // Subdivision is left to what does not come out as it should: it would refine structured meshes.
  set("Mesh.SubdivisionAlgorithm", 0);
  check_number_of_cells(dimension, size);
  if (dimension == 2) {
    set("Mesh.RecombineAll", 1);
    constexpr int full_quads_simple = 2;
    if (get("Mesh.RecombinationAlgorithm") > full_quads_simple)
      set("Mesh.RecombinationAlgorithm", 1);  // Gmsh 4.8.4 fails with that of full quads
  }
  gmsh::model::mesh::generate(dimension);
  if (is_of_bricks(dimension)) return;
  gmsh::model::mesh::clear();
  set("Mesh.MeshSizeFactor", 2 * own_factor);
  // Gmsh's own subdivision has its new nodes on the true geometry.
  set("Mesh.SubdivisionAlgorithm", dimension == 2 ? 1 : 2);
  gmsh::model::mesh::generate(dimension);
  remarks.push_back(dimension == 2
                        ? "not all triangles could be paired, so the mesh is one of twice the "
                          "size with each cell subdivided into quadrilaterals"
                        : "not of hexahedra by itself, so the mesh is one of twice the size "
                          "with each cell subdivided into hexahedra");
}

}  // namespace gnomon::gmsh_reader

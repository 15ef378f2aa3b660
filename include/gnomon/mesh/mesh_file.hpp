// Meshes and geometries from files, through Gmsh's library in a process of its own.
#pragma once

#include <array>
#include <filesystem>
#include <gnomon/mesh/imported_mesh.hpp>
#include <vector>

namespace gnomon {

/// Balls of a geometry that is meshed finely there; from them elements grow by three tenths of the
/// distance.
struct FineZone {
  using Ball = std::array<double, 4>;  // centre and radius

  double size = 0;  ///< edge of the elements there [length]; the factor multiplies it, too
  std::vector<Ball> balls{};

  bool operator==(const FineZone&) const = default;
};

/// How a geometry is meshed; a mesh has its size already.
struct MeshFileOptions {
  double size = 0;  ///< largest edge [length]; smaller ones that the geometry asks for stay; 0: the
                    ///< geometry's own (for a STEP file a tenth of its diagonal)
  double factor = 1;  ///< multiplies every edge: 0.5 for a mesh twice as fine
  FineZone fine{};

  bool operator==(const MeshFileOptions&) const = default;
};

/// Whether this build has Gmsh's library.
bool reads_mesh_files();

/// A geometry (.geo, .step, .stp), which is meshed, in contrast to a mesh (.msh).
bool is_geometry(const std::filesystem::path& file);

/// Reads a mesh of Gmsh (.msh 4.1 or 2.2, ASCII or binary), or meshes a geometry: in the plane with
/// quadrilaterals, in space with hexahedra, in both by subdivision where the geometry does not ask
/// for them. Nodes and elements are in ascending order of their tags. Without physical groups of
/// curves (surfaces in space) each is a group: "curve1" ("surface1"). The reading is one of Gmsh,
/// whose faults end a process of its own; throws InputError with its first complaint.
ImportedMesh read_mesh_file(const std::filesystem::path& file, const MeshFileOptions& options = {});

/// While one exists, this thread reads a file with the same options once. For runs that follow each
/// other so soon that nobody changes a file in between.
class KeptMeshes {
public:
  KeptMeshes();
  ~KeptMeshes();
  KeptMeshes(const KeptMeshes&) = delete;
  KeptMeshes& operator=(const KeptMeshes&) = delete;

private:
  bool outermost_;
};

}  // namespace gnomon

// All constants of a body whose free surface moves by its energy, its meshes, and the law of the
// surface.
#pragma once

#include <functional>
#include <gnomon/fields/field.hpp>
#include <gnomon/laws/elastic_law.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/system/composed_system.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::stressed {

/// The law of a free surface that dissolves or evaporates under stress, at a node of its mesh:
///
///   v_n = -m mu,   mu = w + gamma kappa - w0
///
/// w is the energy density, kappa the curvature, positive where the body is convex. mu is the
/// derivative of the total energy E by the volume of the body, so that E cannot grow
/// (surface_motion.hpp). With the area vectors S_f that facets give the node (contact_patch.hpp),
/// the length L of the surface and the projector P on the directions in which the node may move:
///
///   V = P sum_f S_f,   N = V/|V|,   kappa = N . dL/dX / |V|,   mu = N . g / |V|
///   g = dE/dX = dE_el/dX + gamma dL/dX - w0 sum_f S_f,   dX/dt = -m (N . g) N / M
///
/// M, the share of the node in the integral of v_n^2 for a unit of dX/dt, is sum_f |S_f|. Nodes
/// that keep to lines across which the surface leans have v_n = N_f . dX/dt: M = sum_f |P
/// S_f|^2/|S_f|.
struct SurfaceLaw {
  double mobility = 0;    ///< m [length / (time stress)]
  double tension = 0;     ///< gamma [stress length]
  double reference = 0;   ///< w0 [stress]
  bool on_lines = false;  ///< nodes keep to lines
};

template <class Scalar = double>
struct SurfaceNode {
  Vector<2, Scalar> normal = Vector<2, Scalar>::Zero();  ///< N
  Scalar length = Scalar(0);  ///< of the surface that belongs to the node [length]
  Scalar turn;                ///< sine of half the angle by which facets turn, of a convex body > 0
  Scalar curvature;           ///< kappa [1 / length]
  Scalar drive;               ///< mu [stress]
  Scalar rate;                ///< of the node along N [length / time]

  /// `X`: worn positions of patch.nodes [length]; `elastic`: dE_el/dX of the node [force /
  /// thickness].
  SurfaceNode(const SurfaceLaw& law, const ContactPatch<2>& patch, const PatchNodal<2, Scalar>& X,
              const Vector<2, Scalar>& elastic) {
    const Tensor<2, Scalar> P = patch.shape_free.template cast<Scalar>();
    Vector<2, Scalar> volume = Vector<2, Scalar>::Zero(), stretch = Vector<2, Scalar>::Zero();
    Scalar metric(0);
    for (const ContactPatch<2>::Corner& corner : patch.corners) {
      const Vector<2, Scalar> S = corner_area_vector<2, Scalar>(corner, X);
      const Vector<2, Scalar> edge = corner_edges<2, Scalar>(corner, X).col(0);
      const Scalar size = S.norm();
      const Vector<2, Scalar> free = P * S;
      volume += S;
      length += size;
      stretch -= edge / Scalar(edge.norm());
      metric += law.on_lines ? Scalar(free.squaredNorm() / size) : size;
    }
    const Vector<2, Scalar> free = P * volume;
    const Scalar swept = free.norm(), longer = free.dot(stretch) / swept;
    normal = free / swept;
    turn = longer / Scalar(double(patch.corners.size()));
    curvature = longer / swept;
    const Scalar pull = Scalar(normal.dot(elastic)) + Scalar(law.tension) * longer -
                        Scalar(law.reference) * Scalar(normal.dot(volume));
    drive = pull / swept;
    rate = Scalar(-law.mobility) * pull / metric;
  }
};

/// Where a point of the surface is on the wave that it carries.
struct OnWave {
  double phase;   ///< 0 at the first node, pi times a whole number at the last
  double height;  ///< over the flat surface, or distance from the centre [length]
};

struct StressedBody {
  Mesh<2> mesh;
  std::vector<ContactPatch<2>> surface;  ///< nodes of the free surface, along it
  NodalFlags<2> displacement_fixed;      ///< 1 where u is held
  NodalFlags<2> shape_fixed;             ///< 1 where d is held at zero
  NodalProjectors<2> shape_along;        ///< for MeshMotion: none
  /// Where u is held at other values than zero. They do not change, so no load does work.
  std::vector<PrescribedValues::Entry> pulled;
  std::optional<ElasticModuli> elastic;        ///< none: the surface moves by its curvature alone
  Vector<2> mesh_weights = Vector<2>::Ones();  ///< of the mesh motion, harmonic_mesh.hpp
  double stress = 0;                           ///< of the flat surface, along it
  SurfaceLaw law;
  double size = 1;      ///< of the body [length]
  double change = 1;    ///< typical d [length]
  double duration = 1;  ///< of the run [time]
  std::function<OnWave(const Vector<2>& X)> wave;
  /// Of a circle without lobes: R(t) / R0, while there is one.
  std::function<std::optional<double>(double t)> ratio;
};

/// The keys of the problem.
std::vector<Key> stressed_body_keys();

/// The body of a scene. Throws InputError.
std::shared_ptr<const StressedBody> read_stressed_body(const Scene& scene);

}  // namespace gnomon::stressed

#include "stressed_body.hpp"

#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>
#include <numbers>

namespace gnomon::stressed {

namespace {

constexpr double pi = std::numbers::pi;

/// Half a wave between its crest, at x = 0, and its trough. The body lies below y = 0; elements
/// grow with the depth by a fixed ratio from the first to the last, so that meshes of n and 2 n
/// elements are of one family.
Mesh<2> wave_mesh(int across, int deep, double half_wave, double amplitude, double depth,
                  double ratio) {
  return structured_quadrilaterals(across, deep, [=](double s, double t) {
    const double part = (std::pow(ratio, 1 - t) - 1) / (ratio - 1);  // of the depth
    return Vector<2>(half_wave * s, amplitude * std::cos(pi * s) * (1 - part) - depth * part);
  });
}

/// A quarter of a disc: a core of n by n elements, and layers around it that end on the surface
/// R + amplitude cos(lobes angle), on which nodes are at equal angles.
Mesh<2> disc_mesh(int n, int layers, double radius, double amplitude, int lobes) {
  // The outer corner of the core is drawn in, so that elements there have no angle near to 180
  // degrees.
  constexpr double side = 0.6, drawn_in = 0.2;  // of the radius, and of the side
  Mesh<2> mesh = structured_quadrilaterals(n, n, [=](double s, double t) {
    return Vector<2>(side * radius * s * (1 - drawn_in * t * t),
                     side * radius * t * (1 - drawn_in * s * s));
  });
  // From the side x = side of the core over its corner to the side y = side.
  const auto node = [=](int k, int layer) {
    const int i = k <= n ? n : 2 * n - k, j = k <= n ? k : n;
    return layer == 0 ? j * (n + 1) + i : (n + 1) * (n + 1) + k * layers + layer - 1;
  };
  for (int k = 0; k <= 2 * n; ++k) {
    const double angle = pi / 2 * k / (2 * n);
    Vector<2> out(std::cos(angle), std::sin(angle));
    if (k == 2 * n) out[0] = 0;
    const Vector<2> inner = mesh.nodes[node(k, 0)];
    const Vector<2> outer = (radius + amplitude * std::cos(lobes * angle)) * out;
    for (int layer = 1; layer <= layers; ++layer)
      mesh.nodes.push_back(inner + (outer - inner) * layer / layers);
  }
  for (int k = 0; k < 2 * n; ++k)
    for (int layer = 0; layer < layers; ++layer)
      mesh.cells.push_back(
          {node(k, layer), node(k, layer + 1), node(k + 1, layer + 1), node(k + 1, layer)});
  mesh.boundary.clear();
  for (const Mesh<2>::Facet& facet : exterior_facets(mesh)) {
    const Vector<2>&a = mesh.nodes[facet[0]], &b = mesh.nodes[facet[1]];
    const bool left = a[0] == 0 && b[0] == 0, bottom = a[1] == 0 && b[1] == 0;
    mesh.boundary[left ? "left" : bottom ? "bottom" : "top"].push_back(facet);
  }
  return mesh;
}

double required_real(const Scene& scene, const char* key, const char* why) {
  if (!scene.has(key))
    throw InputError(fmt::format("{}: expected a number, {}", scene.where(key), why));
  return scene.real(key);
}

void read_stress(const Scene& scene, StressedBody& body) {
  body.stress = scene.real("load.stress");
  if (body.stress == 0) return;
  constexpr const char* why = "the body is under stress (load.stress)";
  body.elastic = ElasticModuli::from_young_poisson(required_real(scene, "body.young_modulus", why),
                                                   required_real(scene, "body.poisson_ratio", why));
}

/// The walls at both ends are planes of symmetry; the stress comes from the distance at which the
/// right one is held. Nodes keep to their vertical lines, so that the mesh is as fine at the bottom
/// of a notch as at the start.
void hold_strip(const Scene& scene, double length, StressedBody& body) {
  for (const char* wall : {"left", "right"})
    for (int node : body.mesh.boundary_nodes(wall)) body.displacement_fixed(node, 0) = 1;
  body.shape_fixed.col(0).setOnes();
  body.law.on_lines = true;
  body.mesh_weights = {0, 1};
  for (int node : body.mesh.boundary_nodes("bottom")) {
    body.displacement_fixed(node, 1) = 1;
    body.shape_fixed.row(node).setOnes();
  }
  if (!body.elastic) return;
  const double nu = scene.real("body.poisson_ratio");
  const double strain = (1 - nu * nu) * body.stress / scene.real("body.young_modulus");
  for (int node : body.mesh.boundary_nodes("right"))
    body.pulled.push_back({node, 0, strain * length});
  if (!scene.has("surface.reference")) body.law.reference = strain * body.stress / 2;
}

void read_wave(const Scene& scene, StressedBody& body) {
  const double half = scene.real("surface.size") / 2, depth = scene.real("mesh.depth") * 2 * half;
  const std::vector<long>& elements = scene.integers("mesh.elements");
  body.mesh = wave_mesh(int(elements[0]), int(elements[1]), half, scene.real("surface.amplitude"),
                        depth, scene.real("mesh.grading"));
  body.size = depth;
  body.wave = [half](const Vector<2>& X) { return OnWave{pi * X[0] / half, X[1]}; };
}

void read_circle(const Scene& scene, StressedBody& body) {
  if (body.elastic)
    throw InputError(scene.where("load.stress") +
                     ": expected 0, the surface of a circle is free all around");
  const double radius = scene.real("surface.size"), amplitude = scene.real("surface.amplitude");
  const int lobes = static_cast<int>(scene.integer("surface.lobes"));
  if (lobes % 2 != 0)
    throw InputError(fmt::format("{}: expected an even number, a quarter is modelled, got {}",
                                 scene.where("surface.lobes"), lobes));
  const std::vector<long>& elements = scene.integers("mesh.elements");
  body.mesh = disc_mesh(int(elements[0]), int(elements[1]), radius, amplitude, lobes);
  body.size = radius;
  body.wave = [lobes](const Vector<2>& X) {
    return OnWave{lobes * std::atan2(X[1], X[0]), X.norm()};
  };
  if (amplitude == 0 && body.law.reference == 0)
    body.ratio = [rate = 2 * body.law.mobility * body.law.tension /
                         (radius * radius)](double t) -> std::optional<double> {
      if (!(rate * t < 1)) return std::nullopt;
      return std::sqrt(1 - rate * t);
    };
}

/// The surface must be smooth on its mesh.
void require_resolved(const Scene& scene, const StressedBody& body) {
  for (const ContactPatch<2>& patch : body.surface) {
    PatchNodal<2> X(patch.nodes.size(), 2);
    for (std::size_t k = 0; k < patch.nodes.size(); ++k)
      X.row(static_cast<Eigen::Index>(k)) = body.mesh.nodes[patch.nodes[k]].transpose();
    const double turn = SurfaceNode<>(body.law, patch, X, Vector<2>::Zero()).turn;
    if (turn < -0.1 || turn > 0.25)
      throw InputError(fmt::format(
          "{}: expected more elements along the surface, its facets turn by {:.2g} degrees at "
          "({:.4g}, {:.4g})",
          scene.where("mesh.elements"), 360 / pi * std::asin(std::abs(turn)), X(0, 0), X(0, 1)));
  }
}

}  // namespace

std::vector<Key> stressed_body_keys() {
  return {
      text_key("surface.shape", required(), "a half-plane with a wave on its surface, or a disc",
               {"wave", "circle"}),
      length_key("surface.size", "wave length, or radius R0 of the disc"),
      real_key("surface.amplitude", "mm", by_default(0.0), {.min = 0, .max = positive_quantity.max},
               "amplitude of the wave, or of the lobes of the disc"),
      integer_key("surface.lobes", by_default(4L), {.min = 2, .max = 1000},
                  "number n of lobes of the disc, R0 + amplitude cos(n angle); even"),
      real_key("surface.mobility", "mm/(s MPa)", required(), positive_quantity,
               "m: normal velocity by driving stress"),
      real_key("surface.tension", "N/mm", required(), positive_quantity,
               "energy gamma of the surface per area"),
      real_key("surface.reference", "MPa", absent("a flat surface under load.stress rests"),
               any_quantity,
               "energy w0 per volume of the body that balances it with its surroundings"),
      real_key("body.young_modulus", "MPa", absent("no stress"), positive_quantity,
               "Young's modulus E; small strains, plane strain"),
      real_key("body.poisson_ratio", "", absent("no stress"), poisson_ratios, "Poisson's ratio nu"),
      real_key("load.stress", "MPa", by_default(0.0), any_quantity,
               "sigma, along the flat surface; its strain is held from the start on"),
      controlling_by_count(
          integers_key("mesh.elements", required(), {.min = 2, .max = 2000},
                       "along half a wave and in depth, or along an eighth of the circle and in "
                       "layers",
                       2)),
      real_key("mesh.depth", "", by_default(1.0), {.min = 0.1, .max = 100},
               "depth of the half-plane, in wave lengths"),
      real_key("mesh.grading", "", by_default(8.0), {.min = 1, .max = 1e4, .min_open = true},
               "height of the deepest elements of the half-plane, by that of those at its surface"),
  };
}

std::shared_ptr<const StressedBody> read_stressed_body(const Scene& scene) {
  auto body = std::make_shared<StressedBody>();
  const bool circle = scene.text("surface.shape") == "circle";
  body->law = {scene.real("surface.mobility"), scene.real("surface.tension"),
               scene.real_if("surface.reference").value_or(0)};
  body->duration = scene.real("time.end");
  read_stress(scene, *body);
  circle ? read_circle(scene, *body) : read_wave(scene, *body);
  const auto nodes = static_cast<Eigen::Index>(body->mesh.nodes.size());
  body->displacement_fixed = body->shape_fixed = NodalFlags<2>::Zero(nodes, 2);
  if (circle) {
    for (int node : body->mesh.boundary_nodes("left")) body->shape_fixed(node, 0) = 1;
    for (int node : body->mesh.boundary_nodes("bottom")) body->shape_fixed(node, 1) = 1;
  } else {
    hold_strip(scene, scene.real("surface.size") / 2, *body);
  }
  body->surface = contact_patches<2>(body->mesh, body->mesh.boundary.at("top"));
  for (ContactPatch<2>& patch : body->surface)
    for (int i = 0; i < 2; ++i)
      if (body->shape_fixed(patch.node, i)) patch.shape_free(i, i) = 0;
  // What curvature does in the run, or the wave.
  const SurfaceLaw& law = body->law;
  body->change =
      std::min(body->size, circle ? law.mobility * law.tension * body->duration / body->size
                                  : scene.real("surface.amplitude"));
  if (!(body->change > 0)) body->change = 1e-3 * body->size;
  require_resolved(scene, *body);
  return body;
}

}  // namespace gnomon::stressed

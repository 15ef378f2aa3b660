// flat_punch: a rigid flat punch of half width a on the surface of a large elastic block, which
// slides past and wears under it; plane strain, frictionless, wear rate k v |T_N|. Full contact
// from beginning to end: no node ever switches.
//
// On a half-plane the pressure tends to the uniform F/(2a), and a small deviation p from it decays
// in modes exp(-lambda_n t), lambda_n = c_n E* k v/a. The surface stays flat under the punch, so
// that its displacement u(x) = (2/(pi E*)) integral of -ln|x - s| p(s) ds obeys udot + k v p =
// const, and with lengths in units of a
//
//   mu_n p_n(x) = P integral over [-1, 1] of -ln|x - s| p_n(s) ds,   c_n = pi/(2 mu_n),
//
// where P subtracts the mean: c = 1.0031, 1.7267, 2.5627, 3.3143, 4.1300, antisymmetric modes first
// (the punch does not tilt). The tests solve this equation numerically, too.
//
// The block lies above the punch, which is the part |x| <= a of the plane y = 0. A uniform traction
// acts on the top, the sides are held laterally. The contact nodes are those under the punch,
// including its edges. At a node on an edge only the facet under the punch carries pressure and
// wears; therefore the node has half the area of this facet and its normal, and the areas add up to
// 2a. The surface beside the punch keeps its shape: the step that wear makes at the edge is spread
// over the first element beside it. Therefore the wear depth must be small compared with the
// elements, and the volume of the mesh decreases by more (half an element on each side) than the
// wear integral, which is exactly k v F t.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/grid_lines.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

std::vector<Key> keys() {
  std::vector<Key> result = {
      length_key("punch.half_width", "half width a"),
      length_key("block.width", "width W of the block"),
      length_key("block.depth", "depth H of the block"),
      controlling(integer_key("mesh.punch_elements", by_default(20L), {.min = 2, .max = 2000},
                              "elements under the punch, equally wide"),
                  ErrorSource::mesh,
                  [](const Scene& scene, double factor) -> std::optional<Scene> {
                    const double under =
                        static_cast<double>(scene.integer("mesh.punch_elements")) / factor;
                    return scene.with("mesh.punch_elements", std::max(2L, std::lround(under)));
                  }),
      real_key("mesh.grading", "", by_default(1.2), {.min = 1, .max = 3, .min_open = true},
               "largest ratio of neighbouring elements away from the punch")};
  result.insert(result.end(), worn_body_keys(2).begin(), worn_body_keys(2).end());
  return result;
}

/// The grid lines of the mesh, across and in depth.
struct Lines {
  std::vector<double> x, y;
};

Lines mesh_lines(const Scene& scene) {
  const double a = scene.real("punch.half_width"), grading = scene.real("mesh.grading");
  const double side = scene.real("block.width") / 2 - a;
  if (side <= 0)
    throw InputError(fmt::format("{}: expected more than 2 punch.half_width = {:g} mm, got {:g}",
                                 scene.where("block.width"), 2 * a, 2 * (side + a)));
  const int under = static_cast<int>(scene.integer("mesh.punch_elements"));
  const double element = 2 * a / under;
  const std::vector<double> beside = graded_grid_lines_by_growth(element, 0, side, grading);
  Lines lines;
  lines.y = graded_grid_lines_by_growth(element / grading, 0, scene.real("block.depth"), grading);
  for (std::size_t k = beside.size(); k-- > 1;) lines.x.push_back(-a - beside[k]);
  for (int k = 0; k <= under; ++k) lines.x.push_back(a * (2.0 * k / under - 1));
  for (std::size_t k = 1; k < beside.size(); ++k) lines.x.push_back(a + beside[k]);
  return lines;
}

MeshSize mesh_size(const Scene& scene) {
  const Lines lines = mesh_lines(scene);
  return {2, double(lines.x.size()) * double(lines.y.size())};
}

Mesh<2> make_mesh(const Scene& scene) {
  const Lines lines = mesh_lines(scene);
  const std::vector<double>&x = lines.x, &y = lines.y;
  const int nx = static_cast<int>(x.size()) - 1, ny = static_cast<int>(y.size()) - 1;
  return structured_quadrilaterals(nx, ny, [&](double s, double t) {
    return Vector<2>(x[std::lround(s * nx)], y[std::lround(t * ny)]);
  });
}

std::vector<Mesh<2>::Facet> facets_under_punch(const Mesh<2>& mesh, double half_width) {
  std::vector<Mesh<2>::Facet> result;
  for (const auto& facet : mesh.boundary.at("bottom"))
    if (std::abs(mesh.nodes[facet[0]][0] + mesh.nodes[facet[1]][0]) / 2 < half_width)
      result.push_back(facet);
  return result;
}

/// On the whole boundary except under the punch.
NodalFlags<2> held_shape(const Mesh<2>& mesh, const std::vector<Mesh<2>::Facet>& under_punch) {
  NodalFlags<2> held = NodalFlags<2>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 2);
  for (const char* part : {"left", "right", "top", "bottom"})
    for (int node : mesh.boundary_nodes(part)) held.row(node).setOnes();
  for (const auto& facet : under_punch)
    for (int node : facet) held.row(node).setZero();
  return held;
}

Scales make_scales(const Scene& scene, const WearLaw& wear) {
  const double nu = scene.real("body.poisson_ratio"), force = scene.real("load.force");
  Scales scales;
  scales.force = force;
  scales.displacement = force * (1 - nu * nu) / scene.real("body.young_modulus");
  scales.stress = force / (2 * scene.real("punch.half_width"));
  scales.duration = scene.real("time.end");
  const double k_v = wear_by_pressure(scene, wear, scales.stress);
  scales.wear_depth = depth_by_law(
      scene, wear, scales.stress, k_v * load_impulse(scene) / (2 * scene.real("punch.half_width")));
  if (scales.wear_depth == 0) scales.wear_depth = scales.displacement;  // a law without wear
  scales.auxiliary_force = scales.wear_depth;
  return scales;
}

std::unique_ptr<Model> make(const Scene& scene) {
  const Mesh<2> mesh = make_mesh(scene);
  const double a = scene.real("punch.half_width");
  const auto under_punch = facets_under_punch(mesh, a);
  Interface<2> interface = read_interface(scene, mesh, under_punch);
  interface.boundary.clear();  // the facets beside the punch, which an edge would pay for
  interface.partner.motion.velocity = Vector<2>(scene.real("wear.velocity"), 0);
  const Scales scales = make_scales(scene, interface.surfaces.front().wear);
  return make_wear_model<2>(scene, 2 * a / double(scene.integer("mesh.punch_elements")),
                            {.mesh = mesh,
                             .bodies = {read_body(scene)},
                             .supports = {.held = held_sides(mesh)},
                             .loads = {read_load_on_top(scene, mesh)},
                             .interface = std::move(interface),
                             .shape = read_shape_motion(scene, held_shape(mesh, under_punch)),
                             .scales = scales});
}

const Registration<Problem> registration({
    .name = "flat_punch",
    .help =
        "2D rigid flat punch on a large block, plane strain, frictionless: full contact, no event",
    .keys = keys(),
    .make = make,
    .mesh_size = mesh_size,
});

}  // namespace

}  // namespace gnomon

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/grid_lines.hpp>
#include <gnomon/mesh/quarter_ball.hpp>
#include <numbers>

namespace gnomon {

namespace {

// Shape of the core, in radii of the ball; chosen so that the least scaled Jacobian is as large as
// possible.
constexpr double core_depth = 0.35;      // thickness of the layers at the pole
constexpr double core_half_width = 0.4;  // at the mid-plane
constexpr double core_angle = 0.9;       // of the core's bottom, in angles of the patch

/// Linear interpolation: exactly a at 0 and b at 1, and exactly a where a and b are equal.
Vector<3> between(const Vector<3>& a, const Vector<3>& b, double t) {
  return {std::lerp(a[0], b[0], t), std::lerp(a[1], b[1], t), std::lerp(a[2], b[2], t)};
}

/// Along the great circle from one unit vector to another.
Vector<3> great_circle(const Vector<3>& a, const Vector<3>& b, double t) {
  const double angle = std::acos(a.dot(b));
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

/// Positions by coordinates a in [-1, 1], b in [0, 1] across and t in [0, 1] upwards, measured from
/// the centre of a ball of radius 1.
struct Geometry {
  double patch_angle;

  static Vector<3> downwards(double angle, double a, double b) {
    return Vector<3>(std::tan(angle * a), std::tan(angle * b), -1).normalized();
  }

  Vector<3> core(double a, double b, double t) const {
    const Vector<3> bottom = (1 - core_depth) * downwards(core_angle * patch_angle, a, b);
    return between(bottom, {core_half_width * a, core_half_width * b, 0}, t);
  }

  /// On the bottom patch (t = 0) or above its edge (a = -1, b = 1 or a = 1).
  Vector<3> sphere(double a, double b, double t) const {
    Vector<3> patch = downwards(patch_angle, a, b);
    if (t == 0) return patch;
    // Azimuth, from +x, of the corresponding point on the mid-plane: proportional to its position
    // on the edge of the patch.
    const double way = a == 1 ? b / 4 : a == -1 ? 1 - b / 4 : (2 - a) / 4;
    const double azimuth = std::numbers::pi * way;
    const Vector<3> equator(std::cos(azimuth), b == 0 ? 0 : std::sin(azimuth), 0);
    return great_circle(patch, equator, t);
  }
};

class BallMesh {
public:
  explicit BallMesh(const QuarterBall& ball);
  Mesh<3> take() && { return std::move(mesh_); }

private:
  int core_node(int i, int j, int k) const {
    return (k * (ball_.across + 1) + j) * (2 * ball_.across + 1) + i;
  }
  bool on_skin(int i, int j, int k) const {
    return k == 0 || i == 0 || i == 2 * ball_.across || j == ball_.across;
  }
  /// Node of a layer around the core, from the number of the core's node below; layer 0 is the
  /// core.
  int layer_node(int core, int layer) const {
    return layer == 0 ? core : core_nodes_ + skin_[core] * ball_.layers + layer - 1;
  }
  void add_nodes();
  void add_core();
  void add_layers(const Mesh<3>::Facet& skin_facet);
  std::string part_of(const Mesh<3>::Facet& facet) const;

  QuarterBall ball_;
  Mesh<3> mesh_;
  int core_nodes_;
  std::vector<int> skin_;  // number of a core node on the skin, else -1
};

BallMesh::BallMesh(const QuarterBall& ball) : ball_(ball) {
  core_nodes_ = (2 * ball.across + 1) * (ball.across + 1) * (ball.height + 1);
  add_nodes();
  add_core();
  for (const Mesh<3>::Facet& facet : exterior_facets(mesh_))
    if (const std::string part = part_of(facet); part != "symmetry" && part != "top")
      add_layers(facet);
  mesh_.boundary["free"];  // stays empty if every facet is near
  for (const Mesh<3>::Facet& facet : exterior_facets(mesh_))
    mesh_.boundary[part_of(facet)].push_back(facet);
}

void BallMesh::add_nodes() {
  const double angle = ball_.patch_half_width / ball_.radius;
  const double size = angle / ball_.across;
  const Geometry geometry{angle};
  const std::vector<double> up =
      graded_grid_lines(size, 0, std::numbers::pi / 2 - angle, ball_.height);
  const std::vector<double> inwards = graded_grid_lines(size, 0, core_depth, ball_.layers);
  const Vector<3> centre(0, 0, ball_.radius);
  std::vector<Vector<3>> layers;
  for (int k = 0; k <= ball_.height; ++k)
    for (int j = 0; j <= ball_.across; ++j)
      for (int i = 0; i <= 2 * ball_.across; ++i) {
        const double a = double(i - ball_.across) / ball_.across, b = double(j) / ball_.across;
        const double t = up[k] / up.back();
        const Vector<3> inner = geometry.core(a, b, t);
        mesh_.nodes.push_back(centre + ball_.radius * inner);
        skin_.push_back(-1);
        if (!on_skin(i, j, k)) continue;
        skin_.back() = static_cast<int>(layers.size()) / ball_.layers;
        const Vector<3> outer = geometry.sphere(a, b, t);
        for (int layer = 1; layer <= ball_.layers; ++layer) {
          const double depth = inwards[ball_.layers - layer] / core_depth;
          layers.push_back(centre + ball_.radius * between(outer, inner, depth));
        }
      }
  mesh_.nodes.insert(mesh_.nodes.end(), layers.begin(), layers.end());
}

void BallMesh::add_core() {
  for (int k = 0; k < ball_.height; ++k)
    for (int j = 0; j < ball_.across; ++j)
      for (int i = 0; i < 2 * ball_.across; ++i)
        mesh_.cells.push_back({core_node(i, j, k), core_node(i + 1, j, k),
                               core_node(i + 1, j + 1, k), core_node(i, j + 1, k),
                               core_node(i, j, k + 1), core_node(i + 1, j, k + 1),
                               core_node(i + 1, j + 1, k + 1), core_node(i, j + 1, k + 1)});
}

void BallMesh::add_layers(const Mesh<3>::Facet& facet) {
  for (int layer = 0; layer < ball_.layers; ++layer) {
    Mesh<3>::Cell cell;
    for (int corner = 0; corner < 4; ++corner) {
      cell[corner] = layer_node(facet[corner], layer);
      cell[corner + 4] = layer_node(facet[corner], layer + 1);
    }
    mesh_.cells.push_back(cell);
  }
}

std::string BallMesh::part_of(const Mesh<3>::Facet& facet) const {
  bool symmetry = true, top = true, near = false;
  for (int node : facet) {
    const Vector<3>& X = mesh_.nodes[node];
    symmetry &= X[1] == 0;
    top &= X[2] == ball_.radius;
    near |= X.head<2>().norm() <= ball_.contact_radius;
  }
  return symmetry ? "symmetry" : top ? "top" : near ? "contact" : "free";
}

}  // namespace

Mesh<3> quarter_ball(const QuarterBall& ball) {
  if (ball.across < 1 || ball.height < 1 || ball.layers < 1)
    throw InputError("quarter ball: every number of elements must be positive");
  if (!(ball.patch_half_width > 0 && ball.patch_half_width < ball.radius))
    throw InputError("quarter ball: the half width of the patch must lie between 0 and the radius");
  return BallMesh(ball).take();
}

}  // namespace gnomon

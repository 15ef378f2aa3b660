#include <algorithm>
#include <array>
#include <gnomon/model/wear_model.hpp>
#include <optional>

namespace gnomon {

namespace {

struct SurfacePoint {
  double s, pressure, gap;  // position along the plane
  double covered;           // by the partner: a part of its share of the surface
  bool active;
  std::array<int, 2> next;  // neighbours along the surface, after and before; -1: its end
};

/// A walk along the surface, whatever the numbers of its nodes: wearing surfaces meet at seams, and
/// a closed one begins somewhere.
class Walk {
public:
  /// Begins at a point, away from the middle of the contact.
  Walk(const std::vector<SurfacePoint>& points, int from, int outwards)
      : points_(points), from_(from) {
    const auto is_further = [&](int k) {
      return k >= 0 && outwards * (points[k].s - points[from].s) > 0;
    };
    direction_ = is_further(points[from].next[1]) ? 1 : 0;
    ends_ = !is_further(points[from].next[direction_]);
  }
  /// The point after so many steps, fewer than none backwards; null where the surface ends.
  const SurfacePoint* at(int steps) const {
    if (steps > 0 && ends_) return nullptr;
    int k = from_;
    for (int i = 0; i < std::abs(steps) && k >= 0; ++i)
      k = points_[k].next[steps > 0 ? direction_ : 1 - direction_];
    return k < 0 ? nullptr : &points_[k];
  }

private:
  const std::vector<SurfacePoint>& points_;
  int from_, direction_ = 0;
  bool ends_ = false;
};

/// Where the partner ends within the shares of active points, counted from the last one that it
/// covers; none where it covers the outermost.
std::optional<double> uncovered_edge(const Walk& walk, int outwards) {
  constexpr double whole = 0.9;
  double beyond = 0;
  for (int k = 0;; --k) {
    const SurfacePoint *at = walk.at(k), *outer = walk.at(k + 1), *inner = walk.at(k - 1);
    if (!at || !at->active || !inner) return {};
    const double outside = outer ? std::abs(outer->s - at->s) / 2 : 0,
                 inside = std::abs(at->s - inner->s) / 2;
    if (at->covered >= whole) {
      if (k == 0) return {};
      return at->s + outwards * (outside + beyond);
    }
    beyond += at->covered * (inside + outside);
  }
}

/// Edge beyond the outermost active point in a direction along the plane (+1 or -1).
double edge(const std::vector<SurfacePoint>& points, int last, int outwards) {
  const Walk walk(points, last, outwards);
  if (const auto end = uncovered_edge(walk, outwards)) return *end;
  const SurfacePoint& in = points[last];
  const SurfacePoint* inner = walk.at(-1);
  const SurfacePoint* open = walk.at(1);
  if (!open) return in.s;  // contact up to the end of the surface
  const double width = open->s - in.s;
  if (inner && inner->active) {
    const double fall = inner->pressure * inner->pressure - in.pressure * in.pressure;
    const double reach = fall > 0 ? (in.s - inner->s) * in.pressure * in.pressure / fall : width;
    if (std::abs(reach) < std::abs(width)) return in.s + reach;
  }
  const SurfacePoint* beyond = walk.at(2);
  if (!beyond || beyond->gap <= open->gap) return open->s;
  const double back = open->gap * (beyond->s - open->s) / (beyond->gap - open->gap);
  return open->s - (std::abs(back) < std::abs(width) ? back : width);
}

/// Whether one of two contact nodes is on the axis of a body of revolution.
bool reach_axis(const Assembly<2>& body, int first, int last) {
  const double r = body.contact_nodes[first].initial_position[0],
               s = body.contact_nodes[last].initial_position[0];
  return body.section() == Section::meridian && std::min(r, s) <= 1e-9 * std::max(r, s);
}

/// Positions among the contact nodes of the neighbours of one of them.
std::array<int, 2> neighbours(const std::vector<ContactPatch<2>>& patches,
                              const ContactPatch<2>& patch) {
  std::array<int, 2> next = {-1, -1};
  for (const auto& corner : patch.corners) {
    const int other = patch.nodes[static_cast<std::size_t>(corner.nodes[1])];
    const auto found = std::ranges::lower_bound(patches, other, {}, &ContactPatch<2>::node);
    next[corner.sign > 0 ? 1 : 0] = static_cast<int>(found - patches.begin());
  }
  return next;
}

}  // namespace

double contact_half_width(const Assembly<2>& body, const WornBodyFields& fields,
                          const FieldValues<2>& values, const std::vector<ContactNode<2>>& nodes) {
  const Vector<2>& e = body.interface.partner.approach;
  const Vector<2> along(e[1], -e[0]);
  std::vector<SurfacePoint> points;
  int first = -1, last = -1;  // active ones, outermost along the plane
  for (int c = 0; c < static_cast<int>(body.contact_nodes.size()); ++c) {
    const int node = body.contact_nodes[c].node;
    const Vector<2> x =
        body.mesh.nodes[node] +
        (values.vector(fields.d).row(node) + values.vector(fields.u).row(node)).transpose();
    const ContactNode<2>& contact = nodes[c];
    const double covered =
        body.pairs.empty() ? 1 : contact.area / body.contact_nodes[c].initial_area;
    points.push_back({along.dot(x), -contact.traction, contact.gap, covered,
                      body.carries[c] && contact.active && contact.traction < 0,
                      neighbours(body.contact_nodes, body.contact_nodes[c])});
    if (!points.back().active) continue;
    if (first < 0 || points[c].s < points[first].s) first = c;
    if (last < 0 || points[c].s > points[last].s) last = c;
  }
  if (first < 0) return 0;
  const double extent = std::abs(edge(points, last, 1) - edge(points, first, -1));
  return reach_axis(body, first, last) ? extent : extent / 2;
}

}  // namespace gnomon

#include <algorithm>
#include <array>
#include <gnomon/model/wear_model.hpp>

namespace gnomon {

namespace {

struct SurfacePoint {
  double s, pressure, gap;  // position along the plane
  bool active;
};

/// Edge beyond point `last` (active) in direction `step` (+1 or -1) along the surface.
double edge(const std::vector<SurfacePoint>& points, int last, int step) {
  const auto at = [&](int k) -> const SurfacePoint* {
    return k >= 0 && k < static_cast<int>(points.size()) ? &points[k] : nullptr;
  };
  const SurfacePoint& in = points[last];
  const SurfacePoint* inner = at(last - step);
  const SurfacePoint* open = at(last + step);
  if (!open) return in.s;  // contact up to the end of the surface
  const double width = open->s - in.s;
  if (inner && inner->active) {
    const double fall = inner->pressure * inner->pressure - in.pressure * in.pressure;
    const double reach = fall > 0 ? (in.s - inner->s) * in.pressure * in.pressure / fall : width;
    if (std::abs(reach) < std::abs(width)) return in.s + reach;
  }
  const SurfacePoint* beyond = at(last + 2 * step);
  if (!beyond || beyond->gap <= open->gap) return open->s;
  const double back = open->gap * (beyond->s - open->s) / (beyond->gap - open->gap);
  return open->s - (std::abs(back) < std::abs(width) ? back : width);
}

/// Whether one of two contact nodes is on the axis of a body of revolution.
bool reach_axis(const WornBody<2>& body, int first, int last) {
  const double r = body.contact_nodes[first].initial_position[0],
               s = body.contact_nodes[last].initial_position[0];
  return body.element.section == Section::meridian && std::min(r, s) <= 1e-9 * std::max(r, s);
}

}  // namespace

double contact_half_width(const WornBody<2>& body, const WornBodyFields& fields,
                          const FieldValues<2>& values, const std::vector<ContactNode<2>>& nodes) {
  const Vector<2>& e = body.contact.counter_body.approach;
  const Vector<2> along(e[1], -e[0]);
  std::vector<SurfacePoint> points;
  int first = -1, last = -1;
  for (int c = 0; c < static_cast<int>(body.contact_nodes.size()); ++c) {
    const int node = body.contact_nodes[c].node;
    const Vector<2> x =
        body.mesh.nodes[node] +
        (values.vector(fields.d).row(node) + values.vector(fields.u).row(node)).transpose();
    const ContactNode<2>& contact = nodes[c];
    points.push_back(
        {along.dot(x), -contact.traction, contact.gap, contact.active && contact.traction < 0});
    if (!points.back().active) continue;
    if (first < 0) first = c;
    last = c;
  }
  if (first < 0) return 0;
  const double extent = std::abs(edge(points, last, 1) - edge(points, first, -1));
  return reach_axis(body, first, last) ? extent : extent / 2;
}

}  // namespace gnomon

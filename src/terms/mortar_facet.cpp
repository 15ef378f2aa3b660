#include <gnomon/terms/mortar_facet.hpp>

namespace gnomon {

namespace {

/// Where less than this part of a facet is covered, its mass has no accurate inverse.
constexpr double least_cover = 1e-6;

/// The mass of the whole facet, nearly.
template <int dim>
double size_of(const FacetNodal<dim>& X, Section section) {
  if constexpr (dim == 2) {
    const double length = (X.row(1) - X.row(0)).norm();
    return section == Section::meridian ? M_PI * (X(0, 0) + X(1, 0)) * length : length;
  } else {
    const Vector<3> a = X.row(2) - X.row(0), b = X.row(3) - X.row(1);
    return a.cross(b).norm() / 2;
  }
}

/// By which the shape functions of corners of which hardly anything is covered are added to those
/// of their neighbours: alone they would have a multiplier that hardly any area determines, and a
/// gap that is extrapolated to them from far away. Row sums of what is shared, and with them all
/// forces, stay.
template <class Square>
Square kept_corners(const Square& mass) {
  constexpr double least = 0.05;  // of the largest area of a corner
  constexpr auto n = static_cast<int>(Square::RowsAtCompileTime);
  const Eigen::Matrix<double, n, 1> area = mass.rowwise().sum();
  const auto is_kept = [&](int a) { return area[a % n] >= least * area.maxCoeff(); };
  Square P = Square::Identity();
  for (int a = 0; a < n; ++a) {
    if (is_kept(a)) continue;
    const int next = (a + 1) % n, last = (a + n - 1) % n, opposite = (a + 2) % n;
    P(a, a) = 0;
    if (is_kept(next) && is_kept(last))
      P(next, a) += 0.5, P(last, a) += 0.5;  // in the plane both are one
    else
      P(is_kept(next) ? next : is_kept(last) ? last : opposite, a) = 1;
  }
  return P;
}

/// psi = A phi, with the shape functions P phi of the kept corners: A = diag(m 1) m^-1 P, where m
/// is the mass of these.
template <class Square>
struct DualBasis {
  Square P, inverse, of_kept, A;

  explicit DualBasis(const Square& mass) : P(kept_corners(mass)) {
    Square m = P * mass * P.transpose();
    const auto areas = m.rowwise().sum().eval();
    for (int a = 0; a < m.rows(); ++a)
      if (P(a, a) == 0) m(a, a) = 1;
    inverse = m.inverse();
    of_kept = areas.asDiagonal() * inverse;
    A = of_kept * P;
  }
  /// The derivative of A by that of the mass.
  Square derivative(const Square& by) const {
    const Square dm = P * by * P.transpose();
    return (Square(dm.rowwise().sum().asDiagonal()) - of_kept * dm) * inverse * P;
  }
};

/// Sums over the parts that cover a facet.
template <int dim>
struct Cover {
  typename MortarFacet<dim>::Square mass = MortarFacet<dim>::Square::Zero();
  typename MortarFacet<dim>::Nodal raw = MortarFacet<dim>::Nodal::Zero();  // gap by phi

  /// Whether the part covers anything.
  bool add(const CoveredPart<dim>& part, int number, MortarFacet<dim>& to) {
    if (part.mass.sum() == 0) return false;
    mass += part.mass;
    raw += part.gap;
    to.masters.push_back({number, part.coupling, part.shared});
    return true;
  }
  /// Whether enough is covered; then by the dual basis.
  bool finish(const FacetNodal<dim>& X, Section section, MortarFacet<dim>& to) const {
    if (!(mass.sum() > least_cover * size_of<dim>(X, section))) {
      to.masters.clear();
      return false;
    }
    const DualBasis dual(mass);
    to.D = dual.P * mass.rowwise().sum();
    to.gap = dual.A * raw;
    for (auto& master : to.masters) {
      master.M = dual.A * master.M;
      master.W = dual.P * master.W;
    }
    return true;
  }
};

}  // namespace

template <int dim>
MortarFacet<dim>::MortarFacet(FacetPair<dim> pair, const std::vector<FacetNodal<dim>>& y,
                              const std::vector<int>& facets, Section section, double reach) {
  Cover<dim> cover;
  for (std::size_t k = 0; k < y.size(); ++k) {
    pair.y = y[k];
    cover.add(covered_part(pair, section, reach), facets[k], *this);
  }
  cover.finish(pair.X, section, *this);
}

template <int dim>
MortarFacetTangent<dim>::MortarFacetTangent(FacetPair<dim> pair,
                                            const std::vector<FacetNodal<dim>>& y,
                                            const std::vector<int>& facets, Section section,
                                            double reach)
    : facet(pair, {}, {}, section, reach) {
  std::vector<CoveredPartTangent<dim>> parts;
  Cover<dim> cover;
  for (std::size_t k = 0; k < y.size(); ++k) {
    pair.y = y[k];
    CoveredPartTangent<dim> part = covered_part_tangent(pair, section, reach);
    if (cover.add(part.part, facets[k], facet)) parts.push_back(std::move(part));
  }
  if (!cover.finish(pair.X, section, facet)) {
    by_input.resize(row_of_masters, own);
    by_input.setZero();
    return;
  }
  const DualBasis dual(cover.mass);
  const auto count = static_cast<int>(parts.size());
  by_input.resize(row_of_masters + count * rows_of_master, own + count * each);
  by_input.setZero();
  constexpr int coupling = n * n, shared = 2 * n * n, gap = 3 * n * n;  // rows of a part
  for (int column = 0; column < by_input.cols(); ++column) {
    // Of the parts that depend on this input: its column there, -1: none.
    const auto column_of = [&](int k) {
      return column < own ? column : (column - own) / each == k ? own + (column - own) % each : -1;
    };
    Square dm = Square::Zero();
    typename MortarFacet<dim>::Nodal dr = MortarFacet<dim>::Nodal::Zero();
    for (int k = 0; k < count; ++k) {
      if (const int at = column_of(k); at >= 0) {
        dm += parts[k].by_input.col(at).template segment<n * n>(0).reshaped(n, n);
        dr += parts[k].by_input.col(at).template segment<n>(gap);
      }
    }
    const Square dA = dual.derivative(dm);
    by_input.col(column).template segment<n>(0) = dual.P * dm.rowwise().sum();
    by_input.col(column).template segment<n>(row_of_gap) = dA * cover.raw + dual.A * dr;
    for (int k = 0; k < count; ++k) {
      Square dW = Square::Zero(), dR = dW;
      if (const int at = column_of(k); at >= 0) {
        dR = parts[k].by_input.col(at).template segment<n * n>(coupling).reshaped(n, n);
        dW = parts[k].by_input.col(at).template segment<n * n>(shared).reshaped(n, n);
      }
      const int row = row_of_masters + k * rows_of_master;
      const Square dM = dA * parts[k].part.coupling + dual.A * dR;
      by_input.col(column).template segment<n * n>(row) = dM.reshaped();
      by_input.col(column).template segment<n * n>(row + n * n) = (dual.P * dW).reshaped();
    }
  }
}

template struct MortarFacet<2>;
template struct MortarFacetTangent<2>;
template struct MortarFacet<3>;
template struct MortarFacetTangent<3>;

}  // namespace gnomon

#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/butcher_table.hpp>

namespace gnomon {

namespace {

/// The conditions for an order up to four (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
/// Differential Equations I, table II.2.1).
bool has_order(const ButcherTable& table, const Eigen::VectorXd& b, int order) {
  const Eigen::VectorXd &c = table.c, square = c.cwiseAbs2(), Ac = table.A * c;
  const auto is = [](double sum, double expected) { return std::abs(sum - expected) < 1e-10; };
  if (!is(b.sum(), 1)) return false;
  if (order >= 2 && !is(b.dot(c), 1.0 / 2)) return false;
  if (order >= 3 && !(is(b.dot(square), 1.0 / 3) && is(b.dot(Ac), 1.0 / 6))) return false;
  return order < 4 ||
         (is(b.dot(square.cwiseProduct(c)), 1.0 / 4) && is(b.dot(c.cwiseProduct(Ac)), 1.0 / 8) &&
          is(b.dot(table.A * square), 1.0 / 12) && is(b.dot(table.A * Ac), 1.0 / 24));
}

}  // namespace

ButcherTable checked_table(ButcherTable table) {
  const auto require = [&](bool right, const std::string& expected) {
    if (!right)
      throw RegistrationError(
          fmt::format("the Runge-Kutta table \"{}\": expected {}", table.name, expected));
  };
  const Eigen::Index stages = table.b.size();
  const bool embedded = table.embedded_order > 0;
  require(stages > 0 && table.A.rows() == stages && table.A.cols() == stages &&
              table.c.size() == stages && table.b_embedded.size() == (embedded ? stages : 0),
          "A, b, c, and b_embedded where there is an embedded order, of as many stages");
  require(table.A.allFinite() && table.b.allFinite() && table.c.allFinite() &&
              table.b_embedded.allFinite(),
          "finite values");
  require(table.A.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().isZero(0),
          "A that is lower triangular");
  require((table.A.rowwise().sum() - table.c).cwiseAbs().maxCoeff() < 1e-10, "c = A 1");
  require(table.order > 0 && has_order(table, table.b, table.order),
          fmt::format("the conditions for order {} to hold for b", table.order));
  require(!embedded || has_order(table, table.b_embedded, table.embedded_order),
          fmt::format("the conditions for order {} to hold for b_embedded", table.embedded_order));
  return table;
}

}  // namespace gnomon

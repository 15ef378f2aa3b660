// What a slave facet adds to J, as a dense matrix.
#pragma once

#include <algorithm>
#include <gnomon/terms/mortar_facet.hpp>
#include <gnomon/terms/mortar_pair.hpp>
#include <gnomon/terms/mortar_traction.hpp>
#include <vector>

namespace gnomon {

/// The mesh nodes that a slave facet and some masters join: its corners, the masters' nodes, then
/// the others around, each once.
template <int dim>
struct FacetNodes {
  static constexpr int corners = Mesh<dim>::facet_nodes;
  std::vector<int> all;
  std::size_t rows = 0;  ///< the first of them have rows: corners and masters
  std::vector<std::array<int, corners>> masters{};  ///< positions in `all` of each master's nodes

  template <class CornerNode>
  FacetNodes(const MortarPair<dim>& pair, const std::vector<int>& around,
             const std::vector<int>& facets, const CornerNode& corner) {
    for (int a = 0; a < corners; ++a) all.push_back(corner(a));
    for (const int facet : facets) {
      auto& positions = masters.emplace_back();
      for (int b = 0; b < corners; ++b) positions[b] = place(pair.master[facet][b]);
    }
    rows = all.size();
    for (const int node : around) place(node);
  }
  std::vector<int> with_rows() const { return {all.begin(), all.begin() + std::ptrdiff_t(rows)}; }
  int position(int node) const {
    return static_cast<int>(std::ranges::find(all, node) - all.begin());
  }

private:
  int place(int node) {
    const int at = position(node);
    if (at == static_cast<int>(all.size())) all.push_back(node);
    return at;
  }
};

/// How the positions and normals of which a facet's sums are functions move with its nodes.
template <int dim>
class FacetMotion {
  static constexpr int corners = Mesh<dim>::facet_nodes;
  static constexpr Eigen::Index size = dim;  // its products are indices
  using Tangent = MortarFacetTangent<dim>;

public:
  struct ByNode {
    int position = 0;  ///< among the nodes
    Tensor<dim> by;    ///< of a normal, by the node's u or d
  };

  /// `nodes` must outlive the object.
  FacetMotion(const FacetNodes<dim>& nodes, const PairPlaces<dim>& places)
      : nodes_(nodes), turn_({places.of[0].turn, places.of[1].turn}) {}
  void set_normal(int a, const ContactPatch<dim>& patch, const NodeNormal<dim>& normal) {
    for (std::size_t p = 0; p < patch.nodes.size(); ++p)
      if (!normal.by_x[p].isZero(0))
        normal_[a].push_back({nodes_.position(patch.nodes[p]), normal.by_x[p] * turn_[0]});
  }

  const FacetNodes<dim>& nodes() const { return nodes_; }
  const Tensor<dim>& turn(int body) const { return turn_[body]; }  ///< 0: slave, 1: master
  const std::vector<ByNode>& normal(int a) const { return normal_[a]; }
  /// Derivatives by u, then by d, of all nodes, from those by the inputs of a MortarFacetTangent.
  Eigen::MatrixXd by_nodes(const Eigen::Ref<const Eigen::MatrixXd>& by_input) const {
    constexpr int X = 0, x = corners * dim, n = 2 * corners * dim, y = Tangent::own;
    const Eigen::Index columns = size * std::ssize(nodes_.all);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(by_input.rows(), 2 * columns);
    auto by_u = result.leftCols(columns);
    const auto move = [&](int position, int input, const Tensor<dim>& by) {
      by_u.middleCols(size * position, dim).noalias() += by_input.middleCols(input, dim) * by;
    };
    for (int a = 0; a < corners; ++a) {
      move(a, x + dim * a, turn_[0]);
      for (const ByNode& node : normal_[a]) move(node.position, n + dim * a, node.by);
    }
    for (std::size_t k = 0; k < nodes_.masters.size(); ++k)
      for (int b = 0; b < corners; ++b)
        move(nodes_.masters[k][b], y + static_cast<int>(k) * Tangent::each + dim * b, turn_[1]);
    // A change of d moves the undeformed position and, with it, the current one.
    result.rightCols(columns) = by_u;
    result.middleCols(columns, size * corners) += by_input.middleCols(X, size * corners);
    return result;
  }

private:
  const FacetNodes<dim>& nodes_;
  std::array<Tensor<dim>, 2> turn_;
  std::array<std::vector<ByNode>, corners> normal_;
};

/// Rows: lambda of the corners, then u and d of the nodes with rows; columns: the own unknowns of
/// each corner (MortarTraction), then u and d of all nodes.
template <int dim>
class FacetMatrix {
  static constexpr int corners = Mesh<dim>::facet_nodes;
  static constexpr Eigen::Index size = dim;  // its products are indices
  using Tangent = MortarFacetTangent<dim>;
  using Wide = Eigen::Matrix<double, dim, Eigen::Dynamic>;

public:
  /// `own`: unknowns of each corner. The others must outlive the object.
  FacetMatrix(const FacetMotion<dim>& motion, const Tangent& tangent, int own)
      : nodes_(motion.nodes()),
        motion_(motion),
        tangent_(tangent),
        own_(own),
        columns_(dim * std::ssize(nodes_.all)),
        G_(motion.by_nodes(tangent.by_input)) {
    const auto rows = static_cast<int>(nodes_.rows);
    K_ = Eigen::MatrixXd::Zero(corners + 2 * size * rows, corners * own_ + 2 * columns_);
    mean_ = Eigen::RowVectorXd::Zero(K_.cols());
  }

  /// The traction of a corner, which must outlive the matrix; of all corners, before anything is
  /// added.
  void set_traction(int a, const MortarTraction<dim>& traction) {
    Wide& traction_by = traction_by_[a];
    Eigen::RowVectorXd& speed_by = speed_by_[a];
    traction_by = Wide::Zero(dim, 2 * columns_);
    speed_by = Eigen::RowVectorXd::Zero(2 * columns_);
    const auto add = [&](int position, const Tensor<dim>& change,
                         const Eigen::Matrix<double, 1, dim>& faster) {
      for (const Eigen::Index first : {size * position, columns_ + size * position}) {
        traction_by.middleCols(first, dim) += change;
        speed_by.segment(first, dim) += faster;
      }
    };
    for (const auto& [position, by] : motion_.normal(a))
      add(position, traction.by_n * by, traction.speed_by_n * by);
    add(a, traction.by_x * motion_.turn(0), traction.speed_by_x * motion_.turn(0));
    traction_[a] = &traction;
  }

  /// The contact of a closed corner.
  void add_slave(int a, double initial_area) {
    const Tensor<dim> back = motion_.turn(0).transpose();
    add_force(u_row(a), a, tangent_.facet.D[a] * back, back * traction_[a]->value, G_.row(a));
    K_.row(a).tail(2 * columns_) += G_.row(Tangent::row_of_gap + a) / initial_area;
  }
  /// Its force on corner b of a covering master.
  void add_pressing(int a, int master, int b) {
    const Tensor<dim> back = -motion_.turn(1).transpose();
    add_force(u_row(nodes_.masters[master][b]), a, tangent_.facet.masters[master].M(a, b) * back,
              back * traction_[a]->value, G_.row(Tangent::row_of_M(master, a, b)));
  }
  /// Its wear along a direction per volume, with the rate and its derivatives by pressure and
  /// speed.
  void add_slave_wear(int a, const Vector<dim>& direction, double rate, double rate_by_pressure,
                      double rate_by_speed) {
    const double D = tangent_.facet.D[a];
    const MortarTraction<dim>& of = *traction_[a];
    K_.block(d_row(a), corners * own_, dim, 2 * columns_) +=
        direction * (rate * G_.row(a) + rate_by_speed * D * speed_by_[a]);
    K_.block(d_row(a), own_ * a, dim, own_) +=
        D * direction * (rate_by_pressure * of.pressure_by_own + rate_by_speed * of.speed_by_own);
  }
  /// The wear of corner b of a master by the area that it shares with corner a.
  void add_master_wear(int a, int master, int b, const Vector<dim>& direction, double by_shared) {
    K_.block(d_row(nodes_.masters[master][b]), corners * own_, dim, 2 * columns_) +=
        by_shared * direction * G_.row(Tangent::row_of_M(master, a, b) + corners * corners);
  }
  /// The same by the pressure and the speed of corner a.
  void add_master_wear_by_traction(int a, int master, int b, const Vector<dim>& direction,
                                   double by_pressure, double by_speed) {
    const double W = tangent_.facet.masters[master].W(a, b);
    const MortarTraction<dim>& of = *traction_[a];
    const Eigen::Index row = d_row(nodes_.masters[master][b]);
    K_.block(row, own_ * a, dim, own_) +=
        W * direction * (by_pressure * of.pressure_by_own + by_speed * of.speed_by_own);
    K_.block(row, corners * own_, dim, 2 * columns_) += by_speed * W * direction * speed_by_[a];
  }

  /// What a corner adds to the mean of q: by its area, and per area by its pressure and speed.
  void add_to_mean(int a, double by_area, double by_pressure, double by_speed) {
    const double D = tangent_.facet.D[a];
    const MortarTraction<dim>& of = *traction_[a];
    mean_.tail(2 * columns_) += by_area * G_.row(a) + D * by_speed * speed_by_[a];
    mean_.segment(own_ * a, own_) +=
        D * (by_pressure * of.pressure_by_own + by_speed * of.speed_by_own);
  }

  const Eigen::MatrixXd& values() const { return K_; }
  /// The row of the mean of q.
  const Eigen::RowVectorXd& mean() const { return mean_; }
  /// The rows of u of a corner.
  auto force_on(int a) const { return K_.middleRows(u_row(a), dim); }
  /// Their sum.
  Eigen::MatrixXd force_on_slave() const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dim, K_.cols());
    for (int a = 0; a < corners; ++a) sum += force_on(a);
    return sum;
  }

private:
  /// A force that is `area` times the traction of corner a; `by_area` by the area.
  template <class Row>
  void add_force(Eigen::Index row, int a, const Tensor<dim>& area, const Vector<dim>& by_area,
                 const Row& change) {
    K_.block(row, corners * own_, dim, 2 * columns_) += by_area * change + area * traction_by_[a];
    K_.block(row, own_ * a, dim, own_) += area * traction_[a]->by_own;
  }
  Eigen::Index u_row(int position) const { return corners + size * position; }
  Eigen::Index d_row(int position) const {
    return corners + size * (static_cast<int>(nodes_.rows) + position);
  }

  const FacetNodes<dim>& nodes_;
  const FacetMotion<dim>& motion_;
  const Tangent& tangent_;
  Eigen::Index own_, columns_;
  Eigen::MatrixXd G_, K_;  // G: derivatives of the facet's sums by u and d of all nodes
  std::array<const MortarTraction<dim>*, corners> traction_{};
  Eigen::RowVectorXd mean_;
  std::array<Wide, corners> traction_by_;  // by u and d of all nodes
  std::array<Eigen::RowVectorXd, corners> speed_by_;
};

}  // namespace gnomon

// Contact of deformable surfaces by segment mortar with dual multipliers (docs/two_bodies.md). With
// the sums D, g, M and W over the slave's facets (mortar_facet.hpp), for slave nodes i and master
// nodes j, lambda <= 0 and the traction direction tau (mortar_node.hpp):
//
//   u, slave    D_i lambda_i tau_i                           eq. (25)
//   u, master   -sum_i M_ij lambda_i tau_i
//   lambda      g_i / A^_i = 0 in contact, else lambda_i = 0     eq. (26)
//   d, slave    Wdot(p_i) D_i P N_i / A_i,   p_i = -lambda_i         eq. (14)
//   d, master   Wdot(p_j) C_j P N_j / A_j,   C_j = sum_i W_ij, p_j = sum_i p_i W_ij / C_j
//
// In a phase of a cycle the bodies have places, x = R (X + d + u) + c: sums and tractions are those
// in space, and forces in the rows of u are turned back, R^T f.
//
// The speed v_i of sliding is that of the slave; a master has v_j = sum_i p_i v_i W_ij / (p_j C_j).
// So the forces on both bodies are equal, and the volumes that they lose where their laws are
// and are proportional to p v.
//
// Where friction may stick (docs/fretting.md), the traction is lambda n_p + lambda_T, and, in each
// phase of the path,
//
//   lambda_T  C of StickFriction, slip = r - r of the phase before      eq. (10), (11)
//   r         r_i - (sum_j M_ij (X_j + d_j) / D_i - X_i) = 0, the place on the partner's material;
//             r_i - r of the phase before = 0 where nothing covers the node
//   s         sdot - (r - s) / period = 0, in the last phase
//
// p_i is then the mean of this phase and the one before, v_i = |slip| / interval. In steady rolling
// (docs/rolling.md) there is one phase and no memory; the material of the slave was upstream
// before, and the master's has gone on since, slip = r - sum_k f_k r_k + dt (V^1 - V^2), where the
// difference of the velocities may have unknown components |V| xi, each with a row
//
//   xi        sum_i D_i tau_i lambda_i - F = 0, of all slaves, along the component
//
// and |V| omega W (X_i - centre) an unknown spin, whose row is that of the moment about its axis.
//
// Wear laws of the surfaces of a pair may read the mean of q over its contact, an unknown of the
// pair,
//
//   q_mean    sum_i D_i (s_i q_mean - q_i) = 0
//
// with the share s_i of a slave that counts as in contact (laws/contact_share.hpp). A master has
// s_j = sum_i s_i W_ij / C_j, so that both bodies lose the same by a law k q_mean.
#pragma once

#include <algorithm>
#include <gnomon/laws/contact_share.hpp>
#include <gnomon/terms/contact_nodes.hpp>
#include <gnomon/terms/mortar_facet.hpp>
#include <gnomon/terms/mortar_pair.hpp>
#include <gnomon/terms/mortar_traction.hpp>
#include <gnomon/terms/places_on_partner.hpp>
#include <memory>
#include <optional>

namespace gnomon {

/// The same of pairs.
template <int dim>
struct MortarPath : StickingFriction<dim> {
  FieldId place = FieldId::none;     ///< r
  FieldId creepage = FieldId::none;  ///< xi, a part of `before`; its rows have the force F
  /// An unknown spin, the same of each contact node; by its arms the rows have the moment.
  FieldId spin = FieldId::none;
  std::vector<double> arm{};  ///< of the contact nodes [length]
  bool flat = false;          ///< slopes are left out: small strains in rolling
};

/// All pairs of an assembly in one contact state. The referenced objects must outlive the term.
template <int dim>
struct MortarState {
  FieldId u = FieldId::none;           ///< displacement, at all nodes of the mesh
  FieldId lambda = FieldId::none;      ///< contact multiplier, at the contact nodes of slaves
  FieldId d = FieldId::none;           ///< shape; none: wear does not move the mesh
  FieldId mean_power = FieldId::none;  ///< q_mean of each pair, of laws that read it in rolling
  const Mesh<dim>& mesh;
  const std::vector<ContactPatch<dim>>& patches;  ///< of slaves and masters, ascending nodes
  const std::vector<MortarPair<dim>>& pairs;
  std::vector<MortarCandidates> candidates;  ///< by pair
  const std::vector<int>& surface_of;        ///< each contact node: whose law wears it
  std::vector<WearLaw> laws{};               ///< of the surfaces
  std::vector<double> wear_weight{};         ///< of each contact node, in its wear; empty: 1
  NormalRule normal_rule = NormalRule::conservative;
  Section section = Section::plane;
  double rho = 1;                         ///< [stress / length]
  std::vector<BodyPlace<dim>> places{};   ///< of the bodies; empty: at rest
  double part = 1;                        ///< of the mean over a cycle: the weight of its phase
  double full_pressure = 0;               ///< from which a node is in contact as a whole [stress]
  double nominal_speed = 0;               ///< at which the bodies slide [length / time]
  std::optional<MortarPath<dim>> path{};  ///< friction may stick
};

template <int dim>
class FacetMatrix;
template <int dim>
class FacetMotion;
template <int dim>
struct FacetNodes;

template <int dim>
class MortarTerm : public ContactNodes<dim>, public PlacesOnPartner<dim> {
public:
  MortarTerm(const MortarState<dim>& state, const Numbering& numbering);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  /// For every slave node lambda + rho g [stress], where friction may stick |T^| - r [stress], then
  /// for all contact nodes the kinks of the wear law.
  void switching(const Evaluation<dim>& at, std::span<double> values) const override;
  std::vector<ContactNode<dim>> nodes(const Evaluation<dim>& at) const override;
  NodalField<dim> places(const Evaluation<dim>& at) const override;

private:
  static constexpr int corners = Mesh<dim>::facet_nodes;

  /// A contact node in one of its pairs.
  struct Side {
    int node = 0;  ///< contact node
    int pair = 0;
    bool slave = false;
    std::size_t first_switch = 0;
  };
  struct SlaveFacet {
    int pair = 0;
    std::array<int, corners> sides = {};
    std::vector<int> masters;  ///< candidates: positions among the pair's
    std::vector<int> around;   ///< mesh nodes on which the normals of its corners depend
  };
  /// What a side has at a state.
  struct SideState {
    double lambda = 0;     ///< effective; of a slave
    double area = 0;       ///< D of a slave, C of a master
    double gap = 0;        ///< g of a slave, times area
    double load = 0;       ///< force by pressure: D p, or sum_i p_i W_ij
    double rubbing = 0;    ///< the same of the pressures that wear
    double power = 0;      ///< rubbing times speed of sliding
    double touching = 0;   ///< area in contact: s D, or sum_i s_i W_ij
    ContactShare share{};  ///< s of a slave
    bool active = false;
    Vector<dim> force = Vector<dim>::Zero();     ///< in space
    Vector<dim> covering = Vector<dim>::Zero();  ///< of a slave sum_j M_ij (X_j + d_j) [volume]
    std::shared_ptr<const NodeNormal<dim>> normal{};  ///< of a slave
    MortarTraction<dim> traction{0};                  ///< of a slave
    std::optional<StickingTraction<dim>> sticking{};  ///< of a slave where friction may stick
    std::optional<WearDirection<dim>> direction{};
    WearRate rate{};
    double rate_by_pressure = 0, rate_by_speed = 0;  ///< friction power by the chain rule

    double pressure() const { return area > 0 ? rubbing / area : 0; }
    double contact_share() const { return area > 0 ? touching / area : 0; }
    /// Shares of area may be negative by rounding.
    double speed() const { return rubbing > 0 ? std::max(0.0, power / rubbing) : 0; }
  };
  /// What a slave adds to the row of the mean of q, and by what this changes.
  struct MeanPart {
    double value = 0, by_mean = 0, by_area = 0, by_pressure = 0, by_speed = 0;
  };
  /// All sums at a state.
  struct Surfaces {
    std::vector<SideState> sides;
    std::shared_ptr<const std::vector<MortarFacet<dim>>> facets;
  };
  /// What of them positions alone determine, at the last state: the residual, switching functions
  /// and J are mostly asked for at one state.
  struct Geometry {
    NodalField<dim> u, d;
    Surfaces surfaces;
  };
  void find_sides();
  void find_facets();
  void declare_facets(PatternBuilder& pattern) const;
  void declare_facet(const SlaveFacet& facet, PatternBuilder& pattern, PatternBuilder& nodes) const;
  Vector<dim> undeformed(const Evaluation<dim>& at, int node) const;
  Vector<dim> current(const Evaluation<dim>& at, int node, const BodyPlace<dim>& place) const;
  /// Undeformed ones, or where the nodes are in space.
  PatchNodal<dim> positions(const Evaluation<dim>& at, const ContactPatch<dim>& patch,
                            const BodyPlace<dim>* place) const;
  Surfaces surfaces(const Evaluation<dim>& at) const;
  /// Without tractions and wear; kept until it is asked for at another state, so that a term is not
  /// for several threads at once.
  Surfaces geometry(const Evaluation<dim>& at) const;
  /// Of a facet, and current ones of its candidates.
  std::pair<FacetPair<dim>, std::vector<FacetNodal<dim>>> places_of(const SlaveFacet& facet,
                                                                    const Evaluation<dim>& at,
                                                                    const Surfaces& result) const;
  void add_facets(const Evaluation<dim>& at, Surfaces& result) const;
  void find_traction(const Evaluation<dim>& at, const Side& side, SideState& state) const;
  void add_masters(Surfaces& result) const;
  double mean_power(const Evaluation<dim>& at, const Side& side) const;
  MeanPart mean_part(const Evaluation<dim>& at, const Side& side, const SideState& state) const;
  WearInput wear_input_of(const Evaluation<dim>& at, const Side& side,
                          const SideState& state) const;
  void find_wear(const Evaluation<dim>& at, const Side& side, SideState& state) const;
  void add_side(const Evaluation<dim>& at, const Side& side, const SideState& state,
                std::span<double> values) const;
  void declare_path(const Side& side, PatternBuilder& pattern) const;
  double depth(const Evaluation<dim>& at, const Side& side) const;
  WearMoment moment(const Evaluation<dim>& at, const Side& side) const;
  void find_sticking(const Evaluation<dim>& at, const Side& side, SideState& state) const;
  StickingParameters sticking_parameters(const Evaluation<dim>& at, const Side& side) const;
  StickingInput<dim> sticking_input(const Evaluation<dim>& at, const Side& side,
                                    const Vector<dim>& normal) const;
  /// r before, of a contact node.
  Vector<dim> before(const Evaluation<dim>& at, int contact_node) const;
  /// X + d of the nodes of a master facet.
  FacetNodal<dim> labels_of(const Evaluation<dim>& at, int pair, int master) const;
  /// r by where the bodies are, or nothing where no master covers the node.
  std::optional<Vector<dim>> place_on_partner(const Side& side, const SideState& state) const;
  void add_path_residual(const Evaluation<dim>& at, const Side& side, const SideState& state,
                         std::span<double> F) const;
  void add_path(const Evaluation<dim>& at, const Side& side, const SideState& state,
                double rate_weight, std::span<double> values) const;
  bool acts(const SlaveFacet& facet, const MortarFacet<dim>& sums, const Surfaces& at) const;
  void add_facet(const Evaluation<dim>& at, const SlaveFacet& facet,
                 const MortarFacetTangent<dim>& tangent, const FacetMotion<dim>& motion,
                 const Surfaces& state, std::span<double> values) const;
  void add_places(const Evaluation<dim>& at, const SlaveFacet& facet,
                  const MortarFacetTangent<dim>& tangent, const FacetMotion<dim>& motion,
                  const Surfaces& state, std::span<double> values) const;
  void add_master(const SlaveFacet& facet, const Surfaces& at, int master, int b, int side,
                  FacetMatrix<dim>& matrix) const;
  FacetNodes<dim> nodes_of(const SlaveFacet& facet, const std::vector<int>& masters) const;
  std::vector<int> rows_of(const SlaveFacet& facet, const FacetNodes<dim>& nodes) const;
  std::vector<int> columns_of(const SlaveFacet& facet, const FacetNodes<dim>& nodes) const;

  /// Whether the row of lambda is that of the gap: a node that nothing covers has none.
  static bool holds_gap(const SideState& state) { return state.active && state.area > 0; }
  /// Of contact and, where it may stick, of friction: before those of the wear law of a side.
  int contact_switches(const Side& side) const { return side.slave ? (state_.path ? 2 : 1) : 0; }
  const ContactPatch<dim>& patch(const Side& side) const { return state_.patches[side.node]; }
  const MortarPair<dim>& pair(const Side& side) const { return state_.pairs[side.pair]; }
  const BodyPlace<dim>& place(const Side& side) const { return places_[side.pair].of[!side.slave]; }
  const WearLaw& law(const Side& side) const { return state_.laws[state_.surface_of[side.node]]; }
  double weight(const Side& side) const {
    return state_.part * (state_.wear_weight.empty() ? 1 : state_.wear_weight[side.node]);
  }
  std::span<const char> law_branch(const Evaluation<dim>& at, const Side& side) const {
    if (at.branch.empty()) return {};
    return at.branch.subspan(side.first_switch + contact_switches(side), law(side).kinks());
  }
  /// Of the mean of q over the contact of a pair: one number, or none.
  std::vector<int> mean_number(int pair) const {
    if (mean_numbers_.empty()) return {};
    return {mean_numbers_[static_cast<std::size_t>(pair)]};
  }
  /// Of an unknown spin.
  std::vector<int> spin_number(int contact_node) const {
    if (spin_numbers_.size() == 0) return {};
    const auto row = spin_numbers_.row(contact_node);
    return {row.begin(), row.end()};
  }
  int lambda_number(const Side& side) const { return own_numbers_[side.node].front(); }
  int traction_number(const Side& side, int i) const { return own_numbers_[side.node][1 + i]; }
  int place_number(const Side& side, int i) const { return own_numbers_[side.node][1 + dim + i]; }
  static constexpr int before_0 = 2 + 2 * dim;  // the first own unknown of the places before
  /// Own unknowns in the place of the place before.
  Eigen::MatrixXd by_parts(int contact_node, const Eigen::MatrixXd& by_own) const;
  int side_of(int pair, int mesh_node) const { return side_of_[pair].at(mesh_node); }
  /// Numbers of u, then of d, of these mesh nodes; d only where the node wears, if `worn`.
  std::vector<int> numbers_of(const std::vector<int>& nodes, bool worn) const;
  void add(const std::vector<int>& rows, const std::vector<int>& columns, const Eigen::MatrixXd& K,
           std::span<double> values) const;
  void add(int row, int column, double value, std::span<double> values) const;

  MortarState<dim> state_;
  std::vector<PairPlaces<dim>> places_;  // by pair
  NodalNumbers<dim> u_numbers_, d_numbers_;
  bool shape_is_unknown_;                      // else a node may touch where it could not wear
  std::vector<std::vector<int>> own_numbers_;  // of each contact node: those of its traction;
                                               // masters: -1
  std::vector<int> creepage_numbers_;          // by component; empty: all are given
  NodalNumbers<dim> spin_numbers_;             // of contact nodes; empty: it is given
  std::vector<int> mean_numbers_;              // by pair; empty: no law reads a mean
  std::size_t most_parts_ = 0;                 // of a place before
  bool mixes_parts_ = false;                   // else each place before is one of another phase
  NodalNumbers<dim> memory_numbers_;           // of the last phase of a path
  std::vector<int> contact_of_;                // by mesh node; -1: none
  std::vector<std::map<int, int>> side_of_;    // by pair and mesh node
  std::vector<Side> sides_;
  std::vector<SlaveFacet> facets_;
  const SparsePattern* pattern_ = nullptr;
  mutable std::optional<Geometry> geometry_;
};

}  // namespace gnomon

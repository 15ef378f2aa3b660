#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>
#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/fields/numbering.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/model/condensation.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/terms/body_term.hpp>
#include <gnomon/terms/springs.hpp>
#include <map>
#include <memory>

#include "linear/blas.hpp"
#include "model/connected_parts.hpp"

namespace gnomon {

template <int dim>
std::string varying_stiffness(const AssemblyParts<dim>& parts) {
  if (!parts.shape.gap)
    return "shape.motion = \"gap\": where the mesh moves, the stiffness changes";
  if (!std::ranges::all_of(parts.bodies, [](const Body& body) {
        return body.element.kinematics == Kinematics::small;
      }))
    return "body.material = \"linear\": with finite strains the stiffness changes";
  const auto follows = [](const Load<dim>& load) { return load.forces.size() == 0; };
  if (std::ranges::any_of(parts.loads, follows) ||
      std::ranges::any_of(parts.swinging_loads, follows))
    return "loads that do not follow the surface, instead of a pressure";
  return {};
}

namespace {

/// All displacements of a mesh, numbered node by node, also those that are held.
template <int dim>
Numbering all_displacements(const Mesh<dim>& mesh) {
  auto set = std::make_shared<FieldSet>();
  set->nodes = static_cast<int>(mesh.nodes.size());
  const int block = set->add(Block{"displacement", "u", "all nodes"});
  const NodalFlags<dim> held = NodalFlags<dim>::Zero(set->nodes, dim);
  set->add(field_at_nodes<dim>("displacement", held, block, 1, 1));
  return {std::move(set), BlockSelection(1, 1)};
}

/// The derivative of the inner forces and those of the springs.
template <int dim>
Eigen::SparseMatrix<double> stiffness_of(const AssemblyParts<dim>& parts) {
  const Numbering numbering = all_displacements<dim>(parts.mesh);
  const auto u = static_cast<FieldId>(0);
  std::vector<std::unique_ptr<Term<dim>>> terms;
  terms.push_back(
      std::make_unique<BodyTerm<dim>>(parts.mesh, parts.bodies, numbering, u, FieldId::none));
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    terms.push_back(std::make_unique<Springs<dim>>(parts.mesh, springs.facets, springs.stiffness,
                                                   numbering, u, parts.section()));
  PatternBuilder builder(numbering.size());
  TermStructure structure{.pattern = builder};
  for (const auto& term : terms) term->declare(structure);
  const SparsePattern pattern = builder.build();
  std::vector<double> values(static_cast<std::size_t>(pattern.nonzeros()));
  const FieldValues<dim> at_rest(numbering.set());
  for (const auto& term : terms) {
    term->map_to(pattern);
    term->add_jacobian({.values = at_rest, .ydot = {}}, 0, values);
  }
  return Eigen::Map<const Eigen::SparseMatrix<double>>(
      pattern.size(), pattern.size(), pattern.nonzeros(), pattern.column_start.data(),
      pattern.row_index.data(), values.data());
}

/// Rows and columns of a matrix, by lists of node and direction.
template <int dim>
Eigen::SparseMatrix<double> part_of(const Eigen::SparseMatrix<double>& K,
                                    const std::vector<std::pair<int, int>>& rows,
                                    const std::vector<std::pair<int, int>>& columns) {
  const auto at = [](const std::pair<int, int>& place) { return dim * place.first + place.second; };
  std::vector<int> row(static_cast<std::size_t>(K.rows()), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) row[at(rows[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator k(K, at(columns[j])); k; ++k)
      if (row[k.row()] >= 0) entries.emplace_back(row[k.row()], static_cast<int>(j), k.value());
  Eigen::SparseMatrix<double> part(static_cast<Eigen::Index>(rows.size()),
                                   static_cast<Eigen::Index>(columns.size()));
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

bool is_symmetric(const Eigen::SparseMatrix<double>& K) {
  constexpr double rounding = 1e-13;
  const Eigen::SparseMatrix<double> difference = K - Eigen::SparseMatrix<double>(K.transpose());
  return difference.norm() <= rounding * K.norm();
}

/// Its solves shall not be refined, which would cost twice as much as they do.
void prepare(Eigen::UmfPackLU<Eigen::SparseMatrix<double>>& factors) {
  factors.umfpackControl()[UMFPACK_IRSTEP] = 0;
}
/// By default CHOLMOD may ask METIS for the whole order, whose handler of SIGTERM jumps out of
/// whatever thread gets the signal; here it asks for separators only.
void prepare(Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>& factors) {
  factors.cholmod().nmethods = 1;
  factors.cholmod().method[0].ordering = CHOLMOD_NESDIS;
}

template <class Factors>
std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> solver_of(
    const Eigen::SparseMatrix<double>& K) {
  if (K.rows() == 0) return [](const Eigen::MatrixXd& b) { return b; };  // all nodes may touch
  auto factors = std::make_shared<Factors>();
  prepare(*factors);
  factors->compute(K);
  if (factors->info() != Eigen::Success)
    throw Error("the stiffness of the nodes off the contact is singular");
  return [factors](const Eigen::MatrixXd& b) -> Eigen::MatrixXd { return factors->solve(b); };
}

/// Values at some places of nodal values.
template <int dim>
Eigen::VectorXd taken(const NodalField<dim>& from, const std::vector<std::pair<int, int>>& places) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = from(places[k].first, places[k].second);
  return values;
}

template <int dim>
void put(const Eigen::VectorXd& values, const std::vector<std::pair<int, int>>& places,
         NodalField<dim>& to) {
  for (std::size_t k = 0; k < places.size(); ++k)
    to(places[k].first, places[k].second) = values[static_cast<Eigen::Index>(k)];
}

}  // namespace

template <int dim>
Condensation<dim>::Condensation(const AssemblyParts<dim>& parts, const std::vector<int>& nodes)
    : nodes_(nodes) {
  if (const std::string reason = varying_stiffness(parts); !reason.empty())
    throw InputError("solver.reduce: expected " + reason);
  use_blas_threads(1);
  K_ = stiffness_of(parts);
  number(parts);
  K_ii_ = part_of<dim>(K_, inner_, inner_);
  K_ci_ = part_of<dim>(K_, kept_, inner_);
  solve_inner_ = is_symmetric(K_ii_) ? solver_of<Eigen::CholmodSupernodalLLT<Sparse>>(K_ii_)
                                     : solver_of<Eigen::UmfPackLU<Sparse>>(K_ii_);
  for (CondensedPart& part : parts_) condense_stiffness(part);
  add_loads(parts);
}

template <int dim>
void Condensation<dim>::number(const AssemblyParts<dim>& parts) {
  std::vector<char> touches(parts.mesh.nodes.size(), 0);
  for (const int node : nodes_) touches[static_cast<std::size_t>(node)] = 1;
  left_out_ = NodalFlags<dim>::Ones(parts.supports.held.rows(), dim);
  const std::vector<int> connected = connected_parts(parts.mesh);
  std::map<int, CondensedPart> of;  // by number of the connected part
  for (int node = 0; node < static_cast<int>(touches.size()); ++node)
    for (int i = 0; i < dim; ++i) {
      if (parts.supports.held(node, i)) continue;
      const bool keeps = touches[static_cast<std::size_t>(node)];
      (keeps ? kept_ : inner_).emplace_back(node, i);
      if (keeps) of[connected[static_cast<std::size_t>(node)]].kept.emplace_back(node, i);
      left_out_(node, i) = !keeps;
    }
  for (auto& [number, part] : of) parts_.push_back(std::move(part));
}

template <int dim>
void Condensation<dim>::condense_stiffness(CondensedPart& part) const {
  constexpr Eigen::Index at_once = 32;  // columns of inner displacements, which are long
  part.stiffness = part_of<dim>(K_, part.kept, part.kept);
  const Sparse columns = part_of<dim>(K_, inner_, part.kept),
               rows = part_of<dim>(K_, part.kept, inner_);
  for (Eigen::Index first = 0; first < columns.cols(); first += at_once) {
    const Eigen::Index count = std::min(at_once, columns.cols() - first);
    part.stiffness.middleCols(first, count) -=
        rows * solve_inner_(Eigen::MatrixXd(columns.middleCols(first, count)));
  }
}

template <int dim>
void Condensation<dim>::add_loads(const AssemblyParts<dim>& parts) {
  for (const auto* loads : {&parts.loads, &parts.swinging_loads})
    for (const Load<dim>& load : *loads)
      loads_.push_back(
          {load.forces, load.history, load.presses,
           [swing = load.swing](const Phase<dim>& phase) { return phase.load_factor(swing); }});
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    loads_.push_back({pull_of(springs, parts), springs.history});
  condensed_ = loads_;
  for (DeadForces<dim>& load : condensed_) load.forces = condensed(load.forces);
  for (const PrescribedValues& moved : parts.supports.moved) {
    NodalField<dim> u = NodalField<dim>::Zero(left_out_.rows(), dim);
    for (const auto& entry : moved.entries) u(entry.entity, entry.component) = entry.value;
    condensed_.push_back({condensed(-resistance(u)), moved.history});
  }
}

template <int dim>
NodalField<dim> Condensation<dim>::condensed(const NodalField<dim>& forces) const {
  NodalField<dim> result = NodalField<dim>::Zero(forces.rows(), dim);
  put<dim>(taken<dim>(forces, kept_) - K_ci_ * solve_inner_(taken<dim>(forces, inner_)), kept_,
           result);
  return result;
}

template <int dim>
NodalField<dim> Condensation<dim>::resistance(const NodalField<dim>& u) const {
  const Eigen::Map<const Eigen::VectorXd> all(u.data(), u.size());
  NodalField<dim> forces(u.rows(), dim);
  Eigen::Map<Eigen::VectorXd>(forces.data(), forces.size()) = K_ * all;
  return forces;
}

template <int dim>
NodalField<dim> Condensation<dim>::whole(const NodalField<dim>& u, double t,
                                         const Phase<dim>& phase) const {
  NodalField<dim> all = u;
  put<dim>(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(inner_.size())), inner_, all);
  NodalField<dim> forces = -resistance(all);
  for (const DeadForces<dim>& load : loads_)
    forces += load.factor(phase) * load.history.factor(t) * load.forces;
  put<dim>(solve_inner_(taken<dim>(forces, inner_)), inner_, all);
  return all;
}

template std::string varying_stiffness(const AssemblyParts<2>&);
template std::string varying_stiffness(const AssemblyParts<3>&);
template class Condensation<2>;
template class Condensation<3>;

}  // namespace gnomon

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/system/wear_system.hpp>

namespace gnomon {

template <int dim>
WearSystem<dim>::WearSystem(std::shared_ptr<const WornBody<dim>> body, const Selection& selection)
    : body_(std::move(body)),
      selection_(selection),
      unknowns_(*body_, selection),
      solid_(body_->mesh, body_->material, body_->element, unknowns_.u(), unknowns_.u(),
             &unknowns_.d()),
      mesh_motion_(*body_, unknowns_),
      contact_(*body_, unknowns_),
      state_(NodalState<dim>::zero(*body_)) {
  build_structure();
}

namespace {

/// The problem's scales, raised to where rounding of positions and stresses ends what can be
/// solved: a small load, a short run or a stiff body would otherwise ask for less.
template <int dim>
Scales above_rounding(const WornBody<dim>& body) {
  Vector<dim> low = body.mesh.nodes.front(), high = low;
  for (const Vector<dim>& X : body.mesh.nodes) low = low.cwiseMin(X), high = high.cwiseMax(X);
  const double length = 1e-6 * (high - low).maxCoeff();
  const double area = std::pow((high - low).maxCoeff(), dim - 1);
  const double stiffness =
      1e-7 * (body.material.moduli.lambda + 2 * body.material.moduli.mu) * area;
  Scales scales = body.scales;
  scales.displacement = std::max(scales.displacement, length);
  scales.force = std::max(scales.force, stiffness);
  if (scales.wear_depth < length) scales.auxiliary_force *= length / scales.wear_depth;
  return scales;
}

}  // namespace

template <int dim>
void WearSystem<dim>::build_structure() {
  PatternBuilder builder(unknowns_.size());
  solid_.add_to_pattern(builder);
  mesh_motion_.add_to_pattern(builder);
  contact_.add_to_pattern(builder);
  structure_.size = unknowns_.size();
  structure_.pattern = builder.build();
  solid_.map_to(structure_.pattern);
  mesh_motion_.map_to(structure_.pattern);
  contact_.map_to(structure_.pattern);
  structure_.group = unknowns_.node();
  structure_.solver = body_->solver;
  structure_.corners = body_->load_history.times();
  for (const auto& patch : body_->contact_nodes) structure_.switch_node.push_back(patch.node);

  const Scales s = above_rounding(*body_);
  label_blocks();
  structure_.differential.assign(structure_.size, 0);
  structure_.row_scale.assign(structure_.size, s.auxiliary_force);
  structure_.unknown_scale.assign(structure_.size, s.wear_depth);
  const auto set = [this](int number, double row, double unknown) {
    if (number < 0) return;
    structure_.row_scale[number] = row;
    structure_.unknown_scale[number] = unknown;
  };
  for (int number : unknowns_.u().reshaped()) set(number, s.force, s.displacement);
  for (int number : unknowns_.lambda()) set(number, s.displacement, s.stress);
  set(unknowns_.w(), s.force, s.displacement);
  for (std::size_t c = 0; c < body_->contact_nodes.size(); ++c) {
    const ContactPatch<dim>& patch = body_->contact_nodes[c];
    for (int i = 0; i < dim; ++i) {
      set(unknowns_.mu()(c, i), s.auxiliary_force, s.auxiliary_force / patch.initial_area);
      const int number = unknowns_.d()(patch.node, i);
      set(number, s.wear_depth / s.duration, s.wear_depth);
      if (number >= 0) structure_.differential[number] = 1;
    }
  }
}

/// Kind, component and place of every unknown, for solvers by blocks.
template <int dim>
void WearSystem<dim>::label_blocks() {
  structure_.kind.resize(structure_.size);
  structure_.component.assign(structure_.size, 0);
  const auto label = [this](const auto& numbers, UnknownKind kind) {
    for (Eigen::Index row = 0; row < numbers.rows(); ++row)
      for (Eigen::Index i = 0; i < numbers.cols(); ++i) {
        if (numbers(row, i) < 0) continue;
        structure_.kind[numbers(row, i)] = kind;
        structure_.component[numbers(row, i)] = static_cast<char>(i);
      }
  };
  label(unknowns_.u(), UnknownKind::displacement);
  label(unknowns_.d(), UnknownKind::shape);
  label(unknowns_.lambda(), UnknownKind::contact_multiplier);
  label(unknowns_.mu(), UnknownKind::shape_multiplier);
  for (const auto& patch : body_->contact_nodes)
    for (int i = 0; i < dim; ++i)
      if (const int number = unknowns_.d()(patch.node, i); number >= 0)
        structure_.kind[number] = UnknownKind::worn_surface;
  if (unknowns_.w() >= 0) structure_.kind[unknowns_.w()] = UnknownKind::rigid_motion;
  structure_.position.assign(body_->mesh.nodes.size() + 1, {});  // the last: of w, nowhere
  for (std::size_t node = 0; node < body_->mesh.nodes.size(); ++node)
    std::copy_n(body_->mesh.nodes[node].begin(), dim, structure_.position[node].begin());
}

template <int dim>
const NodalState<dim>& WearSystem<dim>::nodal(std::span<const double> y) const {
  unknowns_.scatter(y, state_);
  return state_;
}

/// Throws where the load is continued past its corner to where it would pull.
template <int dim>
double WearSystem<dim>::load_factor(const Point& at) const {
  if (load_factor_) return *load_factor_;
  const double factor = body_->load_history.factor(at.t, at.within.value_or(at.t));
  if (factor <= 0) throw RecoverableError("no load is left at a stage past the end of the step");
  return factor;
}

template <int dim>
void WearSystem<dim>::residual(const Point& at, std::span<double> F) const {
  const NodalState<dim>& state = nodal(at.y);
  std::fill(F.begin(), F.end(), 0.0);
  if (selection_.deformation) {
    const double factor = load_factor(at);
    solid_.add_residual(&state.d, state.u, F);
    for (Eigen::Index k = 0; k < unknowns_.u().size(); ++k)
      if (const int row = unknowns_.u().data()[k]; row >= 0)
        F[row] -= factor * body_->load.data()[k];
    if (const int row = unknowns_.w(); row >= 0) F[row] -= factor * *body_->counter_force;
  }
  if (selection_.interior_shape) mesh_motion_.add_residual(state.d, F);
  contact_.add_residual(state, at.ydot, at.piece, F);
}

template <int dim>
void WearSystem<dim>::jacobian(const Point& at, double alpha, std::span<double> values) const {
  const NodalState<dim>& state = nodal(at.y);
  std::fill(values.begin(), values.end(), 0.0);
  if (selection_.deformation) solid_.add_jacobian(&state.d, state.u, values);
  if (selection_.interior_shape) mesh_motion_.add_jacobian(state.d, values);
  contact_.add_jacobian(state, alpha, at.piece, values);
}

template <int dim>
void WearSystem<dim>::switching(std::span<const double> y, std::span<double> values) const {
  const NodalState<dim>& state = nodal(y);
  const CounterBody<dim>& counter_body = body_->contact.counter_body;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const int node = body_->contact_nodes[c].node;
    const Vector<dim> x =
        body_->mesh.nodes[node] + (state.d.row(node) + state.u.row(node)).transpose();
    values[c] = state.lambda[static_cast<Eigen::Index>(c)] +
                body_->contact.rho *
                    counter_body.template project<double>(x - state.w * counter_body.approach).gap;
  }
}

template <int dim>
std::vector<Stage> WearSystem<dim>::make_stages() const {
  const auto make = [this](const Selection& selection) {
    auto part = std::make_unique<WearSystem<dim>>(body_, selection);
    Stage stage;
    stage.unknowns.resize(part->structure().size);
    const auto match = [&stage](const auto& mine, const auto& theirs) {
      for (Eigen::Index k = 0; k < mine.size(); ++k)
        if (mine.data()[k] >= 0) stage.unknowns[mine.data()[k]] = theirs.data()[k];
    };
    match(part->unknowns_.u(), unknowns_.u());
    match(part->unknowns_.d(), unknowns_.d());
    match(part->unknowns_.lambda(), unknowns_.lambda());
    match(part->unknowns_.mu(), unknowns_.mu());
    if (part->unknowns_.w() >= 0) stage.unknowns[part->unknowns_.w()] = unknowns_.w();
    stage.freeze = [this, part = part.get()](double t, std::span<const double> y) {
      part->freeze(nodal(y));
      part->set_load_factor(body_->load_history.factor(t));
    };
    stage.system = std::move(part);
    return stage;
  };
  std::vector<Stage> stages;
  stages.push_back(make({.deformation = false, .interior_shape = true, .contact_shape = false}));
  stages.push_back(make({.deformation = true, .interior_shape = false, .contact_shape = false}));
  return stages;
}

template class WearSystem<2>;
template class WearSystem<3>;

}  // namespace gnomon

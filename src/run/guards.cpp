#include "run/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/stability/stability.hpp>
#include <gnomon/terms/solid.hpp>
#include <optional>

namespace gnomon {

namespace {

/// The fastest mode, if the spectrum can be computed and the mode decays.
std::optional<Mode> fastest_mode(const Model& model, const State& state) try {
  constexpr int count = 1;
  auto modes = leading_modes(ReducedJacobian(model.system(), state), count);
  if (modes.empty() || modes.front().eigenvalue.real() >= 0) return std::nullopt;
  return std::move(modes.front());
} catch (const SolutionError&) {
  return std::nullopt;
}

}  // namespace

bool may_fail_to_damp(const Integrator& integrator, const IntegratorSettings& settings) {
  // Practically R at infinity. A mode that loses a tenth or more per step has vanished after about
  // fifty steps; of the methods that count as damping, sdirk-2 damps least and halves it.
  constexpr double stiff = -1e8, damps = 0.9;
  if (settings.step == 0) return false;  // the error control keeps to damped steps
  const auto table = integrator.table(settings);
  return table && !(std::abs(stability_function(*table, stiff)) < damps);
}

DampingWatch::DampingWatch(const Model& model, const Integrator& integrator,
                           const IntegratorSettings& settings)
    : model_(model), integrator_(integrator), settings_(settings) {}

void DampingWatch::require_damping_in_wider_contact(const State& state,
                                                    const Observation& observed) {
  // Ratio of numbers of nodes. Contact that widens tenfold is checked a dozen times, and each check
  // costs one or more factorizations.
  constexpr double wider = 1.2;
  const double width = value_of(observed, "contact_nodes").value_or(0);
  if (width <= wider * widest_) return;
  widest_ = width;
  require_damping(state);
}

void DampingWatch::require_damping(const State& state) {
  // A mode that should have decayed to a tenth by the end of the run must not double in one step,
  // and less than half of it must be left at the end. Acceptable runs are far from both limits,
  // which are wide because the mode is that of a single state and the modes change.
  constexpr double most_per_step = 2, most_left = 0.5, decayed = 0.1;
  const auto mode = fastest_mode(model_, state);
  seen_ |= mode.has_value();
  if (!mode || std::exp(mode->eigenvalue.real() * settings_.end) > decayed) return;
  const ButcherTable table = *integrator_.table(settings_);
  const double per_step = std::abs(stability_function(table, settings_.step * mode->eigenvalue));
  const double steps = std::max(1.0, settings_.end / settings_.step);
  if (per_step <= most_per_step && steps * std::log(per_step) <= std::log(most_left)) return;
  const double critical = critical_step(table, {&*mode, 1}).step;
  throw SolutionError(
      critical < settings_.step
          ? fmt::format("steps of {:g} s exceed the critical one of {} at t = {:g} s, {:.3g} s "
                        "(gnomon stability)",
                        settings_.step, integrator_.name, state.t, critical)
          : fmt::format("steps of {:g} s are too long for {} at t = {:g} s: {:.2g} of the fastest "
                        "mode, {:.2g} /s, would be left (gnomon stability)",
                        settings_.step, integrator_.name, state.t, std::pow(per_step, steps),
                        mode->eigenvalue.real()));
}

void require_no_chattering(long chattering_nodes, const Integrator& integrator) {
  if (chattering_nodes > 0)
    throw SolutionError(
        fmt::format("{} contact nodes left contact twice or more: steps exceed the critical one of "
                    "{} (gnomon stability)",
                    chattering_nodes, integrator.name));
}

namespace {
/// Steps of multistep methods may need no iteration.
long work_of(const Counters& counters) {
  return counters.newton_iterations + counters.steps;
}
}  // namespace

ProgressWatch::ProgressWatch(double t, const Counters& counters, double end)
    : t_(t), work_(work_of(counters)), end_(end) {}

void ProgressWatch::require(double t, const Counters& counters) {
  constexpr double least_progress = 1e-5;  // part of the length of the run
  const long work = work_of(counters) - work_;
  if (work < most_newton_iterations) return;
  if (t - t_ < least_progress * end_)
    throw SolutionError(
        fmt::format("lack of progress: the last {} Newton iterations and steps "
                    "went from t = {:.9g} s to {:.9g} s",
                    work, t_, t));
  *this = ProgressWatch(t, counters, end_);
}

namespace {
/// Losses of contact between two breakpoints. One loss is regular, for example while the load
/// falls. Before a second loss a node must have come into contact again.
constexpr int too_many = 2;
}  // namespace

void Chattering::add(const std::optional<ContactSurface>& surface) {
  if (!surface) return;
  if (!active_.empty() && active_.size() != surface->active.size())
    throw InputError("the checkpoint does not belong to this scene");
  losses_.resize(surface->active.size());
  for (std::size_t c = 0; c < active_.size(); ++c) losses_[c] += active_[c] && !surface->active[c];
  active_.assign(surface->active.begin(), surface->active.end());
}

void Chattering::begin_anew() {
  for (int& losses : losses_)
    if (losses < too_many) losses = 0;
}

long Chattering::nodes() const {
  return std::count_if(losses_.begin(), losses_.end(),
                       [](int losses) { return losses >= too_many; });
}

void Chattering::pack_into(std::vector<double>& numbers) const {
  pack(numbers, double(active_.size()));
  pack(numbers, active_);
  pack(numbers, losses_);
}

void Chattering::unpack_from(Unpacker& numbers) {
  const double count = numbers.one();
  if (!(count >= 0 && count <= static_cast<double>(numbers.rest().size())))
    throw InputError("the checkpoint does not belong to this scene");
  const auto nodes = static_cast<std::size_t>(count);
  active_ = numbers.many<char>(nodes);
  losses_ = numbers.many<int>(nodes);
}

JumpLedger::JumpLedger(const System& system, const IntegratorSettings& settings)
    : system_(system), passes_over_(settings.step > 0 && !settings.locate_events) {
  const std::vector<char>& may_jump = system.structure().switch_jumps;
  for (std::size_t j = 0; j < may_jump.size(); ++j)
    if (may_jump[j]) jumps_.push_back(j);
  turns_.resize(jumps_.size());
}

void JumpLedger::add(const State& before, const State& after) {
  // A node that slides crosses every few steps: of an explicit method once on the side that wears
  // fast, and then some times on the other. What a load drives to and fro begins anew where it
  // turns.
  constexpr int crossing = 3, many = 20;
  if (jumps_.empty()) return;
  const CrossedJumps crossed = jumps_between(system_, before, after, passes_over_);
  for (const std::size_t j : jumps_) largest_ = std::max(largest_, std::abs(crossed.before[j]));
  error_.resize(after.y.size());
  for (std::size_t i = 0; i < crossed.by.size(); ++i)
    error_[i] += (after.t - before.t) * std::abs(crossed.by[i]);
  if (is_breakpoint(system_.structure(), after.t)) std::ranges::fill(turns_, 0);
  for (std::size_t k = 0; k < jumps_.size(); ++k) {
    const bool here = std::ranges::count(crossed.functions, jumps_[k]) > 0;
    turns_[k] = here ? turns_[k] + crossing : std::max(0, turns_[k] - 1);
    if (turns_[k] < many) continue;
    if (!is_jump(before, after))
      turns_[k] = 0;
    else
      throw SolutionError(fmt::format(
          "the wear law jumps, and node {} slides along the jump at t = {:.6g} s: the rates on "
          "either side drive it back, and between them there is no solution; a ramp instead of the "
          "jump has one",
          system_.structure().switch_node[jumps_[k]], after.t));
  }
}

/// `if(p > p0, p - p0, 0)` does not.
bool JumpLedger::is_jump(const State& before, const State& after) const {
  constexpr double clear = 1e-3;  // of the largest rate
  double rate = 0;
  for (std::size_t i = 0; i < after.ydot.size(); ++i)
    if (system_.structure().differential[i]) rate = std::max(rate, std::abs(after.ydot[i]));
  return common_jump(system_, before, after) > clear * rate;
}

std::string JumpLedger::warning(const State& last) const {
  constexpr double right = 1e-3;
  double depth = 0, error = 0;
  for (std::size_t i = 0; i < error_.size(); ++i) {
    if (!system_.structure().differential[i]) continue;
    depth = std::max(depth, std::abs(last.y[i]));
    error = std::max(error, error_[i]);
  }
  if (!(error > right * depth)) return {};
  return fmt::format(
      "the wear law jumps within fixed steps: the wear depth has an error of up to {:.2g} mm by "
      "this, {:.2g} % of the largest depth",
      error, 100 * error / depth);
}

std::string JumpLedger::suspicion(const State& last) const {
  constexpr double there = 1e-5;
  if (jumps_.empty() || last.y.empty()) return {};
  std::vector<double> values(system_.structure().switch_node.size());
  system_.switching({.t = last.t, .y = last.y}, values);
  for (const std::size_t j : jumps_)
    if (std::abs(values[j]) <= there * largest_)
      return fmt::format(
          "; the wear law jumps at node {} there, and an implicit step that ends near the jump may "
          "have no solution: with a ramp instead of the jump it has one, and explicit methods pass "
          "a jump unless the rates on either side drive the node back to it",
          system_.structure().switch_node[j]);
  return {};
}

namespace {
constexpr double sound = 1;  // volume and quality where a model has no mesh
constexpr double nearly_folded = 0.1;

template <int dim>
double least_quality(const Grid& grid) {
  constexpr int corners = Mesh<dim>::cell_nodes;
  double least = sound;
  for (std::size_t first = 0; first + corners <= grid.cells.size(); first += corners) {
    CellNodal<dim> X;
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < dim; ++i) X(a, i) = grid.points[grid.cells[first + a]][i];
    least = std::min(least, scaled_jacobian<dim>(X));
  }
  return least;
}

std::string folding_text(double quality, double initial) {
  if (initial >= nearly_folded)
    return fmt::format(
        "an element of the worn mesh is nearly folded: its scaled Jacobian is {:.2g}", quality);
  if (quality < initial / 2)
    return fmt::format(
        "an element of the worn mesh is nearly folded: its scaled Jacobian is {:.2g}, that of the "
        "mesh was {:.2g} from the start",
        quality, initial);
  return fmt::format(
      "an element of the mesh is nearly folded, as it was from the start: its scaled Jacobian is "
      "{:.2g}, and was {:.2g} before any wear",
      quality, initial);
}
}  // namespace

double initial_quality(const std::optional<Grid>& grid) {
  if (!grid) return sound;
  return grid->cell == Grid::Cell::quadrilateral ? least_quality<2>(*grid)
                                                 : least_quality<3>(*grid);
}

void require_sound_mesh(const Observation& observed) {
  const double volume = value_of(observed, "element_volume").value_or(sound);
  const double quality = value_of(observed, "element_quality").value_or(sound);
  if (value_of(observed, "thickness_left").value_or(sound) <= 0)
    throw SolutionError("a body is worn through: wear has taken all its thickness at a node");
  // With such an element steps would become ever shorter without an end.
  if (volume < 0.01)
    throw SolutionError(fmt::format(
        "an element is worn down to {:.2g} of its volume: the body is worn away, or its mesh too "
        "flat for that depth",
        volume));
  if (quality <= 0)
    throw SolutionError(fmt::format(
        "an element of the worn mesh is folded: its scaled Jacobian is {:.2g}", quality));
}

std::vector<MeshWarning> mesh_warnings(const Observation& observed, double initial) {
  const double volume = value_of(observed, "element_volume").value_or(sound);
  const double quality = value_of(observed, "element_quality").value_or(sound);
  std::vector<MeshWarning> warnings;
  if (volume < 0.1)
    warnings.push_back(
        {"wear",
         fmt::format("an element is worn down to {:.2g} of its volume; at 0.01 the run ends",
                     volume)});
  else if (quality < nearly_folded)
    warnings.push_back({initial < nearly_folded && quality >= initial / 2 ? "mesh" : "wear",
                        folding_text(quality, initial)});
  if (const double left = value_of(observed, "thickness_left").value_or(sound); left < 0.1)
    warnings.push_back(
        {"thickness",
         fmt::format("a body is worn down to {:.2g} of its thickness; at 0 the run ends", left)});
  const double gradient = value_of(observed, "displacement_gradient").value_or(0);
  if (gradient > 0.5)
    warnings.push_back(
        {"strain",
         fmt::format("displacements have gradients up to {:.2g}, for which body.material = "
                     "\"linear\" is not meant: the result is worthless",
                     gradient)});
  return warnings;
}

}  // namespace gnomon

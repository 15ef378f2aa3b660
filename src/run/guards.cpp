#include "run/guards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
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
                    "{}, or nearly so (gnomon stability)",
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

std::string worn_away_text(double volume) {
  return fmt::format(
      "an element is worn down to {:.2g} of its volume: the body is worn away, or its mesh too "
      "flat for that depth",
      volume);
}

void require_sound_mesh(const Observation& observed) {
  const double volume = value_of(observed, "element_volume").value_or(sound);
  const double quality = value_of(observed, "element_quality").value_or(sound);
  if (value_of(observed, "thickness_left").value_or(sound) <= 0)
    throw SolutionError("a body is worn through: wear has taken all its thickness at a node");
  if (volume < least_element_volume) throw SolutionError(worn_away_text(volume));
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
         fmt::format("an element is worn down to {:.2g} of its volume; at {:g} the run ends",
                     volume, least_element_volume)});
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

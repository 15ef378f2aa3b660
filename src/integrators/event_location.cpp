#include <algorithm>
#include <cmath>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/system/system.hpp>
#include <utility>

namespace gnomon {

namespace {

bool active(double value) {
  return value <= 0;
}

/// Zero in [low, high] of the polynomial through (h, f), by bisection; it changes sign there. After
/// sixty halvings only rounding errors are left.
double polynomial_root(const std::vector<double>& h, std::vector<double> f, double low,
                       double high) {
  const std::size_t n = h.size();
  for (std::size_t k = 1; k < n; ++k)  // divided differences
    for (std::size_t i = n - 1; i >= k; --i) f[i] = (f[i] - f[i - 1]) / (h[i] - h[i - k]);
  const auto value = [&](double x) {
    double sum = f[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) sum = sum * (x - h[i]) + f[i];
    return sum;
  };
  const bool at_low = active(value(low));
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (low + high) / 2;
    (active(value(middle)) == at_low ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// A point between low and high, for a zero at an unknown scale: while both differ much, the
/// geometric mean halves the number of uncertain digits. If low is zero, it is a sixteenth of high.
double middle(double low, double high) {
  if (low == 0) return high / 16;
  return high > 4 * low ? std::sqrt(low * high) : (low + high) / 2;
}

}  // namespace

EventLocator::EventLocator(const System& system, OneStepMethod& method)
    : system_(system),
      method_(method),
      branch_(system.structure().switch_node.size()),
      crossed_(branch_.size()) {}

std::vector<double> EventLocator::memory() const {
  std::vector<double> memory = {crossed_at_};
  pack(memory, branch_);
  pack(memory, crossed_);
  return memory;
}

void EventLocator::restore(Unpacker& memory) {
  const std::size_t nodes = branch_.size();
  crossed_at_ = memory.one();
  branch_ = memory.many<char>(nodes);
  crossed_ = memory.many<char>(nodes);
}

void EventLocator::sample(double h, const State& at) {
  Sample sample{h, std::vector<double>(branch_.size())};
  system_.switching({.t = at.t, .y = at.y, .ydot = at.ydot}, sample.values);
  const auto place = std::lower_bound(samples_.begin(), samples_.end(), h,
                                      [](const Sample& s, double x) { return s.h < x; });
  samples_.insert(place, std::move(sample));
}

const EventLocator::Sample& EventLocator::at(double h) const {
  return *std::find_if(samples_.begin(), samples_.end(), [h](const Sample& s) { return s.h == h; });
}

bool EventLocator::off_branch(const Sample& sample) const {
  for (std::size_t j = 0; j < branch_.size(); ++j)
    if (active(sample.values[j]) != bool(branch_[j])) return true;
  return false;
}

bool EventLocator::starts_off_branch(const State& from) const {
  const bool at_event = from.t == crossed_at_;
  for (std::size_t j = 0; j < branch_.size(); ++j)
    if (!(at_event && crossed_[j]) && active(at(0).values[j]) != bool(branch_[j])) return true;
  return false;
}

/// Switches the nodes that are off the branch at `behind`, shortly after the start or at the start;
/// each node at most once at one time, because rounding determines its sign there.
Landing EventLocator::switch_at_start(const State& from, const Sample& behind) {
  if (from.t != crossed_at_) crossed_.assign(branch_.size(), 0);
  crossed_at_ = from.t;
  Landing landing{.at_start = true};
  for (std::size_t j = 0; j < branch_.size(); ++j) {
    if (crossed_[j] || active(behind.values[j]) == bool(branch_[j])) continue;
    branch_[j] = !branch_[j];
    crossed_[j] = 1;
    ++landing.switched;
  }
  return landing;
}

/// From the dense output of the step that left the branch, the time at which it first leaves it.
/// The dense output is a cubic, so that a crossing and a return within one of 32 parts are missed
/// only if it hardly leaves the branch; the attempts that follow do not rely on it. Half the step
/// if there is no crossing.
double EventLocator::first_guess(const State& from, double h) const {
  constexpr int parts = 32;
  constexpr double none = 2;  // a part ends at 1
  std::vector<double> y(from.y.size()), before(branch_.size()), after = at(0).values;
  for (int k = 1; k <= parts; ++k) {
    std::swap(before, after);
    method_.interpolate(from.t + h * k / parts, y);
    system_.switching({.t = from.t + h * k / parts, .y = y}, after);
    double first = none;
    for (std::size_t j = 0; j < branch_.size(); ++j)
      if (active(before[j]) == bool(branch_[j]) && active(after[j]) != bool(branch_[j]))
        first = std::min(first, before[j] / (before[j] - after[j]));
    if (first < none) return h * (k - 1 + first) / parts;
  }
  return h / 2;
}

/// Both ends and the two samples nearest to one of them, for a cubic: the convergence of its zeros
/// is superlinear, and a cubic is what a step between two events looks like.
std::vector<const EventLocator::Sample*> EventLocator::samples_near(double end, double low,
                                                                    double high) const {
  std::vector<const Sample*> nodes;
  for (const Sample& s : samples_) nodes.push_back(&s);
  std::sort(nodes.begin(), nodes.end(), [&](const Sample* a, const Sample* b) {
    return std::abs(a->h - end) < std::abs(b->h - end);
  });
  const auto is_end = [&](const Sample* s) { return s->h == low || s->h == high; };
  std::stable_partition(nodes.begin(), nodes.end(), is_end);
  constexpr std::size_t cubic = 4;
  if (nodes.size() > cubic) nodes.resize(cubic);
  return nodes;
}

/// First zero of a switching function between two samples next to each other, the first on the
/// branch. Known weakness: a node that has switched at the start, and is off the branch again both
/// there and at `high`, has no zero here, so the search ends at `high` and switches it back.
double EventLocator::earliest_root(double low, double high) const {
  const std::vector<const Sample*> near[] = {samples_near(low, low, high),
                                             samples_near(high, low, high)};
  const std::size_t count = near[0].size();
  double earliest = high;
  std::vector<double> h(count), f(count);
  for (std::size_t j = 0; j < branch_.size(); ++j) {
    const double first = at(low).values[j], last = at(high).values[j];
    if (active(last) == bool(branch_[j]) || active(first) != bool(branch_[j])) continue;
    const auto& nodes = near[std::abs(last) < std::abs(first)];  // those near the expected zero
    for (std::size_t k = 0; k < count; ++k) h[k] = nodes[k]->h, f[k] = nodes[k]->values[j];
    earliest = std::min(earliest, polynomial_root(h, f, low, high));
  }
  return earliest;
}

/// Switches every node whose own event is within `width` of h.
int EventLocator::switch_at(double h, double width) {
  const auto here =
      std::find_if(samples_.begin(), samples_.end(), [h](const Sample& s) { return s.h == h; });
  const auto there = here != samples_.begin() ? here - 1 : here + 1;
  int switched = 0;
  crossed_.assign(branch_.size(), 0);
  for (std::size_t j = 0; j < branch_.size(); ++j) {
    const double value = here->values[j];
    const double slope = (value - there->values[j]) / (here->h - there->h);
    const bool off = active(value) != bool(branch_[j]);
    const bool leaving = branch_[j] ? slope > 0 : slope < 0;
    if (!off && !(leaving && std::abs(value) <= std::abs(slope) * width)) continue;
    branch_[j] = !branch_[j];
    crossed_[j] = 1;
    ++switched;
  }
  return switched;
}

// The event is kept between `low`, on the branch, and `high`, off it. Every attempt ends at the
// earliest zero that interpolation predicts, and replaces one of the two.
Landing EventLocator::land(const State& from, double h, State& to) {
  // Interpolation takes at most six attempts on a smooth path (the tests check this); if it fails,
  // every second attempt is a bisection, which halves the bracket eight times in sixteen attempts.
  constexpr int most_attempts = 16;
  // Part of the step. An event this near to the start is treated as an event at the start: the step
  // to it would be too short (shortest_remainder in stop_times.hpp).
  constexpr double moment = 1e-3;
  const double width = tolerance * h;
  // Nodes whose zeros are this near to the end switch at it: the end is within one width of the
  // first zero, and the zeros of symmetric nodes, which are located separately, may differ by one
  // width on either side.
  const double together = 3 * width;
  // Interpolation reaches the tolerance only with values that are as accurate.
  const AttemptOptions exact{.branch = &branch_};
  samples_.clear();
  sample(0, from);
  sample(h, to);
  if (starts_off_branch(from)) return switch_at_start(from, at(0));
  double low = 0, high = h, guess = first_guess(from, h), bracket = h;
  Landing landing;
  for (int k = 0;; ++k) {
    if (high <= moment * h) return switch_at_start(from, at(high));
    // Not at a sample: a step nearer to a sample than half the width gives no new information.
    landing.h = std::clamp(guess, low + width / 2, high - width / 2);
    landing.attempt = k < most_attempts ? method_.attempt(from, landing.h, exact, to)
                                        : Attempt{.reason = "an event in the step was not found"};
    if (!landing.attempt.success) return landing;
    sample(landing.h, to);
    (off_branch(at(landing.h)) ? high : low) = landing.h;
    guess = earliest_root(low, high);
    if (std::abs(guess - landing.h) <= width) break;
    const double before = std::exchange(bracket, high - low);
    if (bracket > before / 2 && k % 2 == 1) guess = middle(low, high);
  }
  landing.switched = switch_at(landing.h, together);
  crossed_at_ = to.t;
  return landing;
}

}  // namespace gnomon

#include "budget/companions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "budget/extrapolation.hpp"

namespace gnomon::budget {

namespace {

/// Adds the CPU time until it goes out of scope, however that comes.
class Stopwatch {
public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += seconds(); }
  double seconds() const { return cpu_seconds() - begin_; }

private:
  double& seconds_;
  double begin_ = cpu_seconds();
};

}  // namespace

std::vector<OtherMesh> other_meshes(const Scene& scene) {
  std::vector<OtherMesh> found;
  for (const double factor : {2.0, 0.5})
    for (const Key& key : scene.controlling_keys())
      if (key.controls->source == ErrorSource::mesh && key.controls->scaled(scene, factor))
        found.push_back({key, factor > 1});
  return found;
}

Trial Companions::run(const Scene& scene, const std::string& what, const Goals* unlike) {
  hooks_.on_run(what);
  const Stopwatch stopwatch(budget_.companion_seconds);
  const double before = work_;
  const auto interrupted = [&](double work) {
    work_ = before + work;
    return hooks_.interrupted() || work_ > hooks_.limit ||
           budget_.companion_seconds + stopwatch.seconds() > hooks_.seconds;
  };
  if (interrupted(0)) throw Interrupted("interrupted");
  return try_scene(scene, interrupted, unlike, hooks_.limit - before);
}

void Companions::add(const Key& key, const std::function<void(BudgetPart&)>& find) {
  BudgetPart part{.source = key.controls->source, .key = key.name, .how = {}, .errors = {}};
  try {
    find(part);
  } catch (const Interrupted&) {
    if (hooks_.interrupted()) throw;
    part.unknown = too_long;
  } catch (const Error& error) {
    part.unknown = error.what();
  }
  if (!part.unknown.empty()) part.errors.assign(budget_.values.size(), not_known);
  budget_.parts.push_back(std::move(part));
}

void Companions::add_given_phases(const Scene& scene) {
  for (const Key& key : scene.controlling_keys())
    if (key.controls->source == ErrorSource::phases && scene.given(key.name) &&
        !key.controls->scaled(scene, 0.5))
      add(key, [](BudgetPart&) { throw InputError("positions are given, or as many as can be"); });
}

void Companions::add_mesh(const Scene& scene, const Goals& goals,
                          const std::function<void(const OtherMesh&, BudgetPart&)>& find) {
  const std::vector<Key> keys = scene.controlling_keys();
  const auto own = std::ranges::find(keys, ErrorSource::mesh,
                                     [](const Key& key) { return key.controls->source; });
  if (own == keys.end()) return;
  add(*own, [&](BudgetPart& part) {
    std::string failure = "there is no mesh of other elements to compare with";
    for (const OtherMesh& mesh : other_meshes(scene)) {
      part.key = mesh.key.name;
      const auto failed = failure_of([&] { find(mesh, part); });
      if (!failed) return respect_area(goals, part.errors);
      failure = *failed;
    }
    throw InputError(failure);
  });
}

namespace {

/// The companion with half as many phases of a cycle. None where they would be so few that the
/// error of their mean does not fall with their square, and none of another key.
std::optional<Scene> half_of_phases(const Key& key, const Scene& scene) {
  if (key.controls->source != ErrorSource::phases || !key.controls->scaled(scene, 4)) return {};
  return key.controls->scaled(scene, 2);
}

}  // namespace

void Companions::compare(BudgetPart& part, const Trial& base, const Key& key) {
  const Finer finer(part.source);
  const std::optional<Scene> fewer = half_of_phases(key, base.scene);
  const std::optional<Scene> other = fewer ? fewer : key.controls->scaled(base.scene, finer.factor);
  if (!other) throw InputError("it cannot be finer on the mesh of the companions");
  part.how = change_text(base.scene, *other);
  part.errors = differences(base.goals, run(*other, part.how).goals);
  // The error of half as many phases is four times as large; odd numbers have no half.
  const double times = fewer && base.scene.given(key.name)
                           ? base.scene.reals(key.name).at(0) / fewer->reals(key.name).at(0)
                           : 2;
  const double scale = fewer ? 1 / (times * times - 1) : finer.part_of_coarser;
  for (double& error : part.errors) error = std::abs(error) * scale;
  forget_without_value(base.goals, budget_.values, part.errors, part.doubt);
}

void respect_ledger(Budget& budget, double ledger) {
  const auto place = std::ranges::find(budget.values, "worn_volume", &Scalar::name);
  const auto time = std::ranges::find(budget.parts, ErrorSource::time, &BudgetPart::source);
  if (place == budget.values.end() || time == budget.parts.end()) return;
  const auto i = static_cast<std::size_t>(place - budget.values.begin());
  const double missing = ledger - budget.total(i);
  if (std::isfinite(ledger) && missing > 0 && !std::isnan(time->errors[i]))
    time->errors[i] += missing;
}

}  // namespace gnomon::budget

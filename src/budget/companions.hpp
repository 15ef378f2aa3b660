// Runs that differ from another one in one thing, and the parts of a budget that follow.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/mesh/mesh_file.hpp>
#include <utility>

#include "budget/trial.hpp"

namespace gnomon::budget {

/// By how much a finer companion differs, and the part of the difference by which the coarser of
/// the two is wrong, if the error is proportional to the factor.
struct Finer {
  explicit Finer(ErrorSource source)
      : factor(source == ErrorSource::time || source == ErrorSource::solves ? 0.1 : 0.5),
        part_of_coarser(source == ErrorSource::model ? 1 : 1 / (1 - factor)) {}
  double factor, part_of_coarser;
};

/// A key by which a scene has another mesh, of larger elements, or of smaller ones only.
struct OtherMesh {
  Key key;
  bool is_coarser;
};

/// Those with larger elements first: runs on them cost less.
inline std::vector<OtherMesh> other_meshes(const Scene& scene) {
  std::vector<OtherMesh> found;
  for (const double factor : {2.0, 0.5})
    for (const Key& key : scene.controlling_keys())
      if (key.controls->source == ErrorSource::mesh && key.controls->scaled(scene, factor))
        found.push_back({key, factor > 1});
  return found;
}

class Companions {
public:
  Companions(Budget& budget, const BudgetHooks& hooks) : budget_(budget), hooks_(hooks) {}

  Trial run(const Scene& scene, const std::string& what, long unlike = 0) {
    hooks_.on_run(what);
    const double begin = cpu_seconds(), before = work_;
    const auto interrupted = [&](double work) {
      work_ = before + work;
      return hooks_.interrupted() || work_ > hooks_.limit;
    };
    Trial trial = try_scene(scene, interrupted, unlike);
    budget_.companion_seconds += cpu_seconds() - begin;
    return trial;
  }

  /// Adds a part that `find` fills in, or why it cannot.
  template <class Find>
  void add(const Key& key, Find find) {
    BudgetPart part{.source = key.controls->source, .key = key.name, .how = {}, .errors = {}};
    try {
      find(part);
    } catch (const Interrupted&) {
      if (hooks_.interrupted()) throw;
      part.unknown = "it takes longer than the run may be delayed by";
    } catch (const Error& error) {
      part.unknown = error.what();
    }
    if (!part.unknown.empty()) part.errors.assign(budget_.values.size(), not_known);
    budget_.parts.push_back(std::move(part));
  }

  /// The part of the mesh, by the first of other_meshes() with which `find` succeeds. None where
  /// no key of the scene controls it.
  template <class Find>
  void add_mesh(const Scene& scene, Find find) {
    const std::vector<Key> keys = scene.controlling_keys();
    const auto own = std::ranges::find(keys, ErrorSource::mesh,
                                       [](const Key& key) { return key.controls->source; });
    if (own == keys.end()) return;
    add(*own, [&](BudgetPart& part) {
      std::string failure;
      for (const OtherMesh& mesh : other_meshes(scene)) try {
          part.key = mesh.key.name;
          return find(mesh, part);
        } catch (const Interrupted&) {
          throw;
        } catch (const Error& error) {
          failure = error.what();
        }
      throw InputError(failure.empty() ? "there is no mesh of other elements to compare with"
                                       : failure);
    });
  }

  /// What `base` is wrong by, from a run of a scene in which the key of the part is finer.
  void compare(BudgetPart& part, const Trial& base, const Scene& finer) {
    part.how = change_text(base.scene, finer);
    part.errors = differences(base.goals, run(finer, part.how).goals);
    for (double& error : part.errors) error = std::abs(error) * Finer(part.source).part_of_coarser;
  }

private:
  Budget& budget_;
  const BudgetHooks& hooks_;
  KeptMeshes meshes_;
  double work_ = 0;
};

/// The estimates of worn_volume are at least what the ledger shows. Adds what is missing to the
/// error in time.
inline void respect_ledger(Budget& budget, double ledger) {
  const auto place = std::ranges::find(budget.values, "worn_volume", &Scalar::name);
  const auto time = std::ranges::find(budget.parts, ErrorSource::time, &BudgetPart::source);
  if (place == budget.values.end() || time == budget.parts.end()) return;
  const auto i = static_cast<std::size_t>(place - budget.values.begin());
  const double missing = ledger - budget.total(i);
  if (std::isfinite(ledger) && missing > 0 && !std::isnan(time->errors[i]))
    time->errors[i] += missing;
}

/// Of two meshes. Fields are compared at the nodes of the coarse one, to which a fine mesh is
/// interpolated with little error; the other way round where its contact has too few nodes.
inline std::vector<double> mesh_differences(const Goals& coarse, const Goals& fine) {
  std::vector<double> errors = differences(coarse, fine);
  if (std::ranges::none_of(errors, [](double error) { return std::isnan(error); })) return errors;
  const std::vector<double> other = differences(fine, coarse);
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (std::isnan(errors[i])) errors[i] = -other[i];
  return errors;
}

/// The error of the finer of two runs, and the observed order.
struct Extrapolated {
  double error, order;

  double of_coarser() const { return error * std::exp2(order); }
};

/// Richardson's extrapolation from elements of sizes h, 2h and 4h. `fine` and `coarse` are the
/// differences between neighbours; the second is not_known if there are only two. Where they do not
/// fall as an error of order 0.5 to 2 does, chance has a part in them (which node is the last
/// closed one), and the order is taken as 1.5: for 1 and 2 the estimate is then wrong by a factor
/// of 1.8. Differences that fall faster than with h^3 do so by chance.
inline Extrapolated extrapolated(double fine, double coarse) {
  constexpr double usual = 1.5, least = 0.5, most = 2;
  const double difference =
      std::isnan(coarse) ? std::abs(fine) : std::max(std::abs(fine), std::abs(coarse) / 8);
  const double observed = std::log2(coarse / fine);  // not a number where the signs differ
  const double order = observed >= least && observed <= most ? observed : usual;
  return {difference / (std::exp2(order) - 1), order};
}

}  // namespace gnomon::budget

// Runs that differ from another one in one thing, and the parts of a budget that follow.
#pragma once

#include <cmath>
#include <utility>

#include "budget/trial.hpp"

namespace gnomon::budget {

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

private:
  Budget& budget_;
  const BudgetHooks& hooks_;
  double work_ = 0;
};

inline const std::string given_mesh =
    "the mesh is given, and no geometry from which to make another";

/// By how much a finer companion differs, and the part of the difference by which the coarser of
/// the two is wrong, if the error is proportional to the factor.
struct Finer {
  explicit Finer(ErrorSource source)
      : factor(source == ErrorSource::time || source == ErrorSource::solves ? 0.1 : 0.5),
        part_of_coarser(source == ErrorSource::model ? 1 : 1 / (1 - factor)) {}
  double factor, part_of_coarser;
};

}  // namespace gnomon::budget

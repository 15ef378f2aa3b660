// Runs that differ from another one in one thing, and the parts of a budget that follow.
#pragma once

#include <gnomon/mesh/mesh_file.hpp>

#include "budget/trial.hpp"

namespace gnomon::budget {

/// By how much a finer companion differs, and the part of the difference by which the coarser of
/// the two is wrong: the error is proportional to the factor, of phases to its square.
struct Finer {
  explicit Finer(ErrorSource source)
      : factor(source == ErrorSource::time || source == ErrorSource::solves ? 0.1 : 0.5),
        part_of_coarser(source == ErrorSource::model    ? 1
                        : source == ErrorSource::phases ? 1 / (1 - factor * factor)
                                                        : 1 / (1 - factor)) {}
  double factor, part_of_coarser;
};

/// A key by which a scene has another mesh, and whether its elements are larger or smaller.
struct OtherMesh {
  Key key;
  bool is_coarser;
};

/// Those with larger elements first: runs on them cost less.
std::vector<OtherMesh> other_meshes(const Scene& scene);

inline const std::string too_long = "it takes longer than is allowed after a run";

class Companions {
public:
  Companions(Budget& budget, const BudgetHooks& hooks) : budget_(budget), hooks_(hooks) {}

  /// Throws as try_scene().
  Trial run(const Scene& scene, const std::string& what, const Goals* unlike = nullptr);

  /// Adds a part that `find` fills in, or why it cannot.
  void add(const Key& key, const std::function<void(BudgetPart&)>& find);

  /// Adds the part of the phases of a cycle where their positions are given, which cannot be known.
  void add_given_phases(const Scene& scene);

  /// The part of the mesh of a run, by the first of other_meshes() with which `find` succeeds. None
  /// where no key of the scene controls it.
  void add_mesh(const Scene& scene, const Goals& goals,
                const std::function<void(const OtherMesh&, BudgetPart&)>& find);

  /// What `base` is wrong by, from a run of a scene in which the key of the part is finer, or of
  /// one with half as many phases of a cycle, which costs less.
  void compare(BudgetPart& part, const Trial& base, const Key& key);

private:
  Budget& budget_;
  const BudgetHooks& hooks_;
  KeptMeshes meshes_;
  double work_ = 0;
};

/// The estimates of worn_volume are at least what the ledger shows. Adds what is missing to the
/// error in time.
void respect_ledger(Budget& budget, double ledger);

}  // namespace gnomon::budget

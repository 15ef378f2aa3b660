// Runs of a scene with larger elements and steps than its own, from which a plan is made.
#pragma once

#include <optional>
#include <string>

#include "budget/companions.hpp"
#include "budget/trade.hpp"

namespace gnomon::budget {

class Pilots {
public:
  /// With what a plan chooses for a scene before it runs (Key::Controls::chosen). `remarks`: what
  /// it could not choose, and why.
  Pilots(const Scene& asked, Budget& budget, const BudgetHooks& hooks,
         std::vector<std::string>& remarks);

  Scene scene;                        ///< with the models that have been chosen
  std::optional<Key> mesh{}, time{};  ///< by which its elements and steps are scaled

  Scene with(Factors factors) const { return with(factors, scene); }
  Scene with(Factors factors, Scene other) const;
  /// Whether there is a mesh of elements `factor` times as large.
  bool scales(double factor) const;

  Trial run(Factors factors, const std::string& what) { return run(with(factors), what); }
  /// Throws as try_scene().
  Trial run(const Scene& other, const std::string& what, const Goals* unlike = nullptr) {
    return companions_.run(other, what, unlike);
  }

  /// On the coarsest of some meshes on which contact has so many nodes that differences mean
  /// something, whose factor `factors` gets.
  Trial coarsest(Factors& factors);

private:
  Companions companions_;
};

}  // namespace gnomon::budget

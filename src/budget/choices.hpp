// The models and phases that a plan takes, for every error that may be asked for.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "budget/trade.hpp"

namespace gnomon::budget {

inline constexpr double small_part = 0.25;  ///< of what may be, of each model and of phases

/// A simpler model where the scene leaves it free.
struct ModelChoice {
  Key key;
  double error, rest;  ///< away from the ends of the contact, by which it is chosen, and with them
  double saved;        ///< CPU time without it over that with it
  bool is_taken;       ///< by the pilots
};

struct Choice {
  Scene scene;
  Trade trade;
};

struct Choices {
  std::vector<ModelChoice> models{};
  /// Of which there may be more, and the error of those of the pilots.
  std::optional<std::pair<Key, double>> phases{};

  /// From what the pilots have.
  Choice for_error(double within, Choice pilots) const;
};

}  // namespace gnomon::budget

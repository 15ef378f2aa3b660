#include "budget/choices.hpp"

namespace gnomon::budget {

namespace {

/// So many phases that their error is a small part of what may be. It falls with the square of
/// their number (cylinder on flat, 8 to 64 phases: 13, 4, 0.65, 0.23 %).
void choose_phases(const Key& key, double error, double within, Choice& choice) {
  constexpr double least = 1.0 / 16;
  double factor = 1;
  while (factor > least && factor * factor * error > small_part * within) factor /= 2;
  choice.scene = key.controls->scaled(choice.scene, factor).value_or(choice.scene);
  choice.trade.seconds /= factor;
  choice.trade.rest += factor * factor * error;
}

}  // namespace

Choice Choices::for_error(double within, Choice choice) const {
  for (const ModelChoice& model : models) {
    const bool suits = model.error <= small_part * within;
    if (suits == model.is_taken) continue;
    choice.scene = model.key.controls->scaled(choice.scene, suits ? 2 : 0.5).value_or(choice.scene);
    choice.trade.rest += suits ? model.rest : -model.rest;
    choice.trade.seconds *= suits ? 1 / model.saved : model.saved;
  }
  if (phases) choose_phases(phases->first, phases->second, within, choice);
  return choice;
}

}  // namespace gnomon::budget

#include "run/epochs.hpp"

#include <gnomon/base/error.hpp>
#include <utility>

#include "run/checkpoint_numbers.hpp"

namespace gnomon {

std::optional<Epochs::Change> Epochs::succeed(State& state) {
  if (!model().succeed) return std::nullopt;
  std::optional<Succession> next = model().succeed(state);
  if (!next) return std::nullopt;
  Change change{
      successor_, {.numbers = packed(state, model().system().structure())}, next->same_unknowns};
  successor_ = std::move(next->model);
  state = std::move(next->state);
  ++number_;
  return change;
}

void Epochs::repeat(std::span<const EpochStart> starts) {
  for (const EpochStart& start : starts) {
    State state = unpacked_state(start.numbers, model().system().structure());
    if (!succeed(state))
      throw InputError("this version of gnomon does not begin the epochs that the result has");
  }
}

}  // namespace gnomon

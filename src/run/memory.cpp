#include "run/memory.hpp"

#include <gnomon/base/error.hpp>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/system/system.hpp>
#include <utility>

namespace gnomon {

namespace {

State take_state(Unpacker& rest, const Structure& structure) {
  if (rest.one() != double(structure.size))
    throw InputError("the checkpoint does not belong to this scene");
  State state;
  state.t = rest.one();
  const bool has_branch = rest.one() != 0;
  state.y = rest.many<double>(static_cast<std::size_t>(structure.size));
  state.ydot.assign(state.y.size(), 0.0);
  for (std::size_t i = 0; i < state.ydot.size(); ++i)
    if (structure.differential[i]) state.ydot[i] = rest.one();
  state.branch = rest.many<char>(structure.switch_node.size());
  if (!has_branch) state.branch.clear();
  return state;
}

}  // namespace

std::vector<double> packed(const State& state, const Structure& structure) {
  std::vector<double> numbers = {double(structure.size), state.t, double(!state.branch.empty())};
  pack(numbers, state.y);
  for (std::size_t i = 0; i < state.ydot.size(); ++i)
    if (structure.differential[i]) pack(numbers, state.ydot[i]);
  pack(numbers, state.branch.empty() ? ActiveSet(structure.switch_node.size()) : state.branch);
  return numbers;
}

State unpacked_state(const std::vector<double>& numbers, const Structure& structure) {
  Unpacker rest(numbers);
  return take_state(rest, structure);
}

std::vector<double> packed(const RunMemory& memory, const Structure& structure) {
  std::vector<double> numbers = packed(memory.state, structure);
  memory.chattering.pack_into(numbers);
  pack(numbers, memory.stepper);
  return numbers;
}

RunMemory unpacked(const std::vector<double>& numbers, const Structure& structure) {
  Unpacker rest(numbers);
  RunMemory memory;
  memory.state = take_state(rest, structure);
  memory.chattering.unpack_from(rest);
  memory.stepper.assign(rest.rest().begin(), rest.rest().end());
  return memory;
}

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

bool Epochs::replace_overdue(State& state) {
  if (!model().overdue || !model().overdue(state)) return false;
  std::optional<Succession> next = model().succeed(state);
  if (!next || !next->same_unknowns) return false;
  successor_ = std::move(next->model);
  state = std::move(next->state);
  return true;
}

void Epochs::repeat(std::span<const EpochStart> starts) {
  for (const EpochStart& start : starts) {
    State state = unpacked_state(start.numbers, model().system().structure());
    if (!succeed(state))
      throw InputError("this version of gnomon does not begin the epochs that the result has");
  }
}

std::shared_ptr<const Model> model_of_epoch(const Model& first, std::span<const EpochStart> begun) {
  Epochs epochs(first);
  epochs.repeat(begun);
  return epochs.successor();
}

State state_at(const Checkpoint& checkpoint, const Model& model) {
  return unpacked(checkpoint.numbers, model.system().structure()).state;
}

}  // namespace gnomon

#include "linear/stiffness_block.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <map>
#include <string>

namespace gnomon {

namespace {

std::vector<std::vector<int>> by_owner(const Structure& structure, Role role, bool together) {
  std::map<int, std::vector<int>> owned;
  for (int i : unknowns_of(structure, {role}))
    owned[together ? 0 : structure.blocks[structure.block[i]].owner].push_back(i);
  std::vector<std::vector<int>> result;
  for (auto& [owner, unknowns] : owned) result.push_back(std::move(unknowns));
  if (result.empty()) result.emplace_back();
  return result;
}

}  // namespace

StiffnessBlock::StiffnessBlock(const Structure& structure, Role role, bool together,
                               const InnerSolverMaker& inner)
    : unknowns_(by_owner(structure, role, together)) {
  for (const std::vector<int>& unknowns : unknowns_) {
    parts_.emplace_back(structure.pattern, unknowns);
    if (parts_.back().lower().row_index != part().lower().row_index)
      throw Error("the stiffness blocks of two contact states are not alike");
  }
  b_.resize(owners() * unknowns().size());
  x_.resize(b_.size());
  if (unknowns().empty()) return;
  layout_.lower = part().lower();
  layout_.position = structure.position;
  layout_.coarsening = structure.coarsening;
  for (int i : unknowns()) {
    layout_.group.push_back(structure.group[i]);
    layout_.component.push_back(structure.component[i]);
  }
  solver_ = inner.make(layout_);
}

std::vector<double>& StiffnessBlock::gather(std::span<const double> J) {
  parts_.front().gather(J, values_);
  for (std::size_t owner = 1; owner < owners(); ++owner) {
    parts_[owner].gather(J, of_owner_);
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k] += of_owner_[k];
  }
  for (double& value : values_) value /= static_cast<double>(owners());
  return values_;
}

int StiffnessBlock::set_up(const char* what) {
  if (empty()) return 0;
  if (!solver_->set_up(values_)) throw RecoverableError(std::string(what) + " is singular");
  is_set_up_ = true;
  return solver_->factorizations();
}

std::span<double> StiffnessBlock::solve(std::span<const double> s) {
  auto target = b_.begin();
  for (const std::vector<int>& unknowns : unknowns_)
    for (int i : unknowns) *target++ = s[i];
  if (!empty()) solver_->apply(b_, x_);
  return x_;
}

void StiffnessBlock::scatter(std::span<const double> x, std::span<double> z) const {
  auto source = x.begin();
  for (const std::vector<int>& unknowns : unknowns_)
    for (int i : unknowns) z[i] = *source++;
}

}  // namespace gnomon

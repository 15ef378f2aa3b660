#include "run/chattering.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>

namespace gnomon {

namespace {
/// Losses of contact between two breakpoints. One loss is regular, for example while the load
/// falls. Before a second loss a node must have come into contact again.
constexpr int too_many = 2;
}  // namespace

void Chattering::add(const std::optional<ContactSurface>& surface) {
  if (!surface) return;
  if (!active_.empty() && active_.size() != surface->active.size())
    throw InputError("the checkpoint does not belong to this scene");
  losses_.resize(surface->active.size());
  for (std::size_t c = 0; c < active_.size(); ++c) losses_[c] += active_[c] && !surface->active[c];
  active_.assign(surface->active.begin(), surface->active.end());
}

void Chattering::begin_anew() {
  for (int& losses : losses_)
    if (losses < too_many) losses = 0;
}

long Chattering::nodes() const {
  return std::count_if(losses_.begin(), losses_.end(),
                       [](int losses) { return losses >= too_many; });
}

void Chattering::pack_into(std::vector<double>& numbers) const {
  pack(numbers, double(active_.size()));
  pack(numbers, active_);
  pack(numbers, losses_);
}

void Chattering::unpack_from(Unpacker& numbers) {
  const double count = numbers.one();
  if (!(count >= 0 && count <= static_cast<double>(numbers.rest().size())))
    throw InputError("the checkpoint does not belong to this scene");
  const auto nodes = static_cast<std::size_t>(count);
  active_ = numbers.many<char>(nodes);
  losses_ = numbers.many<int>(nodes);
}

}  // namespace gnomon

// Contact nodes that open and close again and again: the sign of steps above the critical one.
#pragma once

#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/model/model.hpp>
#include <optional>
#include <vector>

namespace gnomon {

class Flicker {
public:
  /// The contact surface after a step; a model without one never flickers.
  void add(const std::optional<ContactSurface>& surface);
  /// The load turns: a node may leave contact once more.
  void begin_anew();
  /// Nodes that have left contact twice or more, between two turns of the load.
  long nodes() const;

  void pack_into(std::vector<double>& numbers) const;
  void unpack_from(Unpacker& numbers);

private:
  std::vector<char> active_;
  std::vector<int> losses_;  // of contact, a node
};

}  // namespace gnomon

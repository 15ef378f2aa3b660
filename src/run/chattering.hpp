// Chattering: contact nodes that open and close again and again, as in steps above the critical
// one.
#pragma once

#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/model/model.hpp>
#include <optional>
#include <vector>

namespace gnomon {

class Chattering {
public:
  /// Takes the contact surface after a step; a model without one never chatters.
  void add(const std::optional<ContactSurface>& surface);
  /// Called at a breakpoint of the load: a node may leave contact once more.
  void begin_anew();
  /// Nodes that have left contact twice or more between two breakpoints of the load.
  long nodes() const;

  void pack_into(std::vector<double>& numbers) const;
  void unpack_from(Unpacker& numbers);

private:
  std::vector<char> active_;
  std::vector<int> losses_;  // losses of contact, one entry per node
};

}  // namespace gnomon

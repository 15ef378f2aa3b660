// Where contact sticks and slips, and how many elements the slip zone has.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// What a contact node does over a path.
enum class Hold : char { open, sticks, slips };

/// How many elements wide the slip zone beside contact that sticks is, where it is widest; 0 where
/// nothing slips; absent where no contact sticks, or what slips is elsewhere. `holds`: by contact
/// node.
template <int dim>
std::optional<int> width_of_slip_zone(const Assembly<dim>& assembly,
                                      const std::vector<Hold>& holds);

}  // namespace gnomon

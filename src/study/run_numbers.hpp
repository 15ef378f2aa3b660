// Numbers of the runs of a plan, from 1, as text: "3", "3-7", "3,5,9-12".
#pragma once

#include <string>
#include <vector>

namespace gnomon::study {

/// The indices (from 0) of the numbered runs, each once, in their order. Throws InputError for
/// anything but numbers up to `count`.
std::vector<std::size_t> runs_numbered(const std::string& text, std::size_t count);

/// The shortest text of these indices, ascending.
std::string numbers_of(std::vector<std::size_t> runs);

}  // namespace gnomon::study

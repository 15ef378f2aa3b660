// The stored time that a printed one, or the label of a figure, stands for.
#pragma once

#include <string>
#include <vector>

namespace gnomon::app {

/// Of the stored `times`, ascending, the nearest that is `text` when it is rounded to the digits of
/// `text`: "350", "350 s", "t = 3.5e2". Throws InputError, which begins with `file` and names the
/// times next to it.
double stored_time(const std::vector<double>& times, const std::string& text,
                   const std::string& file);

/// A check of an argument as CLI11 requires it: a complaint unless the text is a time.
std::string check_time(const std::string& text);

}  // namespace gnomon::app

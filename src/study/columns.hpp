// The table of a study.
#pragma once

#include <gnomon/study/study.hpp>

#include "study/table.hpp"

namespace gnomon::study {

/// The columns that every study has, one for each swept key, and one for each quantity that a run
/// has observed.
Table results_of(const Study& study, const StudyTable& table);

}  // namespace gnomon::study

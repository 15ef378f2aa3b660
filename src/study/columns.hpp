// The columns of a study's table: the interface to all programs that read study.csv and study.h5.
#pragma once

#include <cstdint>
#include <functional>
#include <gnomon/study/study.hpp>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::study {

/// The value of one cell of a row; monostate if there is none.
using CellValue = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Column {
  enum class Kind { text, integer, real };
  std::string name;
  std::string unit;
  Kind kind = Kind::text;
  std::function<CellValue(const Study&, const StudyTable&, const StudyRow&)> value;
};

/// The columns that every study has, one for each swept key, and one for each quantity that a run
/// has observed.
std::vector<Column> columns(const Study& study, const StudyTable& table);

/// Shortest exact text of a cell; empty when there is no value.
std::string cell_text(const CellValue& value);

}  // namespace gnomon::study

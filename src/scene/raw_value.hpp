// The contents of a TOML document, before anything is known about keys, without types of the TOML
// library.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace gnomon {

/// A TOML value that no key accepts (date, table, nested array), by its description.
struct ForeignValue {
  std::string description;  ///< "a table"
  bool is_table = false;
};

using RawScalar = std::variant<bool, long, double, std::string, ForeignValue>;
using RawArray = std::vector<RawScalar>;

struct RawValue {
  std::variant<RawScalar, RawArray> content;
};

/// One key of a document.
struct RawEntry {
  std::string name;  ///< dotted, parts quoted as TOML does where they need it
  int line = 0;
  RawValue value;
  std::vector<RawValue> elements{};  ///< the elements of an array, which may be arrays themselves
};

/// One table of an array of tables: [[name]].
struct RawTable {
  std::string name;
  int line = 0;
  std::vector<RawEntry> entries;  ///< named as in the table
};

/// A document whose top level may hold arrays of tables.
struct RawDocument {
  std::vector<RawEntry> entries;
  std::vector<RawTable> tables;
};

bool is_table(const RawValue& value);

/// Short text of a value for messages: `-3`, `"steel"`, `an array of 3 values`.
std::string describe(const RawScalar& value);
std::string describe(const RawValue& value);

}  // namespace gnomon

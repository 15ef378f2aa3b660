// The XDMF description of a result: a temporal collection over the datasets of the HDF5 file.
#pragma once

#include <filesystem>
#include <gnomon/model.hpp>
#include <string>
#include <vector>

namespace gnomon {

class XdmfSidecar {
public:
  /// Writes the sidecar (same name as the result, .xdmf) with no steps yet. Throws Error.
  XdmfSidecar(const std::filesystem::path& result, const Grid& grid);

  /// Adds a step whose fields are datasets below `group` ("/steps/0000/000012"). The sidecar is
  /// replaced as a whole, so it is valid XML at every moment. Throws Error.
  void add_step(double t, const std::string& group, const std::vector<Field>& fields);

  static std::filesystem::path path_for(const std::filesystem::path& result);

private:
  void write() const;
  std::string item(const std::string& dataset, const std::string& extents, bool integer) const;

  std::filesystem::path path_;
  std::string result_name_;  ///< as XML text, relative to the sidecar
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
  std::string mesh_;   ///< topology and geometry, the same in every step
  std::string steps_;  ///< one Grid element a stored step
};

}  // namespace gnomon

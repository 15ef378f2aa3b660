// The XDMF description of a result: a temporal collection over the datasets of the HDF5 file.
#pragma once

#include <filesystem>
#include <gnomon/model/model.hpp>
#include <gnomon/results/result_files.hpp>
#include <string>
#include <vector>

namespace gnomon {

class XdmfSidecar {
public:
  /// A sidecar of the result, without steps. Nothing is written. Throws Error if another file has
  /// the name of its part.
  XdmfSidecar(const std::filesystem::path& result, const Grid& grid);

  /// Gives the file its name. Throws Error.
  void publish(Earlier earlier);

  /// Adds a step whose fields are datasets below `group` ("/steps/0000/000012"). A published
  /// sidecar is replaced as a whole, so it is valid XML at every moment. Throws Error.
  void add_step(double t, const std::string& group, const std::vector<GridField>& fields);

private:
  void write(Earlier earlier) const;
  std::string item(const std::string& dataset, const std::string& extents, bool integer) const;

  std::filesystem::path path_;
  std::string result_name_;  ///< as XML text, relative to the sidecar
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
  std::string mesh_;   ///< topology and geometry, the same in every step
  std::string steps_;  ///< one Grid element per stored step
  bool published_ = false;
};

}  // namespace gnomon

// The XDMF description of a result: a temporal collection over the datasets of the HDF5 file.
#pragma once

#include <filesystem>
#include <gnomon/model/model.hpp>
#include <gnomon/results/result_files.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/stored_mesh.hpp"

namespace gnomon {

class XdmfSidecar {
public:
  /// A sidecar of the result, without steps. Nothing is written. Throws Error if another file has
  /// the name of its part.
  XdmfSidecar(const std::filesystem::path& result, const Grid& grid);

  /// The mesh of the steps that follow: points and cells below `group`/mesh; "" for the root.
  void set_mesh(const Grid& grid, const std::string& group);
  /// Gives the file its name. Throws Error.
  void publish(Earlier earlier);

  /// Adds a step whose fields are datasets below `group` ("/steps/0000/000012"), and the
  /// counter-body beside it. A published
  /// sidecar is replaced as a whole, so it is valid XML at every moment. Throws Error.
  void add_step(double t, const std::string& group, const std::vector<GridField>& fields,
                const std::optional<layout::StoredSurface>& counter_body = {});

private:
  void write(Earlier earlier) const;
  void add_counter_body(double t, const layout::StoredSurface& surface);
  std::string item(const std::string& dataset, const std::string& extents, bool integer) const;

  std::filesystem::path path_;
  std::string result_name_;  ///< as XML text, relative to the sidecar
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
  std::string mesh_;   ///< topology and geometry, the same in every step of an epoch
  std::string steps_;  ///< one Grid element per stored step
  std::string counter_steps_;
  bool published_ = false;
};

/// Every XDMF file of gnomon begins so.
inline constexpr const char* xdmf_head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Xdmf Version=\"3.0\">\n"
    "  <Domain>\n";
inline constexpr const char* xdmf_end = "  </Domain>\n</Xdmf>\n";

/// A grid of elements, with the items of their nodes and of the points.
std::string mesh_text(const char* topology, std::size_t elements, const std::string& nodes,
                      const std::string& points);

/// With the characters replaced that have a meaning in XML.
std::string escaped(const std::string& text);

bool begins_with(const std::filesystem::path& file, const std::string& text);

}  // namespace gnomon

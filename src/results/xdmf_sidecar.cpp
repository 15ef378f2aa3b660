#include "results/xdmf_sidecar.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>

#include "results/replaced_file.hpp"

namespace gnomon {

namespace {

// Every sidecar begins with this text: a file that begins differently does not come from gnomon.
constexpr const char* head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Xdmf Version=\"3.0\">\n"
    "  <Domain>\n"
    "    <Grid Name=\"steps\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

std::filesystem::path sidecar_of(const std::filesystem::path& result) {
  std::error_code error;
  std::filesystem::path file = result;
  if (std::filesystem::is_symlink(result, error)) file = std::filesystem::canonical(result, error);
  if (error) file = result;
  return file.replace_extension(".xdmf");
}

bool is_sidecar(const std::filesystem::path& file) {
  std::string start(std::strlen(head), '\0');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == head;
}

XdmfSidecar::XdmfSidecar(const std::filesystem::path& result, const Grid& grid)
    : path_(sidecar_of(result)), result_name_(escaped(result.filename().string())) {
  require_own_part(path_, head);
  const bool flat = grid.cell == Grid::Cell::quadrilateral;
  const std::size_t corners = flat ? 4 : 8;
  points_ = grid.points.size();
  cells_ = grid.cells.size() / corners;
  mesh_ = fmt::format(
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      flat ? "Quadrilateral" : "Hexahedron", cells_,
      item("/mesh/cells", fmt::format("{} {}", cells_, corners), true),
      item("/mesh/points", fmt::format("{} 3", points_), false));
}

void XdmfSidecar::publish(Earlier earlier) {
  write(earlier);
  published_ = true;
}

std::string XdmfSidecar::item(const std::string& dataset, const std::string& extents,
                              bool integer) const {
  return fmt::format(
      "<DataItem Format=\"HDF\" {} Dimensions=\"{}\">{}:{}</DataItem>",
      integer ? "NumberType=\"Int\" Precision=\"4\"" : "NumberType=\"Float\" Precision=\"8\"",
      extents, result_name_, escaped(dataset));
}

void XdmfSidecar::add_step(double t, const std::string& group,
                           const std::vector<GridField>& fields) {
  steps_ += fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n{}", group,
      t, mesh_);
  for (const GridField& field : fields) {
    const bool nodal = field.on == GridField::On::nodes;
    const bool vector = field.components == 3;
    const std::size_t count = nodal ? points_ : cells_;
    steps_ += fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
        escaped(field.name), vector ? "Vector" : "Scalar", nodal ? "Node" : "Cell",
        item(group + "/" + field.name, fmt::format("{}{}", count, vector ? " 3" : ""), false));
  }
  steps_ += "      </Grid>\n";
  if (published_) write(Earlier::replaced);
}

void XdmfSidecar::write(Earlier earlier) const {
  write_file(path_, head + steps_ + "    </Grid>\n  </Domain>\n</Xdmf>\n", earlier);
}

}  // namespace gnomon

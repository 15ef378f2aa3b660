#include "results/xdmf_sidecar.hpp"

#include <fmt/format.h>

#include <fstream>
#include <map>

#include "results/replaced_file.hpp"

namespace gnomon {

namespace {

constexpr const char* body =
    "    <Grid Name=\"steps\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* counter_body =
    "    <Grid Name=\"counter_body\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* collection_end = "    </Grid>\n";

}  // namespace

std::filesystem::path sidecar_of(const std::filesystem::path& result) {
  std::error_code error;
  std::filesystem::path file = result;
  if (std::filesystem::is_symlink(result, error)) file = std::filesystem::canonical(result, error);
  if (error) file = result;
  return file.replace_extension(".xdmf");
}

// Every sidecar begins so: a file that begins differently does not come from gnomon.
bool is_sidecar(const std::filesystem::path& file) {
  return begins_with(file, std::string(xdmf_head) + body) ||
         begins_with(file, std::string(xdmf_head) + counter_body);
}

XdmfSidecar::XdmfSidecar(const std::filesystem::path& result, const Grid& grid)
    : path_(sidecar_of(result)), result_name_(escaped(result.filename().string())) {
  require_own_part(path_, xdmf_head);
  set_mesh(grid, "");
}

void XdmfSidecar::set_mesh(const Grid& grid, const std::string& group) {
  points_ = grid.points.size();
  cells_ = grid.cell_count();
  mesh_ = mesh_text(grid.cell == Grid::Cell::quadrilateral ? "Quadrilateral" : "Hexahedron", cells_,
                    item(group + "/mesh/cells", fmt::format("{} {}", cells_, grid.corners()), true),
                    item(group + "/mesh/points", fmt::format("{} 3", points_), false));
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

void XdmfSidecar::add_step(double t, const std::string& group, const std::vector<GridField>& fields,
                           const std::optional<layout::StoredSurface>& surface) {
  if (surface) add_counter_body(t, *surface);
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

void XdmfSidecar::add_counter_body(double t, const layout::StoredSurface& surface) {
  const bool flat = surface.dim == 2;
  counter_steps_ += fmt::format(
      "      <Grid Name=\"counter_body\" GridType=\"Uniform\">\n"
      "        <Time Value=\"{:.17g}\"/>\n"
      "{}      </Grid>\n",
      t,
      mesh_text(flat ? "Polyline\" NodesPerElement=\"2" : "Quadrilateral", surface.facet_count,
                item(surface.facets, fmt::format("{} {}", surface.facet_count, flat ? 2 : 4), true),
                item(surface.points, fmt::format("{} 3", surface.point_count), false)));
}

// The body is last, because meshio reads the last collection alone.
void XdmfSidecar::write(Earlier earlier) const {
  std::string text = xdmf_head;
  if (!counter_steps_.empty()) text += counter_body + counter_steps_ + collection_end;
  write_file(path_, text + body + steps_ + collection_end + xdmf_end, earlier);
}

std::string mesh_text(const char* topology, std::size_t elements, const std::string& nodes,
                      const std::string& points) {
  return fmt::format(
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      topology, elements, nodes, points);
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : text) {
    const auto found = entities.find(c);
    result += found == entities.end() ? std::string(1, c) : found->second;
  }
  return result;
}

bool begins_with(const std::filesystem::path& file, const std::string& text) {
  std::string start(text.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == text;
}

}  // namespace gnomon

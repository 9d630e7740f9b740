#include "io/mesh/write_gmsh.h"

#include <algorithm>
#include <array>

#include "io/text/number_text.h"
#include "io/vtk/vtk_cells.h"
#include "model/box3.h"

namespace strataflow {

namespace {
/// What Gmsh calls a block: elements of one type on one entity.
struct BlockKey {
  int dimension = 0;
  std::uint32_t entity = 0;  ///< a surface, or a place among the used regions
  int type = 0;
  friend constexpr auto operator<=>(const BlockKey&, const BlockKey&) = default;
};

struct Element {
  BlockKey block;
  std::uint32_t index = 0;  ///< of the facet or cell
};

int gmsh_type(CellType type) {
  switch (type) {
    case CellType::tetrahedron:
      return 4;
    case CellType::hexahedron:
      return 5;
    case CellType::prism:
      return 6;
    case CellType::pyramid:
      return 7;
  }
  return 0;
}

class GmshText {
 public:
  explicit GmshText(const VolumeMesh& mesh) : mesh_(mesh) {
    std::uint32_t surface_count = static_cast<std::uint32_t>(mesh.surface_entity.size());
    for (const MeshFacet& facet : mesh.facets)
      if (facet.surface != no_index) surface_count = std::max(surface_count, facet.surface + 1);
    regions_ = used_regions(mesh);
    names_ = region_names(mesh, regions_);
    const std::vector<std::uint32_t> places = region_places(mesh, regions_);
    // Facets and cells without a label go to one entity more, which is in no physical group.
    for (std::uint32_t f = 0; f < mesh.facets.size(); ++f)
      elements_.push_back(
          {{2, std::min(mesh.facets[f].surface, surface_count), mesh.facets[f].vertices[3] == no_index ? 2 : 3}, f});
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c)
      elements_.push_back({{3, places[c], gmsh_type(mesh.cell_types[c])}, c});
    std::sort(elements_.begin(), elements_.end(), [](const Element& a, const Element& b) {
      return a.block != b.block ? a.block < b.block : a.index < b.index;
    });
    boxes_[0].resize(std::size_t{surface_count} + 1);
    boxes_[1].resize(regions_.size() + 1);
    for (const Element& element : elements_)
      for (const std::uint32_t vertex : vertices(element))
        boxes_[element.block.dimension - 2][element.block.entity].take(mesh.points[vertex] + mesh.local_origin);
  }

  std::string write() {
    text_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    write_names();
    write_entities();
    write_nodes();
    write_elements();
    return std::move(text_);
  }

 private:
  std::vector<std::uint32_t> vertices(const Element& element) const {
    if (element.block.dimension == 2) {
      const auto& facet = mesh_.facets[element.index].vertices;
      return {facet.begin(), facet.begin() + (element.block.type == 2 ? 3 : 4)};
    }
    std::vector<std::uint32_t> corners(mesh_.cell_vertices.begin() + mesh_.cell_offsets[element.index],
                                       mesh_.cell_vertices.begin() + mesh_.cell_offsets[element.index + 1]);
    swap_prism_order(mesh_.cell_types[element.index], corners.data());
    return corners;
  }

  void row(std::initializer_list<std::uint64_t> numbers) {
    for (const std::uint64_t number : numbers) {
      append_number(text_, number);
      text_ += ' ';
    }
    text_.back() = '\n';
  }

  static std::string quoted(std::string name) {
    std::replace(name.begin(), name.end(), '"', '\'');
    std::replace(name.begin(), name.end(), '\n', ' ');
    return "\"" + name + "\"";
  }

  void write_names() {
    if (mesh_.entities.size() + names_.size() == 0) return;
    text_ += "$PhysicalNames\n" + std::to_string(mesh_.entities.size() + names_.size()) + "\n";
    for (std::size_t e = 0; e < mesh_.entities.size(); ++e)
      text_ += "2 " + std::to_string(e + 1) + " " + quoted(mesh_.entities[e].name) + "\n";
    for (std::size_t r = 0; r < names_.size(); ++r)
      text_ += "3 " + std::to_string(tag(3, r)) + " " + quoted(names_[r]) + "\n";
    text_ += "$EndPhysicalNames\n";
  }

  /// Gmsh counts from 1. Cells without a region come after the last.
  std::uint64_t tag(int dimension, std::size_t entity) const {
    if (dimension == 2) return entity + 1;
    if (entity < regions_.size()) return static_cast<std::uint64_t>(regions_[entity]) + 1;
    return regions_.empty() ? 1 : static_cast<std::uint64_t>(regions_.back()) + 2;
  }

  void write_entity(std::uint64_t entity_tag, const Box3& box, std::optional<std::uint64_t> group) {
    append_number(text_, entity_tag);
    text_ += ' ';
    append_point(text_, box.low);
    text_ += ' ';
    append_point(text_, box.high);
    text_ += group ? " 1 " + std::to_string(*group) + " 0\n" : " 0 0\n";
  }

  void write_entities() {
    std::array<std::size_t, 2> counts{};
    for (int d = 0; d < 2; ++d)
      for (const Box3& box : boxes_[d]) counts[d] += !box.is_empty();
    text_ += "$Entities\n";
    row({0, 0, counts[0], counts[1]});
    for (std::size_t s = 0; s < boxes_[0].size(); ++s) {
      const bool has_entity = s < mesh_.surface_entity.size() && mesh_.surface_entity[s] >= 0;
      if (!boxes_[0][s].is_empty())
        write_entity(
            tag(2, s), boxes_[0][s],
            has_entity ? std::optional(static_cast<std::uint64_t>(mesh_.surface_entity[s]) + 1) : std::nullopt);
    }
    for (std::size_t r = 0; r < boxes_[1].size(); ++r)
      if (!boxes_[1][r].is_empty())
        write_entity(tag(3, r), boxes_[1][r], r < names_.size() ? std::optional(tag(3, r)) : std::nullopt);
    text_ += "$EndEntities\n";
  }

  void write_nodes() {
    const std::uint64_t count = mesh_.points.size();
    const BlockKey owner =
        elements_.empty() ? BlockKey{2, 0, 0} : elements_.back().block;  // nodes are not told apart by entity
    text_ += "$Nodes\n";
    row({1, count, 1, count});
    row({static_cast<std::uint64_t>(owner.dimension), tag(owner.dimension, owner.entity), 0, count});
    for (std::uint64_t i = 1; i <= count; ++i) row({i});
    for (const Vec3& point : mesh_.points) {
      append_point(text_, point + mesh_.local_origin);
      text_ += '\n';
    }
    text_ += "$EndNodes\n";
  }

  void write_elements() {
    std::uint64_t blocks = 0;
    for (std::size_t i = 0; i < elements_.size(); ++i) blocks += i == 0 || elements_[i].block != elements_[i - 1].block;
    text_ += "$Elements\n";
    row({blocks, elements_.size(), 1, elements_.size()});
    for (std::size_t begin = 0; begin < elements_.size();) {
      const BlockKey block = elements_[begin].block;
      std::size_t end = begin;
      while (end < elements_.size() && elements_[end].block == block) ++end;
      row({static_cast<std::uint64_t>(block.dimension), tag(block.dimension, block.entity),
           static_cast<std::uint64_t>(block.type), end - begin});
      for (; begin < end; ++begin) {
        append_number(text_, begin + 1);
        for (const std::uint32_t vertex : vertices(elements_[begin])) {
          text_ += ' ';
          append_number(text_, vertex + 1);
        }
        text_ += '\n';
      }
    }
    text_ += "$EndElements\n";
  }

  const VolumeMesh& mesh_;
  std::vector<Element> elements_;
  std::array<std::vector<Box3>, 2> boxes_;  ///< of surfaces, of regions
  std::vector<std::int32_t> regions_;       ///< that have cells, ascending
  std::vector<std::string> names_;          ///< of these
  std::string text_;
};
}  // namespace

std::string write_gmsh(const VolumeMesh& mesh) { return GmshText(mesh).write(); }
std::string write_gmsh(const LabelledTriangles& surfaces) { return write_gmsh(facets_only(surfaces)); }

}  // namespace strataflow

#include "io/vtk/vtk_cells.h"

#include <utility>

namespace strataflow {

namespace {
enum VtkType : std::int64_t {
  vertex = 1,
  poly_vertex = 2,
  line = 3,
  poly_line = 4,
  triangle = 5,
  strip = 6,
  polygon = 7,
  pixel = 8,
  quad = 9,
  tetra = 10,
  voxel = 11,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14
};

/// Adds the cells of one piece; the first problem sticks.
class PieceAdder {
 public:
  PieceAdder(InputBuilder& built, SkippedCells& skipped, const VtkPiece& piece,
             const std::vector<std::uint32_t>& entity_ids)
      : built_(built), skipped_(skipped), piece_(piece), entity_ids_(entity_ids) {}

  Result<void> add() {
    const std::size_t cell_count = piece_.verts.offsets.size() + piece_.lines.offsets.size() +
                                   piece_.polys.offsets.size() + piece_.strips.offsets.size() +
                                   piece_.cells.offsets.size();
    check_labels("surface", piece_.surface, cell_count);
    check_labels("entity", piece_.entity, cell_count);
    check_labels("region", piece_.region, cell_count);
    if (piece_.types.size() != piece_.cells.offsets.size())
      fail(std::to_string(piece_.types.size()) + " cell types for " + std::to_string(piece_.cells.offsets.size()) +
           " cells");
    add_all(piece_.verts, poly_vertex);
    add_all(piece_.lines, poly_line);
    add_all(piece_.polys, polygon);
    add_all(piece_.strips, strip);
    add_all(piece_.cells, 0);
    if (failure_) return *failure_;
    return {};
  }

 private:
  void fail(const std::string& what) {
    if (!failure_)
      failure_ = Failure{FailureCode::malformed_file, built_.file_name() + ": " + what,
                         "write the file again, for example with ParaView"};
  }

  void check_labels(const char* name, const std::vector<std::int64_t>& values, std::size_t cell_count) {
    if (!values.empty() && values.size() != cell_count)
      fail(std::string("cell array '") + name + "' has " + std::to_string(values.size()) + " values for " +
           std::to_string(cell_count) + " cells");
  }

  /// Type 0: each cell has its own.
  void add_all(const VtkCellList& list, std::int64_t common_type) {
    const std::int64_t point_count = static_cast<std::int64_t>(built_.points.size()) - piece_.first_point;
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < list.offsets.size() && !failure_; ++c, ++cell_) {
      const std::int64_t end = list.offsets[c];
      if (end < begin || end > static_cast<std::int64_t>(list.vertices.size()))
        return fail("cell " + std::to_string(cell_ + 1) + ": offset " + std::to_string(end) +
                    " is out of order or behind the end");
      vertices_.clear();
      for (; begin < end; ++begin) {
        const std::int64_t v = list.vertices[static_cast<std::size_t>(begin)];
        if (v < 0 || v >= point_count)
          return fail("cell " + std::to_string(cell_ + 1) + " refers to point " + std::to_string(v) +
                      "; points go from 0 to " + std::to_string(point_count - 1));
        vertices_.push_back(static_cast<std::uint32_t>(v + piece_.first_point));
      }
      add_cell(common_type == 0 ? piece_.types[c] : common_type);
    }
  }

  void add_cell(std::int64_t type) {
    switch (type) {
      case vertex:
      case poly_vertex:
        return;
      case line:
      case poly_line:
        if (vertices_.size() > 1) built_.add_line(vertices_.data(), vertices_.size(), built_.stem());
        return;
      case triangle:
      case strip:
      case polygon:
      case pixel:
      case quad:
        return add_surface_cell(type);
      case tetra:
      case voxel:
      case hexahedron:
      case wedge:
      case pyramid:
        return add_volume_cell(type);
      default:
        skipped_.add("cell of VTK type " + std::to_string(type));
    }
  }

  void add_surface_cell(std::int64_t type) {
    if (vertices_.size() < 3) return skipped_.add("polygon of fewer than three points");
    const std::uint32_t patch = this->patch();
    if (type == pixel && vertices_.size() == 4) std::swap(vertices_[2], vertices_[3]);
    if (type != strip) return built_.add_polygon(vertices_.data(), vertices_.size(), patch);
    for (std::size_t i = 2; i < vertices_.size(); ++i) {
      const std::size_t turned = i % 2;  // every other triangle of a strip is turned over
      const std::uint32_t corners[3] = {vertices_[i - 2 + turned], vertices_[i - 1 - turned], vertices_[i]};
      built_.add_polygon(corners, 3, patch);
    }
  }

  void add_volume_cell(std::int64_t type) {
    const CellType cell_type = type == voxel ? CellType::hexahedron : static_cast<CellType>(type);
    if (vertices_.size() != static_cast<std::size_t>(vertex_count(cell_type)))
      return fail("cell " + std::to_string(cell_ + 1) + " of VTK type " + std::to_string(type) + " has " +
                  std::to_string(vertices_.size()) + " points");
    if (type == voxel) {
      std::swap(vertices_[2], vertices_[3]);
      std::swap(vertices_[6], vertices_[7]);
    }
    const std::int64_t named = named_entity();
    const std::int64_t region = piece_.region.empty() ? -1 : piece_.region[cell_];
    built_.add_cell(cell_type, vertices_.data(), label(region),
                    label(named >= 0            ? named
                          : entity_ids_.empty() ? entity()
                                                : -1));
  }

  static std::int32_t label(std::int64_t value) {
    return value < 0 || value > 0x7fffffff ? -1 : static_cast<std::int32_t>(value);
  }
  std::int64_t entity() const { return piece_.entity.empty() ? -1 : piece_.entity[cell_]; }
  /// The builder's id of the cell's entity, -1 when the file does not name it.
  std::int64_t named_entity() {
    const std::int64_t number = entity();
    if (number < 0 || entity_ids_.empty()) return -1;
    if (number < static_cast<std::int64_t>(entity_ids_.size())) return entity_ids_[static_cast<std::size_t>(number)];
    fail("cell " + std::to_string(cell_ + 1) + " is of entity " + std::to_string(number) + ", but only " +
         std::to_string(entity_ids_.size()) + " have names");
    return -1;
  }

  std::uint32_t patch() {
    const std::int64_t surface = piece_.surface.empty() ? -1 : piece_.surface[cell_];
    const std::int64_t named = named_entity();
    if (named >= 0) return built_.patch(surface, static_cast<std::uint32_t>(named));
    std::string name = built_.stem();
    if (!piece_.entity.empty())
      name += "_" + std::to_string(entity());
    else if (!piece_.surface.empty())
      name += "_" + std::to_string(surface);
    return built_.patch(surface, built_.entity(name));
  }

  InputBuilder& built_;
  SkippedCells& skipped_;
  const VtkPiece& piece_;
  const std::vector<std::uint32_t>& entity_ids_;
  std::size_t cell_ = 0;
  std::vector<std::uint32_t> vertices_;  // of the current cell
  std::optional<Failure> failure_;
};
}  // namespace

Result<void> add_vtk_piece(InputBuilder& built, SkippedCells& skipped, const VtkPiece& piece,
                           const std::vector<std::uint32_t>& entity_ids) {
  return PieceAdder(built, skipped, piece, entity_ids).add();
}

void swap_prism_order(CellType type, std::uint32_t* vertices) {
  if (type != CellType::prism) return;
  std::swap(vertices[1], vertices[2]);
  std::swap(vertices[4], vertices[5]);
}

}  // namespace strataflow

#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Gathers what a mesh file holds (points, polygons, lines, volume cells, all indexing one list of points) and parts
/// it into the members of InputData. Patches and entities get ids in the order they are first named.
class InputBuilder {
 public:
  explicit InputBuilder(std::string file_name);

  std::vector<Vec3> points;
  std::vector<PointProperty> properties;               ///< of the points
  std::vector<std::int32_t> point_line, point_corner;  ///< kept for volumes; surfaces find them from the geometry
  std::vector<Warning> warnings;
  std::vector<std::string> region_names;

  const std::string& file_name() const { return file_name_; }
  /// The file's name without folder and ending: what an unnamed surface is called.
  const std::string& stem() const { return stem_; }

  /// The id of the entity of that name, added if new.
  std::uint32_t entity(const std::string& name);
  void set_role(std::uint32_t entity, Role role) { entities_[entity].role = role; }
  /// The patch of that key, added if new. A patch belongs to one entity.
  std::uint32_t patch(std::int64_t key, std::uint32_t entity);
  std::uint32_t patch(const std::string& entity_name);

  // Vertices must be < points.size() when `finish` is called; `finish` says which cell is not.
  void add_polygon(const std::uint32_t* vertices, std::size_t count, std::uint32_t patch);  ///< fans; needs >= 3
  void add_line(const std::uint32_t* vertices, std::size_t count, const std::string& name);
  void add_segment(std::uint32_t from, std::uint32_t to,
                   const std::string& name);  ///< continues the last line if it fits
  void add_cell(CellType type, const std::uint32_t* vertices, std::int32_t region, std::int32_t entity = -1);
  /// Numbers the regions 0, 1 … in ascending order of the file's own labels, one per cell added so far.
  void name_regions(const std::vector<std::int64_t>& labels, const std::function<std::string(std::int64_t)>& name);
  void warn(std::string kind, std::string what) {
    warnings.push_back({std::move(kind), file_name_ + ": " + std::move(what)});
  }

  /// Fails with malformed_file: a coordinate that is not finite, a vertex out of range.
  Result<InputData> finish() &&;

 private:
  struct IndexedLine {
    std::string name;
    std::vector<std::uint32_t> vertices;
    bool takes_segments = false;
  };
  std::string file_name_, stem_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> triangle_patch_, patch_entity_;
  std::vector<Entity> entities_;
  std::map<std::string, std::uint32_t> entity_ids_;
  std::map<std::pair<std::int64_t, std::uint32_t>, std::uint32_t> patch_ids_;
  std::vector<IndexedLine> lines_;
  VolumeMesh volume_;
};

/// The file's name without folder, ending and a final ".gz".
std::string stem_of(const std::string& file_name);

}  // namespace strataflow

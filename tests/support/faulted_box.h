#pragma once
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow::support {

/// A box of three flat horizons and parallel flat faults that dip 60° to the east: 4 (faults + 1) regions whose volumes
/// are known. Blocks are 300 m wide; each lies deeper than the first one by its own drop.
class FaultedBox {
 public:
  explicit FaultedBox(std::uint32_t faults) : faults_(faults) {}

  /// A region by the entities around it, and its volume.
  struct KnownRegion {
    std::set<std::string> entities;
    double volume_m3 = 0;
  };
  std::vector<KnownRegion> regions() const {
    std::vector<KnownRegion> regions;
    for (std::uint32_t block = 0; block <= faults_; ++block)
      for (std::uint32_t layer = 0; layer <= horizons; ++layer) {
        const double low = layer == 0 ? 0 : horizon_z(layer - 1, block);
        const double high = layer == horizons ? height_m : horizon_z(layer, block), middle = 0.5 * (low + high);
        const double width_m = line_x(block + 1, middle) - line_x(block, middle);  // linear in z
        regions.push_back({{block == 0 ? "West" : fault_name(block), block == faults_ ? "East" : fault_name(block + 1),
                            layer == 0 ? "Bottom" : horizon_name(layer - 1),
                            layer == horizons ? "Top" : horizon_name(layer), "North", "South"},
                           width_m * length_m * (high - low)});
      }
    return regions;
  }

  /// Horizons as a sheet per block; every sheet stops short of what it should touch by the share `ratio` of its extent
  /// across (negative: overshoots).
  TriangleSoup raw_surfaces(double ratio) const {
    TriangleSoup soup;
    for (std::uint32_t h = 0; h < horizons; ++h) {
      soup.entities.push_back({horizon_name(h), Role::horizon});
      for (std::uint32_t block = 0; block <= faults_; ++block) {
        const double z = horizon_z(h, block), west = line_x(block, z), east = line_x(block + 1, z);
        add_sheet(soup, 3, 5, [&](double u, double v) {
          return Vec3{west + within(u, ratio) * (east - west), within(v, ratio) * length_m, z};
        });
      }
    }
    for (std::uint32_t line = 1; line <= faults_; ++line) {
      soup.entities.push_back({fault_name(line), Role::fault});
      add_sheet(soup, 6, 7, [&](double u, double v) {
        const double z = within(v, ratio) * height_m;
        return Vec3{line_x(line, z), within(u, ratio) * length_m, z};
      });
    }
    const double width_m = block_width_m * (faults_ + 1);
    const std::uint32_t along_x = 3 * (faults_ + 1), along_y = 6, along_z = 5;
    for (const auto& [name, z] : {std::pair{"Top", height_m}, {"Bottom", 0.0}}) {
      soup.entities.push_back({name, Role::boundary});
      add_sheet(soup, along_x, along_y, [&](double u, double v) { return Vec3{u * width_m, v * length_m, z}; });
    }
    for (const auto& [name, y] : {std::pair{"North", length_m}, {"South", 0.0}}) {
      soup.entities.push_back({name, Role::boundary});
      add_sheet(soup, along_x, along_z, [&](double u, double v) { return Vec3{u * width_m, y, v * height_m}; });
    }
    for (const auto& [name, x] : {std::pair{"East", width_m}, {"West", 0.0}}) {
      soup.entities.push_back({name, Role::boundary});
      add_sheet(soup, along_y, along_z, [&](double u, double v) { return Vec3{x, u * length_m, v * height_m}; });
    }
    return soup;
  }

 private:
  static constexpr std::uint32_t horizons = 3;
  static constexpr double block_width_m = 300, length_m = 600, height_m = 500, cot_dip = 0.57735026918962576;

  static std::string horizon_name(std::uint32_t h) { return "H" + std::to_string(h + 1); }
  static std::string fault_name(std::uint32_t line) { return "F" + std::to_string(line); }
  static double within(double share, double ratio) { return ratio + share * (1 - 2 * ratio); }

  /// Throws are between 17 and 79 m, in both directions.
  static double drop_m(std::uint32_t block) { return 12.0 * (block % 5) + 31.0 * (block % 2); }
  static double horizon_z(std::uint32_t h, std::uint32_t block) { return 120 + 130.0 * h - drop_m(block); }
  double line_x(std::uint32_t line, double z) const {
    const double x = block_width_m * line;
    return line == 0 || line > faults_ ? x : x + (0.5 * height_m - z) * cot_dip;
  }

  /// A patch of the last entity: columns × rows quads over the unit square, halved.
  template <class Point>
  static void add_sheet(TriangleSoup& soup, std::uint32_t columns, std::uint32_t rows, Point&& point) {
    const auto patch = static_cast<std::uint32_t>(soup.patch_entity.size());
    soup.patch_entity.push_back(static_cast<std::uint32_t>(soup.entities.size() - 1));
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (std::uint32_t i = 0; i <= columns; ++i) soup.points.push_back(point(double(i) / columns, double(j) / rows));
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t a = first + j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
        soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
        soup.triangle_patch.insert(soup.triangle_patch.end(), {patch, patch});
      }
  }

  std::uint32_t faults_;
};

}  // namespace strataflow::support

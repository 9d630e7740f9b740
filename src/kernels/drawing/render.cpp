#include "kernels/drawing/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "graph/parallel/parallel_map.h"
#include "model/box3.h"

namespace strataflow {

namespace {

constexpr std::uint32_t samples = 2;     ///< per pixel and direction
constexpr std::uint32_t tile_size = 64;  ///< samples; a multiple of `samples`
constexpr double depth_tie = 1e-6;       ///< samples; nearer by less is the same depth
constexpr double edge_half_width = 1.1;  ///< samples, fading out over the outer one
constexpr double edge_darkness = 0.65;
constexpr double line_half_width = 1.7;  ///< samples
constexpr double line_depth_bias = 4;    ///< samples: a line on a surface is in front of it
constexpr Colour line_colour{24, 24, 28};

Vec3 normalized(const Vec3& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Vec3{};
}

/// Turns points into samples: x to the right, y down, z away from the eye, all in one scale.
struct Camera {
  Vec3 right, up, towards_eye, light;
  double exaggeration = 1, scale = 1;
  double offset_x = 0, offset_y = 0;

  Camera(const Scene& scene, const ViewOptions& options) {
    const double azimuth = options.azimuth_deg * std::numbers::pi / 180;
    const double elevation = options.elevation_deg * std::numbers::pi / 180;
    towards_eye = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)};
    right = {-std::sin(azimuth), std::cos(azimuth), 0};
    up = cross(towards_eye, right);
    light = normalized(-0.4 * right + 0.55 * up + 0.75 * towards_eye);
    exaggeration = options.vertical_exaggeration.value_or(automatic_exaggeration(scene));
    Box3 seen;
    const auto take = [&](std::uint32_t point) { seen.take(turned(scene.points[point])); };
    for (const SceneTriangle& triangle : scene.triangles)
      for (const std::uint32_t vertex : triangle.vertices) take(vertex);
    for (const auto& line : scene.lines)
      for (const std::uint32_t vertex : line) take(vertex);
    if (seen.is_empty()) return;
    const double margin = 0.94, width = samples * options.width, height = samples * options.height;
    const Vec3 extent = seen.high - seen.low;
    scale = std::min(margin * width / std::max(extent.x, 1e-300), margin * height / std::max(extent.y, 1e-300));
    if (!std::isfinite(scale)) scale = 1;  // a single point
    offset_x = 0.5 * width - scale * seen.centre().x;
    offset_y = 0.5 * height - scale * seen.centre().y;
  }

  Vec3 stretched(const Vec3& p) const { return {p.x, p.y, exaggeration * p.z}; }
  Vec3 turned(const Vec3& p) const {
    const Vec3 q = stretched(p);
    return {dot(q, right), -dot(q, up), -dot(q, towards_eye)};
  }
  Vec3 sample_position(const Vec3& p) const {
    const Vec3 q = turned(p);
    return {scale * q.x + offset_x, scale * q.y + offset_y, scale * q.z};
  }
};

Colour mixed(const Colour& a, const Colour& b, double share_of_b) {
  const auto mix = [&](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(from + share_of_b * (to - from) + 0.5);
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

/// Value a·x + b·y + c over the samples.
struct LinearForm {
  double a = 0, b = 0, c = 0;
  double at(double x, double y) const { return a * x + b * y + c; }
};

/// A triangle ready to be sampled. `edge[i]` is the distance in samples from the line of edge i, positive inside.
struct ScreenTriangle {
  std::array<LinearForm, 3> edge;
  LinearForm depth;
  double nearest = 0, farthest = 0;
  Colour colour;
  double edge_strength = 0;  ///< 0: edges are not drawn
  std::uint8_t mesh_edges = 0;
  bool is_visible = false;
  std::array<double, 4> box{};  ///< x low, x high, y low, y high
};

ScreenTriangle prepare(const Scene& scene, const SceneTriangle& triangle, const std::vector<Vec3>& positions,
                       const Camera& camera, const ViewOptions& options) {
  ScreenTriangle result;
  const std::array<Vec3, 3> p{positions[triangle.vertices[0]], positions[triangle.vertices[1]],
                              positions[triangle.vertices[2]]};
  const double twice_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (!(std::abs(twice_area) > 1e-9)) return result;  // seen edge-on
  const bool shows_front = twice_area < 0;            // y points down
  if (options.opens_front && triangle.outside != 0 && (triangle.outside > 0) == shows_front) return result;
  result.is_visible = true;

  const double sign = shows_front ? -1 : 1;
  double perimeter = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = p[i], &to = p[(i + 1) % 3];
    const double size = std::hypot(to.x - from.x, to.y - from.y);
    perimeter += size;
    const double dx = sign * (to.x - from.x) / size, dy = sign * (to.y - from.y) / size;
    result.edge[i] = {-dy, dx, from.x * dy - from.y * dx};
  }
  const Vec3 u = p[1] - p[0], v = p[2] - p[0];
  result.depth.a = (u.z * v.y - v.z * u.y) / twice_area;
  result.depth.b = (v.z * u.x - u.z * v.x) / twice_area;
  result.depth.c = p[0].z - result.depth.a * p[0].x - result.depth.b * p[0].y;
  std::tie(result.nearest, result.farthest) = std::minmax({p[0].z, p[1].z, p[2].z});
  std::tie(result.box[0], result.box[1]) = std::minmax({p[0].x, p[1].x, p[2].x});
  std::tie(result.box[2], result.box[3]) = std::minmax({p[0].y, p[1].y, p[2].y});

  const Vec3 a = camera.stretched(scene.points[triangle.vertices[0]]);
  const Vec3 normal = normalized(cross(camera.stretched(scene.points[triangle.vertices[1]]) - a,
                                       camera.stretched(scene.points[triangle.vertices[2]]) - a));
  const double facing = (shows_front ? 1 : -1) * dot(normal, camera.light);
  const Colour base = scene.legend[shows_front ? triangle.front_colour : triangle.back_colour].colour;
  result.colour = mixed(Colour{}, base, 0.55 + 0.45 * std::clamp(facing, 0.0, 1.0));
  if (options.draws_mesh_edges) {
    const double inner_radius = std::abs(twice_area) / perimeter;
    result.edge_strength = edge_darkness * std::clamp((inner_radius - 1) / 4, 0.0, 1.0);
    result.mesh_edges = result.edge_strength > 0 ? triangle.mesh_edges : 0;
  }
  return result;
}

/// Which items (triangles, lines) touch which tile, ascending within each tile.
struct TileLists {
  std::uint32_t columns = 0;
  std::vector<std::uint32_t> begin, items;

  template <class BoxOf>
  TileLists(std::uint32_t tile_columns, std::uint32_t tile_rows, std::size_t count, BoxOf&& box_of)
      : columns(tile_columns), begin(static_cast<std::size_t>(tile_columns) * tile_rows + 1, 0) {
    const auto tile_range = [](double low, double high, std::uint32_t tiles) {
      const auto tile = [&](double at) {
        return static_cast<std::uint32_t>(std::clamp(at / tile_size, 0.0, static_cast<double>(tiles - 1)));
      };
      return std::array{tile(low), tile(high)};
    };
    const auto for_each_tile = [&](std::size_t item, auto&& visit) {
      const auto box = box_of(item);
      if (!box) return;
      const auto [x0, x1] = tile_range((*box)[0], (*box)[1], tile_columns);
      const auto [y0, y1] = tile_range((*box)[2], (*box)[3], tile_rows);
      for (std::uint32_t y = y0; y <= y1; ++y)
        for (std::uint32_t x = x0; x <= x1; ++x) visit(y * tile_columns + x);
    };
    for (std::size_t item = 0; item < count; ++item)
      for_each_tile(item, [&](std::uint32_t tile) { ++begin[tile + 1]; });
    for (std::size_t tile = 1; tile < begin.size(); ++tile) begin[tile] += begin[tile - 1];
    items.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t item = 0; item < count; ++item)
      for_each_tile(item, [&](std::uint32_t tile) { items[next[tile]++] = static_cast<std::uint32_t>(item); });
  }
};

/// The samples of one tile.
class Tile {
 public:
  Tile(std::uint32_t left, std::uint32_t top, Colour background)
      : left_(left),
        top_(top),
        depth_(tile_size * tile_size, std::numeric_limits<double>::infinity()),
        colour_(tile_size * tile_size, background) {}

  void draw(const ScreenTriangle& triangle) {
    const auto [x0, x1] = clipped(triangle.box[0], triangle.box[1], left_);
    const auto [y0, y1] = clipped(triangle.box[2], triangle.box[3], top_);
    for (int j = y0; j < y1; ++j) {
      const double y = top_ + j + 0.5;
      const auto [first, end] = inside_of(triangle, y, x0, x1);
      for (int i = first; i < end; ++i) {
        const double x = left_ + i + 0.5;
        const double depth = std::clamp(triangle.depth.at(x, y), triangle.nearest, triangle.farthest);
        const std::size_t sample = static_cast<std::size_t>(j) * tile_size + i;
        if (!(depth < depth_[sample] - depth_tie)) continue;
        depth_[sample] = depth;
        colour_[sample] = triangle.colour;
        double edge_distance = edge_half_width;
        for (int e = 0; e < 3; ++e)
          if (triangle.mesh_edges >> e & 1) edge_distance = std::min(edge_distance, triangle.edge[e].at(x, y));
        if (edge_distance < edge_half_width)
          colour_[sample] = mixed(triangle.colour, Colour{},
                                  triangle.edge_strength * std::clamp(edge_half_width - edge_distance, 0.0, 1.0));
      }
    }
  }

  void draw_line(const Vec3& from, const Vec3& to) {
    const auto [left, right] = std::minmax({from.x, to.x});
    const auto [top, bottom] = std::minmax({from.y, to.y});
    const auto [x0, x1] = clipped(left - line_half_width, right + line_half_width, left_);
    const auto [y0, y1] = clipped(top - line_half_width, bottom + line_half_width, top_);
    const double dx = to.x - from.x, dy = to.y - from.y, squared = dx * dx + dy * dy;
    for (int j = y0; j < y1; ++j)
      for (int i = x0; i < x1; ++i) {
        const double x = left_ + i + 0.5 - from.x, y = top_ + j + 0.5 - from.y;
        const double along = squared > 0 ? std::clamp((x * dx + y * dy) / squared, 0.0, 1.0) : 0;
        if (std::hypot(x - along * dx, y - along * dy) > line_half_width) continue;
        const std::size_t sample = static_cast<std::size_t>(j) * tile_size + i;
        if (from.z + along * (to.z - from.z) - line_depth_bias < depth_[sample]) colour_[sample] = line_colour;
      }
  }

  /// Averages the samples into the pixels of `image` that this tile covers.
  void resolve(Image& image) const {
    for (std::uint32_t j = 0; j < tile_size; j += samples)
      for (std::uint32_t i = 0; i < tile_size; i += samples) {
        const std::uint32_t x = (left_ + i) / samples, y = (top_ + j) / samples;
        if (x >= image.width || y >= image.height) continue;
        int red = 0, green = 0, blue = 0;
        for (std::uint32_t s = 0; s < samples * samples; ++s) {
          const Colour& c = colour_[(j + s / samples) * tile_size + i + s % samples];
          red += c.red, green += c.green, blue += c.blue;
        }
        constexpr int count = samples * samples;
        std::uint8_t* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)];
        pixel[0] = static_cast<std::uint8_t>((red + count / 2) / count);
        pixel[1] = static_cast<std::uint8_t>((green + count / 2) / count);
        pixel[2] = static_cast<std::uint8_t>((blue + count / 2) / count);
      }
  }

 private:
  /// Samples of the row at height y, of [first, end), that lie in the triangle. The slack leaves no pinholes along
  /// edges that two triangles share.
  std::array<int, 2> inside_of(const ScreenTriangle& triangle, double y, int first, int end) const {
    constexpr double slack = 1e-6;
    double low = left_ + first + 0.5, high = left_ + end - 0.5;
    for (const LinearForm& edge : triangle.edge) {
      const double rest = edge.b * y + edge.c + slack;
      if (edge.a > 0)
        low = std::max(low, -rest / edge.a);
      else if (edge.a < 0)
        high = std::min(high, -rest / edge.a);
      else if (rest < 0)
        return {0, 0};
    }
    if (!(low <= high)) return {0, 0};
    return {static_cast<int>(std::ceil(low - left_ - 0.5)), static_cast<int>(std::floor(high - left_ - 0.5)) + 1};
  }

  /// Samples of this tile between two positions: [first, end).
  static std::array<int, 2> clipped(double low, double high, std::uint32_t origin) {
    return {static_cast<int>(std::clamp(low - origin - 0.5, 0.0, static_cast<double>(tile_size))),
            static_cast<int>(std::clamp(high - origin + 1.5, 0.0, static_cast<double>(tile_size)))};
  }

  std::uint32_t left_, top_;
  std::vector<double> depth_;
  std::vector<Colour> colour_;
};

}  // namespace

double automatic_exaggeration(const Scene& scene) {
  Box3 box;
  for (const SceneTriangle& triangle : scene.triangles)
    for (const std::uint32_t vertex : triangle.vertices) box.take(scene.points[vertex]);
  if (box.is_empty()) return 1;
  const Vec3 extent = box.high - box.low;
  const double wanted = 0.25 * std::max(extent.x, extent.y) / extent.z;
  double factor = 1;
  for (const double step : {2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0})
    if (step <= wanted && extent.z > 0) factor = step;
  return factor;
}

Image render(const Scene& scene, const ViewOptions& options) {
  constexpr std::uint32_t largest = 8192;
  Image image;
  image.width = std::clamp(options.width, 1u, largest);
  image.height = std::clamp(options.height, 1u, largest);
  image.rgb.resize(std::size_t{3} * image.width * image.height);
  ViewOptions view = options;
  view.width = image.width;
  view.height = image.height;

  const Camera camera(scene, view);
  constexpr std::size_t grain = 4096;
  const auto positions = parallel_map(
      scene.points.size(), [&](std::size_t i) { return camera.sample_position(scene.points[i]); }, grain);
  const auto triangles = parallel_map(
      scene.triangles.size(),
      [&](std::size_t i) { return prepare(scene, scene.triangles[i], positions, camera, view); }, grain);

  const std::uint32_t columns = (samples * image.width + tile_size - 1) / tile_size;
  const std::uint32_t rows = (samples * image.height + tile_size - 1) / tile_size;
  const TileLists triangle_tiles(columns, rows, triangles.size(), [&](std::size_t i) {
    return triangles[i].is_visible ? std::optional(triangles[i].box) : std::nullopt;
  });
  const std::size_t line_count = view.draws_lines ? scene.lines.size() : 0;
  const TileLists line_tiles(columns, rows, line_count, [&](std::size_t i) {
    const Vec3 &a = positions[scene.lines[i][0]], &b = positions[scene.lines[i][1]];
    const double w = line_half_width;
    return std::optional(
        std::array{std::min(a.x, b.x) - w, std::max(a.x, b.x) + w, std::min(a.y, b.y) - w, std::max(a.y, b.y) + w});
  });
  parallel_ranges(static_cast<std::size_t>(columns) * rows, 1, [&](std::size_t index, std::size_t) {
    const auto column = static_cast<std::uint32_t>(index % columns), row = static_cast<std::uint32_t>(index / columns);
    Tile tile(column * tile_size, row * tile_size, view.background);
    for (std::uint32_t i = triangle_tiles.begin[index]; i < triangle_tiles.begin[index + 1]; ++i)
      tile.draw(triangles[triangle_tiles.items[i]]);
    for (std::uint32_t i = line_tiles.begin[index]; i < line_tiles.begin[index + 1]; ++i) {
      const auto& line = scene.lines[line_tiles.items[i]];
      tile.draw_line(positions[line[0]], positions[line[1]]);
    }
    tile.resolve(image);
  });
  return image;
}

}  // namespace strataflow

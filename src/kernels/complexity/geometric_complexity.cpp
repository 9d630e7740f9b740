#include "kernels/complexity/geometric_complexity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/parallel/parallel_map.h"
#include "kernels/complexity/principal_axes.h"
#include "kernels/complexity/surface_width.h"

namespace strataflow {

namespace {

/// Part of a whole, both summed up; 0 of nothing is 0.
struct Share {
  double part = 0, whole = 0;
  void add(double amount, bool counts) {
    whole += amount;
    if (counts) part += amount;
  }
  double value() const { return whole > 0 ? std::min(1.0, part / whole) : 0; }
};

double shape_of(double projected, double size) { return size > 0 ? std::clamp(1 - projected / size, 0.0, 1.0) : 0; }

ElementComplexity measure_surface(const StructuralModel& model, std::uint32_t s) {
  const Surface& surface = model.surfaces[s];
  const Vec3& origin = model.points[model.triangles[surface.first_triangle][0]];
  const auto corner = [&](std::uint32_t t, int k) { return model.points[model.triangles[t][k]] - origin; };
  MassMoments moments;
  for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t)
    moments.take_triangle(corner(t, 0), corner(t, 1), corner(t, 2));
  const Vec3 normal = moments.axes().axes[2];
  double projected = 0;
  for (std::uint32_t t = surface.first_triangle; t < surface.end_triangle; ++t)
    projected += 0.5 * std::abs(dot(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)), normal));
  ElementComplexity result{ElementType::surface, s, moments.mass()};
  result.shape = shape_of(projected, moments.mass());
  return result;
}

ElementComplexity measure_line(const StructuralModel& model, std::uint32_t l) {
  const Line& line = model.lines[l];
  const std::size_t count = line.vertices.size(), edges = line.is_closed() ? count : count - 1;
  const Vec3& origin = model.points[line.vertices[0]];
  const auto vertex = [&](std::size_t i) { return model.points[line.vertices[i % count]] - origin; };
  MassMoments moments;
  for (std::size_t i = 0; i < edges; ++i) moments.take_segment(vertex(i), vertex(i + 1));
  const PrincipalAxes axes = moments.axes();
  double projected = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    const Vec3 edge = vertex(i + 1) - vertex(i);
    projected += line.is_closed() ? length(edge - dot(edge, axes.axes[2]) * axes.axes[2])
                                  : std::abs(dot(edge, axes.axes[0]));
  }
  ElementComplexity result{ElementType::line, l, moments.mass()};
  result.shape = shape_of(projected, moments.mass());
  return result;
}

double variation(const std::vector<double>& sizes) {
  if (sizes.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double mean = 0, square = 0;
  for (const double size : sizes) mean += size;
  mean /= static_cast<double>(sizes.size());
  for (const double size : sizes) square += (size - mean) * (size - mean);
  return mean > 0 ? std::sqrt(square / static_cast<double>(sizes.size() - 1)) / mean : 0;
}

}  // namespace

ElementComplexity GeometricComplexity::sum_of(ElementType type) const {
  ElementComplexity sum;
  sum.type = type;
  for (const ElementComplexity& one : elements) {
    if (one.type != type) continue;
    ++sum.element;
    sum.size += one.size;
    sum.too_small += one.too_small;
    sum.shape += one.shape;
    sum.thin += one.thin;
    sum.sharp += one.sharp;
  }
  return sum;
}

double GeometricComplexity::total() const {
  double sum = 0;
  for (const ElementComplexity& one : elements) sum += one.total();
  return sum;
}

GeometricSamples sample_geometry(const StructuralModel& model, const BoxElements& box, double edge_length_m) {
  GeometricSamples samples;
  samples.edges = build_edge_table(model.points.size(), model.triangles);
  samples.thickness = sample_region_thickness(model, box, {0.5 * edge_length_m, edge_length_m});
  samples.wedges = find_contact_wedges(model, samples.edges);
  return samples;
}

GeometricComplexity measure_geometric_complexity(const StructuralModel& model, const BoxElements& box,
                                                 const GeometricSamples& samples, double edge_length_m,
                                                 double angle_deg) {
  const double h = edge_length_m;
  GeometricComplexity result{h, angle_deg, samples.thickness.spacing_m, {}};

  std::vector<Share> thin_regions(model.regions.size()), sharp_regions(model.regions.size());
  for (const ThicknessSample& sample : samples.thickness.samples)
    thin_regions[sample.region].add(sample.area_m2, sample.thickness_m < h);
  for (std::size_t begin = 0; begin < samples.wedges.size();) {
    std::size_t end = begin;  // the wedges around one edge
    while (end < samples.wedges.size() && samples.wedges[end].line == samples.wedges[begin].line &&
           samples.wedges[end].edge == samples.wedges[begin].edge)
      ++end;
    for (std::size_t i = begin; i < end && box.lines[samples.wedges[begin].line] == 0; ++i) {
      const ContactWedge& wedge = samples.wedges[i];
      if (wedge.region == universe) continue;
      bool is_first = true, is_sharp = false;  // a region that touches an edge twice counts its length once
      for (std::size_t j = begin; j < end; ++j) {
        if (samples.wedges[j].region != wedge.region) continue;
        is_first = is_first && j >= i;
        is_sharp = is_sharp || samples.wedges[j].angle_deg < angle_deg;
      }
      if (is_first) sharp_regions[wedge.region].add(wedge.length_m, is_sharp);
    }
    begin = end;
  }
  for (std::uint32_t r = 0; r < model.regions.size(); ++r) {
    ElementComplexity one{ElementType::region, r, model.regions[r].volume_m3};
    one.too_small = one.size <= h * h * h ? 1 : 0;
    one.thin = thin_regions[r].value();
    one.sharp = sharp_regions[r].value();
    result.elements.push_back(one);
  }

  std::vector<Share> narrow(model.surfaces.size()), sharp_corners(model.surfaces.size());
  for (const WidthSample& sample : sample_surface_width(model, box, samples.edges, 0.5 * h, h))
    narrow[sample.surface].add(sample.length_m, sample.width_m < h);
  for (const CornerAngle& corner : find_corner_angles(model, samples.edges))
    sharp_corners[corner.surface].add(1, box.corners[corner.corner] == 0 && corner.angle_deg < angle_deg);
  const auto surfaces = parallel_map(model.surfaces.size(), [&](std::size_t s) {
    ElementComplexity one = measure_surface(model, static_cast<std::uint32_t>(s));
    one.too_small = one.size <= h * h ? 1 : 0;
    one.thin = narrow[s].value();
    one.sharp = sharp_corners[s].value();
    return one;
  });
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    if (box.surfaces[s] == 0) result.elements.push_back(surfaces[s]);
  for (std::uint32_t l = 0; l < model.lines.size(); ++l) {
    if (box.lines[l] != 0) continue;
    ElementComplexity one = measure_line(model, l);
    one.too_small = one.size <= h ? 1 : 0;
    result.elements.push_back(one);
  }
  return result;
}

double SizeVariation::total() const {
  double sum = 0;
  for (const double one : {regions, surfaces, lines})
    if (!std::isnan(one)) sum += one;
  return sum;
}

SizeVariation measure_size_variation(const GeometricComplexity& complexity) {
  const auto of = [&](ElementType type) {
    std::vector<double> sizes;
    for (const ElementComplexity& one : complexity.elements)
      if (one.type == type && !std::isnan(one.size)) sizes.push_back(one.size);
    return variation(sizes);
  };
  return {of(ElementType::region), of(ElementType::surface), of(ElementType::line)};
}

}  // namespace strataflow

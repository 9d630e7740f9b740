#pragma once
#include <string>
#include <vector>

#include "base/warning.h"
#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// A polyline: a well path, a fault stick, an outline. Open unless `is_closed`.
struct Polyline {
  std::string name;
  Role role = Role::curve;
  std::vector<Vec3> points;
  bool is_closed = false;
  template <class A>
  void archive(A& a) {
    a(name, role, points, is_closed);
  }
};

/// Scattered points, with values.
struct PointSet {
  std::string name;
  Role role = Role::points;
  std::vector<Vec3> points;
  std::vector<PointProperty> properties;
  template <class A>
  void archive(A& a) {
    a(name, role, points, properties);
  }
};

/// Everything one file (or one job's inputs together) holds. All coordinates share `surfaces.local_origin`.
struct InputData {
  TriangleSoup surfaces;
  std::vector<Polyline> lines;
  std::vector<PointSet> point_sets;
  VolumeMesh volume;
  std::vector<Warning> warnings;  ///< what the reader could not honour, by name
  template <class A>
  void archive(A& a) {
    a(surfaces, lines, point_sets, volume, warnings);
  }
};

}  // namespace strataflow

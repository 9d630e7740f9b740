#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/vector3.h"

namespace strataflow::support {

/// A file that need not be on disk.
struct TextFile {
  std::string name;
  std::string text;
};

/// A .ml text with its TSurf objects, and its list of them, in another order.
std::string with_shuffled_surfaces(const std::string& gocad, std::uint32_t seed);

/// A GOCAD text in which about half of the TRGL records, chosen at random, name their vertices the other way round.
std::string with_flipped_facets(const std::string& gocad, std::uint32_t seed);

/// The TSurf objects of a .ml text as files of their own; the Model3d is left behind.
std::vector<TextFile> file_per_surface(const std::string& gocad);

/// Every TFACE of a .ml text as a TSurf in a file of its own, without border records.
std::vector<TextFile> file_per_face(const std::string& gocad);

/// A GOCAD or OBJ text with every position moved; all other text stays. Numbers are the file's own (a depth counts
/// down), written in the shortest form that reads back bit for bit.
std::string with_moved_points(const std::string& text, const std::function<Vec3(const Vec3&)>& move);

/// An OBJ text without its objects and groups.
std::string without_groups(const std::string& obj);

/// An OBJ text of vertices and triangles alone, with the vertices, the triangles and the turn of each shuffled.
std::string with_shuffled_triangles(const std::string& obj, std::uint32_t seed);

}  // namespace strataflow::support

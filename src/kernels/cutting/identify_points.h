#pragma once
#include <cstdint>
#include <vector>

#include "model/point_definition.h"
#include "model/vector3.h"

namespace strataflow {

/// The points of a cut: the input's, then the new ones of each call in lexicographic order, each place once.
/// Two definitions get one index exactly when they mean the same place; distinct places that round to the same
/// doubles keep two.
class CutPoints {
 public:
  /// New points are rounded to what survives being moved by `origin` (TriangleSoup::local_origin).
  explicit CutPoints(const std::vector<Vec3>& input, const Vec3& origin = {}) : input_(&input), origin_(origin) {}
  const Vec3& origin() const { return origin_; }

  /// Indices of the points that `definitions` mean. New places are appended, by position. Parallel; the numbering
  /// depends on the sets of definitions only.
  std::vector<std::uint32_t> identify(const std::vector<PointDefinition>& definitions);

  std::uint32_t count() const { return static_cast<std::uint32_t>(input_->size() + added_.size()); }
  const Vec3& position(std::uint32_t id) const {
    return id < input_->size() ? (*input_)[id] : added_[id - input_->size()].position;
  }
  PointDefinition definition(std::uint32_t id) const {
    return id < input_->size() ? vertex_point(id) : added_[id - input_->size()].definition;
  }
  /// Lexicographic order of places, exact where their rounded positions agree: the same however the input is numbered.
  bool before(std::uint32_t a, std::uint32_t b) const;
  const std::vector<Vec3>& input() const { return *input_; }

 private:
  struct Known {
    Vec3 position;
    PointDefinition definition;
    std::uint32_t id;
  };
  const std::vector<Vec3>* input_;
  Vec3 origin_;
  std::vector<Known> added_;  ///< by id
  std::vector<Known> known_;  ///< every place met so far, by position
};

}  // namespace strataflow

#pragma once
#include <set>
#include <string>
#include <vector>

#include "model/structural_model.h"

namespace strataflow::support {

inline std::set<std::string> names_of(const std::vector<Entity>& entities) {
  std::set<std::string> names;
  for (const Entity& entity : entities) names.insert(entity.name);
  return names;
}

/// Names of the entities that still own a surface, alone or with others.
inline std::set<std::string> names_on_surfaces(const StructuralModel& model) {
  std::set<std::string> names;
  for (const Surface& surface : model.surfaces)
    for (const std::uint32_t entity : surface.all_entities) names.insert(model.entities[entity].name);
  return names;
}

}  // namespace strataflow::support

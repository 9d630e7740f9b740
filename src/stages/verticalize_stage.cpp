#include "stages/verticalize_stage.h"

#include "kernels/hexes/plan_lines.h"

namespace strataflow {

Result<UprightModel> Verticalize::operator()(const VolumeMesh& tets, StageContext&) const {
  LayeredSpaceOptions making;
  making.drop_alignment = options.drop_alignment;
  making.follow_horizon_lines = options.follow_horizon_lines;
  making.untangling_steps = options.untangling_steps;
  return make_upright(tets, making);
}

Result<InputData> TakePlanLines::operator()(const UprightModel& upright, const InputData& input,
                                           StageContext& context) const {
  InputData plan;
  plan.surfaces.local_origin = upright.model.local_origin;
  plan.lines = upright.lines;
  // Wells stand where they meet the top.
  const auto add_well = [&](const std::string& well, const Vec3& head) {
    const std::optional<Vec3> place = plan_position(upright.model, upright.plan, head.x, head.y);
    if (place)
      plan.point_sets.push_back({well, Role::well, {*place}, {}});
    else
      context.warn("well_outside", "well " + well + " stands outside the model; no cells are shaped after it");
  };
  for (const Polyline& line : input.lines)
    if (line.role == Role::well && !line.points.empty()) add_well(line.name, line.points.front());
  for (const PointSet& set : input.point_sets)
    if (set.role == Role::well)
      for (std::size_t p = 0; p < set.points.size(); ++p)
        add_well(set.points.size() == 1 ? set.name : set.name + " " + std::to_string(p + 1), set.points[p]);
  return plan;
}

}  // namespace strataflow

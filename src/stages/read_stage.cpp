#include "stages/read_stage.h"

#include <utility>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "io/read_input.h"
#include "kernels/quads/plan/plan_curves.h"
#include "kernels/quads/plan/trace_surfaces.h"

namespace strataflow {

Result<void> rename_input(InputData& data, const ReadOptions& options) {
  if (options.sticks) {
    if (data.lines.empty())
      return Failure{FailureCode::invalid_options, "sticks = true is given to a file without lines",
                     "remove it, or name a file of fault sticks"};
    data.lines = {trace_of_sticks(data.lines)};
  }
  if (options.traces) {
    if (data.surfaces.triangles.empty())
      return Failure{FailureCode::invalid_options, "traces = true is given to a file without surfaces",
                     "remove it, or name a file of faults"};
    std::vector<Polyline> traces = traces_of_surfaces(data.surfaces);
    data.lines.insert(data.lines.end(), traces.begin(), traces.end());
    data.surfaces = {};
    if (options.name)
      for (Polyline& line : data.lines) line.name = *options.name;
  }
  if (options.role) {
    const Role role = role_from(*options.role).value_or(Role::unknown);
    for (Entity& entity : data.surfaces.entities) entity.role = role;
    for (Polyline& line : data.lines) line.role = role;
    for (PointSet& set : data.point_sets) set.role = role;
  }
  if (options.name && !options.traces) {
    const std::size_t things = data.surfaces.entities.size() + data.lines.size() + data.point_sets.size();
    if (things != 1)
      return Failure{FailureCode::invalid_options,
                     "name = \"" + *options.name + "\" is given to a file that holds " + std::to_string(things) +
                         " surfaces, lines and point sets",
                     "remove the name, or keep one of them per file"};
    for (Entity& entity : data.surfaces.entities) entity.name = *options.name;
    for (Polyline& line : data.lines) line.name = *options.name;
    for (PointSet& set : data.point_sets) set.name = *options.name;
  }
  return {};
}

Result<Digest> Read::external_digest() const {
  const Result<std::string> content = read_file(file);
  if (!content) return content.failure();
  ArchiveWriter key;
  const Digest digest = digest_of(*content);
  key(digest.high, digest.low, file.filename().string());
  for (const std::string& text : included_texts(file)) {
    const Digest included = digest_of(text);
    key(included.high, included.low);
  }
  return digest_of(key.bytes());
}

Result<InputData> Read::operator()(StageContext& context) const {
  Result<InputData> data = read_input(file);
  if (!data) return data.failure();
  if (const Result<void> renamed = rename_input(*data, options); !renamed)
    return Failure{renamed.failure().code, file.filename().string() + ": " + renamed.failure().what,
                   renamed.failure().remedy};
  context.warn(std::exchange(data->warnings, {}));
  return data;
}

}  // namespace strataflow

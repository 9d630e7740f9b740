#include "io/surface/read_obj.h"

#include <map>
#include <vector>

#include "io/input/input_builder.h"
#include "io/text/text_scanner.h"

namespace strataflow {

namespace {
const std::string remedy = "correct that line or export the file again";

/// The point of a word such as `7`, `7/1/3` or `-1`, as an index from zero; nothing if there is no such point.
std::optional<std::uint32_t> point_of(std::string_view word, std::size_t point_count) {
  const auto number = TextScanner::integer_from<std::int64_t>(word.substr(0, word.find('/')));
  if (!number) return std::nullopt;
  const std::int64_t count = static_cast<std::int64_t>(point_count);
  const std::int64_t index = *number > 0 ? *number - 1 : *number < 0 && *number >= -count ? count + *number : -1;
  if (index < 0 || index >= count) return std::nullopt;
  return static_cast<std::uint32_t>(index);
}
}  // namespace

Result<InputData> read_obj(std::string_view bytes, const std::string& file_name) {
  TextScanner text(bytes, file_name);
  InputBuilder built(file_name);
  std::string object, group = built.stem();
  std::map<std::string, std::int64_t> group_ids;
  std::uint32_t patch = 0;
  bool group_has_patch = false;  // groups without faces leave no trace
  std::map<std::string, std::size_t> ignored;
  std::vector<std::uint32_t> vertices;
  while (text.next_content_line()) {
    const std::string_view keyword = text.word();
    if (!keyword.empty() && keyword[0] == '#') continue;
    if (keyword == "v") {
      const auto x = text.number(), y = text.number(), z = text.number();
      if (!x || !y || !z) return text.malformed("expected three coordinates", remedy);
      if (!is_finite({*x, *y, *z})) return text.malformed("a coordinate is not a finite number", remedy);
      built.points.push_back({*x, *y, *z});
    } else if (keyword == "f" || keyword == "l") {
      vertices.clear();
      for (std::string_view word = text.word(); !word.empty() && word[0] != '#'; word = text.word()) {
        const auto vertex = point_of(word, built.points.size());
        if (!vertex)
          return text.malformed(
              "'" + shown(word) + "' is none of the " + std::to_string(built.points.size()) + " points above", remedy);
        vertices.push_back(*vertex);
      }
      const bool is_face = keyword == "f";
      if (vertices.size() < (is_face ? 3u : 2u))
        return text.malformed(is_face ? "a face needs three points" : "a line needs two points", remedy);
      if (!is_face) {
        built.add_line(vertices.data(), vertices.size(), group);
        continue;
      }
      if (!group_has_patch) {
        const auto id = group_ids.try_emplace(group, static_cast<std::int64_t>(group_ids.size())).first->second;
        patch = built.patch(id, built.entity(object.empty() ? group : object));
      }
      group_has_patch = true;
      built.add_polygon(vertices.data(), vertices.size(), patch);
    } else if (keyword == "g" || keyword == "o") {
      const std::string_view name = text.rest();
      group = name.empty() ? built.stem() : std::string(name);
      if (keyword == "o") object = name;
      group_has_patch = false;
    } else {
      ++ignored[shown(keyword)];
    }
  }
  if (built.points.empty())
    return Failure{FailureCode::malformed_file,
                   file_name + ": no line starts with 'v': not an OBJ file, or an empty one",
                   "check the file's ending"};
  for (const auto& [keyword, count] : ignored)
    built.warn("ignored_statement", std::to_string(count) + " x '" + keyword + "'");
  return std::move(built).finish();
}

}  // namespace strataflow

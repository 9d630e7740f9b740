#pragma once
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "base/archive.h"
#include "base/seed.h"
#include "io/bytes/input_file.h"
#include "io/input/input_builder.h"
#include "io/input_samples.h"

namespace strataflow::support {

using MeshReader = Result<InputData> (*)(std::string_view, const std::string&);

inline InputData read_whole(MeshReader read, const std::string& bytes, const std::string& name) {
  Result<InputData> input = read(bytes, name);
  EXPECT_TRUE(input) << name << ": " << describe(input.failure());
  return input ? std::move(*input) : InputData{};
}

/// The failure is malformed_file, names the file and says what to do.
inline void expect_malformed(const Result<InputData>& input, const std::string& expected_words,
                             const std::string& name) {
  ASSERT_FALSE(input) << name << " was read, though it should say: " << expected_words;
  EXPECT_EQ(input.failure().code, FailureCode::malformed_file) << describe(input.failure());
  EXPECT_NE(input.failure().what.find(expected_words), std::string::npos) << describe(input.failure());
  EXPECT_EQ(input.failure().what.substr(0, name.size()), name);
  EXPECT_FALSE(input.failure().remedy.empty());
}

inline void expect_sound(const InputData& input) {
  const TriangleSoup& soup = input.surfaces;
  for (const Triangle& triangle : soup.triangles)
    for (const std::uint32_t vertex : triangle) ASSERT_LT(vertex, soup.points.size());
  ASSERT_EQ(soup.triangle_patch.size(), soup.triangles.size());
  for (const std::uint32_t patch : soup.triangle_patch) ASSERT_LT(patch, soup.patch_entity.size());
  for (const std::uint32_t entity : soup.patch_entity) ASSERT_LT(entity, soup.entities.size());
  for (const Vec3& point : soup.points) ASSERT_TRUE(is_finite(point));
  for (const PointProperty& property : soup.properties)
    ASSERT_EQ(property.values.size(), soup.points.size() * property.width);
  for (const Vec3& point : input.volume.points) ASSERT_TRUE(is_finite(point));
  for (const std::uint32_t vertex : input.volume.cell_vertices) ASSERT_LT(vertex, input.volume.points.size());
}

/// Cut at every tenth: a named failure. Formats without an end mark may lose their tail unseen (`may_lose_tail`).
inline void expect_truncation_is_named(MeshReader read, const std::string& bytes, const std::string& name,
                                       bool may_lose_tail = false) {
  for (int tenth = 0; tenth < 10; ++tenth) {
    const Result<InputData> input =
        read(std::string_view(bytes).substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10), name);
    if (input) {
      EXPECT_TRUE(may_lose_tail && tenth > 0) << name << " cut at " << tenth << "/10 was read";
      expect_sound(*input);
      continue;
    }
    EXPECT_EQ(input.failure().code, FailureCode::malformed_file)
        << name << " cut at " << tenth << "/10: " << describe(input.failure());
    EXPECT_NE(input.failure().what.find(name), std::string::npos) << describe(input.failure());
  }
}

/// A thousand damaged versions: each gives a sound value or a failure with words.
inline void expect_damage_is_survived(MeshReader read, const std::string& bytes, const std::string& name) {
  RandomStream random(7);
  for (int round = 0; round < 1000; ++round) {
    std::string damaged = bytes;
    for (int hit = 0; hit < 1 + round % 4; ++hit)
      damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    const Result<InputData> input = read(damaged, name);
    if (input)
      expect_sound(*input);
    else
      EXPECT_FALSE(input.failure().what.empty() || input.failure().remedy.empty());
  }
}

inline std::string with_crlf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << "'" << from << "' is not in the sample";
  if (place != std::string::npos) text.replace(place, from.size(), to);
  return text;
}

}  // namespace strataflow::support

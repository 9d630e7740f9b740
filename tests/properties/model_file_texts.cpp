#include "properties/model_file_texts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "io/text/number_text.h"

namespace strataflow::support {

namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Every line of the text through `edit`, which gives the new line or nothing to drop it.
template <class Edit>
std::string edited(const std::string& text, const Edit& edit) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
    if (edit(line)) result += line + "\n";
  return result;
}

/// The objects of a GOCAD text, from `GOCAD …` to `END`.
std::vector<std::string> objects_of(const std::string& gocad) {
  std::vector<std::string> objects;
  edited(gocad, [&](const std::string& line) {
    if (line.starts_with("GOCAD ")) objects.emplace_back();
    if (!objects.empty()) objects.back() += line + "\n";
    return false;
  });
  return objects;
}

double number_in(const std::string& word) {
  double value = 0;
  if (std::from_chars(word.data(), word.data() + word.size(), value).ptr != word.data() + word.size())
    throw std::invalid_argument("not a number: " + word);
  return value;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

}  // namespace

std::string with_shuffled_surfaces(const std::string& gocad, std::uint32_t seed) {
  std::vector<std::string> objects = objects_of(gocad);
  std::mt19937 random(seed);
  std::shuffle(objects.begin() + 1, objects.end(), random);
  std::vector<std::string> listed;
  edited(objects[0], [&](const std::string& line) {
    if (line.starts_with("TSURF ")) listed.push_back(line);
    return false;
  });
  std::shuffle(listed.begin(), listed.end(), random);
  objects[0] = edited(objects[0], [&](std::string& line) {
    if (line.starts_with("TSURF ")) {
      line = listed.back();
      listed.pop_back();
    }
    return true;
  });
  std::string text;
  for (const std::string& object : objects) text += object;
  return text;
}

std::string with_flipped_facets(const std::string& gocad, std::uint32_t seed) {
  std::mt19937 random(seed);
  return edited(gocad, [&](std::string& line) {
    if (line.starts_with("TRGL ") && random() % 2 == 0) {
      std::vector<std::string> words = words_of(line);
      std::rotate(words.begin() + 1, words.begin() + 1 + random() % 3, words.end());
      std::swap(words[2], words[3]);
      line = joined(words);
    }
    return true;
  });
}

std::vector<TextFile> file_per_surface(const std::string& gocad) {
  std::vector<TextFile> files;
  for (const std::string& object : objects_of(gocad))
    if (object.starts_with("GOCAD TSurf")) files.push_back({"surface_" + std::to_string(files.size()) + ".ts", object});
  return files;
}

std::vector<TextFile> file_per_face(const std::string& gocad) {
  std::vector<TextFile> files;
  for (const TextFile& surface : file_per_surface(gocad)) {
    std::string header;
    std::map<std::string, std::string> position_of;  // of a VRTX or ATOM number
    std::vector<std::vector<std::array<std::string, 3>>> faces;
    edited(surface.text, [&](const std::string& line) {
      const std::vector<std::string> words = words_of(line);
      const std::string& word = words.empty() ? line : words[0];
      if (word == "TFACE")
        faces.emplace_back();
      else if (word == "VRTX" || word == "PVRTX")
        position_of[words[1]] = words[2] + " " + words[3] + " " + words[4];
      else if (word == "ATOM" || word == "PATOM")
        position_of[words[1]] = position_of.at(words[2]);
      else if (word == "TRGL")
        faces.back().push_back({words[1], words[2], words[3]});
      else if (faces.empty() && !word.starts_with("PROP") && word != "ESIZES" && word != "UNITS" &&
               word != "NO_DATA_VALUES")
        header += line + "\n";
      return false;
    });
    for (const auto& face : faces) {
      std::map<std::string, std::size_t> number_of;
      std::string vertices, triangles;
      for (const auto& triangle : face) {
        triangles += "TRGL";
        for (const std::string& vertex : triangle) {
          const auto [place, is_new] = number_of.try_emplace(vertex, number_of.size() + 1);
          if (is_new) vertices += "VRTX " + std::to_string(place->second) + " " + position_of.at(vertex) + "\n";
          triangles += " " + std::to_string(place->second);
        }
        triangles += "\n";
      }
      files.push_back(
          {"face_" + std::to_string(files.size()) + ".ts", header + "TFACE\n" + vertices + triangles + "END\n"});
    }
  }
  return files;
}

std::string with_moved_points(const std::string& text, const std::function<Vec3(const Vec3&)>& move) {
  int key_points = 0;  // a row of a Model3d's TFACE table is followed by three points, each on a line by itself
  return edited(text, [&](std::string& line) {
    const std::vector<std::string> words = words_of(line);
    if (words.size() > 3 && words[0] == "TFACE") {
      key_points = 3;
      return true;
    }
    std::size_t first = 0;
    if (words.size() >= 4 && words[0] == "v")
      first = 1;
    else if (words.size() >= 5 && (words[0] == "VRTX" || words[0] == "PVRTX"))
      first = 2;
    else if (key_points-- <= 0)
      return true;
    const Vec3 moved = move({number_in(words[first]), number_in(words[first + 1]), number_in(words[first + 2])});
    line = first == 0 ? "" : joined({words.begin(), words.begin() + static_cast<std::ptrdiff_t>(first)}) + " ";
    append_point(line, moved);
    for (std::size_t i = first + 3; i < words.size(); ++i) line += " " + words[i];
    return true;
  });
}

std::string without_groups(const std::string& obj) {
  return edited(obj, [](const std::string& line) { return !line.starts_with("o ") && !line.starts_with("g "); });
}

std::string with_shuffled_triangles(const std::string& obj, std::uint32_t seed) {
  std::vector<std::string> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;
  edited(obj, [&](const std::string& line) {
    const std::vector<std::string> words = words_of(line);
    if (!words.empty() && words[0] == "v") vertices.push_back(line);
    if (!words.empty() && words[0] == "f")
      triangles.push_back({std::stoul(words[1]), std::stoul(words[2]), std::stoul(words[3])});
    return false;
  });
  std::mt19937 random(seed);
  std::vector<std::size_t> order(vertices.size()), place(vertices.size() + 1);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  std::string text;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i] + 1] = i + 1;
    text += vertices[order[i]] + "\n";
  }
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (auto& triangle : triangles) {
    std::shuffle(triangle.begin(), triangle.end(), random);
    text += "f";
    for (const std::size_t vertex : triangle) text += " " + std::to_string(place[vertex]);
    text += "\n";
  }
  return text;
}

}  // namespace strataflow::support

// The rules of docs/architecture.md that a compiler does not check: who includes whom, which third-party headers show
// where, which tokens never appear, and that no source goes without a test.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path root = STRATAFLOW_SOURCE_DIR;

struct SourceFile {
  fs::path path;  ///< relative to src/ or tests/
  std::string text;
};

std::vector<SourceFile> files_below(const fs::path& folder) {
  std::vector<SourceFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    files.push_back({fs::relative(entry.path(), folder), text.str()});
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

const std::vector<SourceFile>& sources() {
  static const std::vector<SourceFile> files = files_below(root / "src");
  return files;
}

/// base, model, io, graph/parallel, graph, kernels, stages or batch.
std::string layer_of(const std::string& path) {
  if (path.rfind("graph/parallel/", 0) == 0) return "graph/parallel";
  return path.substr(0, path.find('/'));
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

TEST(Architecture, layers_include_only_the_layers_below_them) {
  const std::map<std::string, std::set<std::string>> allowed{
      {"base", {"base"}},
      {"model", {"model", "base"}},
      {"io", {"io", "base", "model"}},
      {"graph/parallel", {"graph/parallel", "base"}},
      {"graph", {"graph", "graph/parallel", "base"}},
      {"kernels", {"kernels", "base", "model", "graph/parallel"}},
      {"stages", {"stages", "base", "model", "io", "kernels", "graph"}},
      {"batch", {"batch", "stages", "base", "model", "io", "kernels", "graph", "graph/parallel"}}};
  const std::regex include("#include \"([^\"]+)\"");
  for (const SourceFile& file : sources()) {
    const std::string layer = layer_of(file.path.generic_string());
    ASSERT_TRUE(allowed.count(layer)) << file.path << " belongs to no layer";
    for (const std::string& header : matches(file.text, include)) {
      EXPECT_NE(header.find('/'), std::string::npos) << file.path << " includes " << header << ": write the path from src/";
      EXPECT_TRUE(allowed.at(layer).count(layer_of(header))) << file.path << " must not include " << header;
    }
  }
}

TEST(Architecture, third_party_headers_show_only_in_their_rooms) {
  struct Room {
    const char* header;
    const char* where;
  };
  const std::vector<Room> rooms{{"CGAL/", "kernels/adapters/cgal/[^/]*\\.cpp"},
                                {"spdlog", "base/log\\.cpp"},
                                {"tetgen", "kernels/adapters/tetgen/[^/]*\\.cpp"},
                                {"OpenMesh/", "kernels/adapters/openmesh/[^/]*\\.cpp"},
                                {"Eigen/", "kernels/adapters/sparse/[^/]*\\.cpp"},
                                {"cholmod", "kernels/adapters/sparse/[^/]*\\.cpp"},
                                {"oneapi/tbb", "graph/(parallel|executors)/.*"},
                                {"tbb/", "graph/(parallel|executors)/.*"},
                                {"xxhash", "base/digest\\.cpp"},
                                {"pugixml", "io/.*\\.cpp"},
                                {"zlib", "io/.*\\.cpp"},
                                {"toml", "batch/job_file/job_file\\.cpp"},
                                {"nlohmann", "batch/(.*\\.cpp|report/[a-z]+_json\\.h)"},
                                {"CLI/", "nowhere in src"}};
  const std::regex include("#include <([^>]+)>");
  for (const SourceFile& file : sources())
    for (const std::string& header : matches(file.text, include))
      for (const Room& room : rooms)
        if (header.rfind(room.header, 0) == 0) {
          EXPECT_TRUE(std::regex_match(file.path.generic_string(), std::regex(room.where)))
              << file.path << " includes " << header << ", which belongs to " << room.where;
        }
}

TEST(Architecture, tokens_that_break_determinism_or_manners_do_not_appear) {
  const std::vector<std::string> banned{"parallel_reduce(", "static_partitioner", "get_default_random", "random_device",
                                        "thread_local",     "#pragma omp",        "std::cout",          " abort(",
                                        "std::rand",        "system_clock::now"};
  for (const SourceFile& file : sources())
    for (const std::string& token : banned)
      EXPECT_EQ(file.text.find(token), std::string::npos) << file.path << " holds \"" << token << "\"";
}

TEST(Architecture, threads_are_made_in_one_place) {
  const std::regex threads("std::(thread|jthread|async)\\b");
  for (const SourceFile& file : sources()) {
    const std::string path = file.path.generic_string();
    if (path.rfind("graph/", 0) == 0) continue;
    EXPECT_FALSE(std::regex_search(file.text, threads)) << path << " makes threads of its own";
  }
}

TEST(Architecture, every_source_has_a_test_that_includes_its_header) {
  std::set<std::string> tested;
  const std::regex include("#include \"([^\"]+)\"");
  for (const SourceFile& file : files_below(root / "tests"))
    for (const std::string& header : matches(file.text, include)) tested.insert(header);
  for (const SourceFile& file : sources()) {
    if (file.path.extension() != ".cpp") continue;
    fs::path header = file.path;
    header.replace_extension(".h");
    if (!fs::exists(root / "src" / header)) continue;
    EXPECT_TRUE(tested.count(header.generic_string())) << file.path << " has no test: include its header in one";
  }
}

TEST(Architecture, no_file_is_too_long_to_read) {
  for (const SourceFile& file : sources())
    EXPECT_LE(std::count(file.text.begin(), file.text.end(), '\n'), 700) << file.path << " is past 700 lines: split it";
}

}  // namespace

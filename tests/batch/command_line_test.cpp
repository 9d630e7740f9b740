#include "support/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace strataflow {
namespace {

namespace fs = std::filesystem;
using support::CommandOutcome;
using support::read_text;
using support::strataflow;
using support::write_text;
using testing::HasSubstr;

class CommandLine : public testing::Test {
 protected:
  fs::path file(const std::string& name) const { return scratch_.path() / name; }
  std::string job(const std::string& name, const std::string& text) {
    write_text(file(name), text);
    return file(name).string();
  }
  /// A sealed model of a few triangles.
  std::string cube() {
    const std::string path = file("A1.ml").string();
    EXPECT_EQ(strataflow({"generate", "A1", "--resolution", "110", "--out", path}).exit_code, 0);
    return path;
  }
  static inline const std::string model =
      "[[input]]\nmodel = \"A1\"\nresolution_m = 110.0\n[output]\nproducts = [\"model\"]\n";
  support::ScratchFolder scratch_;
};

TEST_F(CommandLine, tells_its_version_and_every_librarys) {
  const CommandOutcome outcome = strataflow({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* name : {"strataflow 0.", "oneTBB 2", "CGAL 5", "TetGen 1", "spdlog 1", "zlib 1", "toml++ 3", "CLI11 2",
                           "xxHash 0", "pugixml 1", "nlohmann-json 3"})
    EXPECT_THAT(outcome.out, HasSubstr(name));
}

TEST_F(CommandLine, helps_on_every_command) {
  for (const char* command : {"run", "check", "graph", "stages", "quality", "diff", "convert", "generate"}) {
    const CommandOutcome outcome = strataflow({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0) << command;
    EXPECT_THAT(outcome.out, HasSubstr("Usage"));
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(CommandLine, exits_2_on_wrong_usage) {
  const std::string good = job("a.toml", model);
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"rum"},
                                                       {"check"},
                                                       {"convert", "a.ts", "b.m"},
                                                       {"run"},
                                                       {"run", file("none.toml").string()},
                                                       {"run", scratch_.path().string()},
                                                       {"run", good, "--executor", "fast"},
                                                       {"run", good, "--executor", "shuffled:x"},
                                                       {"run", good, "--threads", "-1"},
                                                       {"run", good, "--set", "nonsense"},
                                                       {"run", good, "--stop-after", "nothing"},
                                                       {"run", good, "--out", "/dev/null"},
                                                       {"run", good, "--cache", "x", "--no-cache"},
                                                       {"graph", good, "--format", "png"},
                                                       {"stages", "--json", "--markdown"},
                                                       {"convert", "a.ts", "b.doc"},
                                                       {"generate", "Z9"}};
  for (const std::vector<std::string>& arguments : wrong) {
    const CommandOutcome outcome = strataflow(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments) << outcome.err;
    EXPECT_FALSE(outcome.err.empty());
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(CommandLine, exits_1_on_bad_input_and_touches_nothing) {
  write_text(file("empty.ml"), "");
  write_text(
      file("nan.ts"),
      "GOCAD TSurf 1\nHEADER {\nname: x\n}\nTFACE\nVRTX 1 0 0 nan\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n");
  write_text(file("range.ts"), "GOCAD TSurf 1\nHEADER {\nname: x\n}\nTFACE\nVRTX 1 0 0 0\nTRGL 1 2 3\nEND\n");
  write_text(file("other.ml"), "this is no model\n");
  for (const char* name : {"empty.ml", "nan.ts", "range.ts", "other.ml"}) {
    write_text(file("out/a/report.json"), "old");
    const CommandOutcome run = strataflow(
        {"run", job("a.toml", "[[input]]\nfile = \"" + std::string(name) + "\"\n[output]\nproducts = [\"model\"]\n")});
    EXPECT_EQ(run.exit_code, 1) << name;
    EXPECT_THAT(run.err, HasSubstr(name));
    EXPECT_THAT(run.err, HasSubstr("what to do: "));
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(read_text(file("out/a/report.json")), "old");
    const CommandOutcome check = strataflow({"check", file(name).string()});
    EXPECT_EQ(check.exit_code, 1) << name;
    EXPECT_THAT(check.err, HasSubstr(name));
  }
  EXPECT_EQ(strataflow({"check", file("none.ml").string()}).exit_code, 1);
  EXPECT_EQ(strataflow({"check", scratch_.path().string()}).exit_code, 1);
  EXPECT_EQ(strataflow({"quality", file("none.vtu").string()}).exit_code, 1);
  EXPECT_EQ(strataflow({"diff", scratch_.path().string(), scratch_.path().string()}).exit_code, 1);
}

TEST_F(CommandLine, prints_the_run_folder_and_nothing_else_to_standard_output) {
  const CommandOutcome outcome = strataflow({"run", job("a.toml", model), "--progress", "plain"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, file("out/a").string() + "\n");
  EXPECT_THAT(outcome.err, HasSubstr("build_model: "));
  const CommandOutcome quiet = strataflow({"run", job("a.toml", model), "--quiet"});
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CommandLine, survives_a_reader_that_goes_away) {
  const CommandOutcome outcome = strataflow({"stages"}, "| true");
  EXPECT_EQ(outcome.exit_code, 0);  // of `true`; the program must not have left a crash message
  EXPECT_EQ(outcome.err, "");
}

TEST_F(CommandLine, checks_a_valid_model) {
  const std::string path = cube();
  const CommandOutcome text = strataflow({"check", path});
  EXPECT_EQ(text.exit_code, 0) << text.out << text.err;
  EXPECT_THAT(text.out, HasSubstr("4 regions"));
  const CommandOutcome json = strataflow({"check", path, "--json"});
  EXPECT_EQ(json.exit_code, 0);
  const nlohmann::json block = nlohmann::json::parse(json.out);
  EXPECT_EQ(block["regions"], 4);
  EXPECT_EQ(block["sealed"], true);
}

TEST_F(CommandLine, names_the_violations_of_an_invalid_model) {
  const std::string path = file("raw.ts").string();
  ASSERT_EQ(strataflow({"generate", "A2", "--resolution", "110", "--raw", "-0.05", "--out", path}).exit_code, 0);
  const CommandOutcome outcome = strataflow({"check", path});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("error: "));
  EXPECT_THAT(outcome.out, HasSubstr("intersection"));
  EXPECT_THAT(outcome.out, HasSubstr("what to do: "));
  EXPECT_THAT(outcome.out, HasSubstr("not valid"));
}

TEST_F(CommandLine, takes_several_files_as_one_model) {
  const std::string lid =
      "GOCAD TSurf 1\nHEADER {\nname: lid\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
  const std::string rest =
      "GOCAD TSurf 1\nHEADER {\nname: rest\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nVRTX 4 0 0 -1\n"
      "TRGL 1 2 4\nTRGL 2 3 4\nTRGL 3 1 4\nEND\n";
  write_text(file("lid.ts"), lid);
  write_text(file("rest.ts"), rest);
  EXPECT_EQ(strataflow({"check", file("lid.ts").string()}).exit_code, 1);
  const CommandOutcome both = strataflow({"check", file("lid.ts").string(), file("rest.ts").string(), "--json"});
  EXPECT_EQ(both.exit_code, 0) << both.out;
  EXPECT_EQ(nlohmann::json::parse(both.out)["regions"], 1);
}

TEST_F(CommandLine, repairs_into_a_file_that_is_valid) {
  const std::string path = cube(), repaired = file("repaired.ml").string();
  const CommandOutcome outcome = strataflow({"check", path, "--repair", repaired});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("wrote " + repaired));
  EXPECT_EQ(strataflow({"check", repaired}).exit_code, 0);
  EXPECT_EQ(strataflow({"check", path, "--repair", file("x.doc").string()}).exit_code, 2);
}

TEST_F(CommandLine, draws_the_graph_without_running_it) {
  const std::string good = job("a.toml", model);
  EXPECT_THAT(strataflow({"graph", good}).out, HasSubstr("digraph"));
  EXPECT_THAT(strataflow({"graph", good, "--format", "mermaid"}).out, HasSubstr("flowchart"));
  EXPECT_TRUE(nlohmann::json::parse(strataflow({"graph", good, "--format", "json"}).out).contains("nodes"));
  EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(CommandLine, names_the_first_stage_in_which_two_runs_differ) {
  const std::string a = job("a.toml", model);
  ASSERT_EQ(strataflow({"run", a}).exit_code, 0);
  ASSERT_EQ(strataflow({"run", a, "--out", file("same").string()}).exit_code, 0);
  EXPECT_EQ(strataflow({"diff", file("out/a").string(), file("same").string()}).exit_code, 0);
  ASSERT_EQ(
      strataflow(
          {"run", job("b.toml", "[[input]]\nmodel = \"A1\"\nresolution_m = 100.0\n[output]\nproducts = [\"model\"]\n")})
          .exit_code,
      0);
  const CommandOutcome outcome = strataflow({"diff", file("out/a").string(), file("out/b").string()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("first difference: generate/A1"));
}

TEST_F(CommandLine, converts_and_measures) {
  const std::string path = cube(), obj = file("cube.obj").string();
  ASSERT_EQ(strataflow({"convert", path, obj}).exit_code, 0);
  EXPECT_THAT(read_text(obj), HasSubstr("\nf "));
  const CommandOutcome outcome = strataflow({"quality", obj, "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_GT(json["cells"]["triangles"].get<int>(), 100);
  EXPECT_EQ(json["file"], obj);
  EXPECT_TRUE(nlohmann::json::parse(strataflow({"quality", obj, path, "--json"}).out).is_array());
  const CommandOutcome none = strataflow({"convert", path, file("cube.vtu").string()});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("holds nothing"));
}

TEST_F(CommandLine, names_an_unknown_command) {
  const CommandOutcome outcome = strataflow({"rum", "a.toml"});
  EXPECT_THAT(outcome.err, HasSubstr("unknown command 'rum'"));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'run'?"));
}

TEST_F(CommandLine, names_the_file_that_cannot_be_a_model) {
  const std::string mesh = file("mesh.vtu").string();
  ASSERT_EQ(strataflow({"run", job("a.toml",
                                   "[[input]]\nmodel = \"A1\"\nresolution_m = 110.0\n[output]\n"
                                   "products = [\"tets\"]\nformats = [\"gocad\"]\n")})
                .exit_code,
            0);
  const CommandOutcome check = strataflow({"check", file("out/a/tets.vtu").string()});
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_THAT(check.err, HasSubstr("tets.vtu: the input holds no triangle"));
  EXPECT_THAT(check.err, HasSubstr("strataflow quality"));
  ASSERT_EQ(strataflow({"convert", file("out/a/tets.so").string(), mesh}).exit_code, 0);
  const auto cells = [](const std::string& path) {
    return nlohmann::json::parse(strataflow({"quality", path, "--json"}).out)["cells"]["tetrahedra"].get<int>();
  };
  EXPECT_EQ(cells(mesh), cells(file("out/a/tets.vtu").string()));
}

TEST_F(CommandLine, keeps_a_model_in_a_native_file) {
  const std::string path = cube(), native = file("A1.sfm").string(), back = file("back.ml").string();
  ASSERT_EQ(strataflow({"convert", path, native}).exit_code, 0);
  const std::string expected = strataflow({"check", path, "--json"}).out;
  EXPECT_EQ(strataflow({"check", native, "--json"}).out, expected);
  ASSERT_EQ(strataflow({"convert", native, back}).exit_code, 0);
  EXPECT_EQ(strataflow({"check", back, "--json"}).out, expected);
  ASSERT_EQ(strataflow({"check", path, "--repair", native}).exit_code, 0);
  EXPECT_EQ(strataflow({"check", native}).exit_code, 0);
  EXPECT_EQ(
      strataflow({"run", job("n.toml", "[[input]]\nfile = \"A1.sfm\"\n[output]\nproducts = [\"model\"]\n")}).exit_code,
      0);
  std::string damaged = read_text(native);
  damaged[damaged.size() - 9] ^= 1;
  write_text(file("damaged.sfm"), damaged);
  const CommandOutcome outcome = strataflow({"check", file("damaged.sfm").string()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("checksum"));
  write_text(file("damaged.sfm"), "no model");
  EXPECT_EQ(strataflow({"check", file("damaged.sfm").string()}).exit_code, 1);
}

TEST_F(CommandLine, says_what_a_conversion_leaves_out) {
  write_text(file("both.gocad"),
             "GOCAD TSurf 1\nHEADER {\nname: x\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n"
             "GOCAD PLine 1\nHEADER {\nname: w\n}\nILINE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nSEG 1 2\nEND\n");
  const CommandOutcome outcome = strataflow({"convert", file("both.gocad").string(), file("a.obj").string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("does not hold 1 lines"));
}

TEST_F(CommandLine, keeps_the_store_where_it_is_told) {
  const std::string a = job("a.toml", model);
  ASSERT_EQ(strataflow({"run", a, "--cache", file("store").string()}).exit_code, 0);
  EXPECT_TRUE(fs::exists(file("store")));
  const CommandOutcome again = strataflow({"run", a, "--cache", file("store").string(), "--progress", "plain"});
  EXPECT_THAT(again.err, HasSubstr("build_model: from the store"));
  ASSERT_EQ(strataflow({"run", a, "--cache", "/dev/null/store"}).exit_code, 1);
}

TEST_F(CommandLine, says_on_the_screen_and_in_the_log_what_could_not_be_stored) {
  const std::string a = job("a.toml", model);
  for (int first = 0; first < 256; ++first) {  // files where the store wants folders
    std::array<char, 3> name{};
    std::snprintf(name.data(), name.size(), "%02x", static_cast<unsigned>(first));
    write_text(file("store") / name.data(), "in the way");
  }
  const CommandOutcome outcome = strataflow({"run", a, "--cache", file("store").string()});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("a: build_model: not_stored: "));
  EXPECT_THAT(read_text(file("out") / "a" / "log.txt"), HasSubstr("    warning: not_stored: "));
}

TEST_F(CommandLine, exits_1_when_its_result_is_lost) {
  const CommandOutcome outcome = strataflow({"stages"}, ">/dev/full");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("standard output: No space left on device"));
}

}  // namespace
}  // namespace strataflow

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "batch/job_file/job.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

/// A folder with one input file, as a job file would find it.
class JobFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_ / "sub");
    std::ofstream(folder_ / "cube.ml") << "GOCAD Model3d 1\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Result<std::vector<Job>> read(const std::string& text, const std::vector<std::string>& settings = {}) const {
    return read_jobs_from_text(text, "job.toml", folder_, settings);
  }
  std::filesystem::path folder_;
};

const std::string valid = R"([[input]]
file = "cube.ml"
[output]
products = ["model", "tets"]
)";

TEST_F(JobFile, with_one_input_and_products_is_enough_and_the_rest_has_defaults) {
  const auto jobs = read(valid);
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  ASSERT_EQ(jobs->size(), 1u);
  const Job& job = jobs->front();
  EXPECT_EQ(job.header.name, "job");
  EXPECT_EQ(job.header.seed, 1);
  EXPECT_TRUE(job.makes("tets"));
  EXPECT_FALSE(job.makes("hexes"));
  EXPECT_TRUE(job.writes("vtk"));
  EXPECT_EQ(job.cut.judge.mode, "auto");
  EXPECT_EQ(job.input_path(job.inputs[0]), folder_ / "cube.ml");
}

TEST_F(JobFile, keeps_the_order_of_its_inputs) {
  const auto jobs = read(
      "[[input]]\nmodel = \"B\"\n[[input]]\nfile = \"cube.ml\"\nname = \"F1\"\nrole = \"fault\"\n"
      "[output]\nproducts = [\"model\"]\n");
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  ASSERT_EQ(jobs->front().inputs.size(), 2u);
  EXPECT_EQ(jobs->front().inputs[0].model, "B");
  EXPECT_EQ(jobs->front().inputs[1].name, "F1");
}

TEST_F(JobFile, cuts_and_seals_as_told) {
  const auto jobs = read(valid +
                         "[cut]\nmode = \"always\"\ncut = [\"H1\"]\ntolerance_m = 0.01\nremove_scars = true\n"
                         "[seal]\ndistance_m = 3.0\ncontacts = [\"H1 -> F1 within 60\"]\nfacing_deg = 7.0\n"
                         "[simplify]\nborders = true\n");
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  const Job& job = jobs->front();
  EXPECT_EQ(job.cut.judge.mode, "always");
  EXPECT_EQ(job.cut.cut.cut, std::vector<std::string>{"H1"});
  EXPECT_EQ(job.cut.cut.tolerance_m, 0.01);
  EXPECT_TRUE(job.cut.scars.remove_scars);
  EXPECT_TRUE(job.simplify.borders);
  EXPECT_EQ(job.seal.seal.distance_m, 3.0);
  const CutConstrainedOptions contacts = job.seal.contacts();  // shared by two stages
  EXPECT_EQ(contacts.distance_m, 3.0);
  EXPECT_EQ(contacts.contacts, job.seal.seal.contacts);
  EXPECT_EQ(contacts.facing_deg, 7.0);
}

struct BadJob {
  std::string name;
  std::string text;
  std::string what;    ///< part of the message
  std::string remedy;  ///< part of the message
};

class BadJobFile : public JobFile, public testing::WithParamInterface<BadJob> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("bad_job_" + GetParam().name);
    std::filesystem::create_directories(folder_ / "sub");
    std::ofstream(folder_ / "cube.ml") << "GOCAD Model3d 1\n";
  }
};

TEST_P(BadJobFile, is_refused_with_the_line_and_a_remedy) {
  const auto jobs = read(GetParam().text);
  ASSERT_FALSE(jobs);
  const Failure& failure = jobs.failure();
  EXPECT_TRUE(failure.code == FailureCode::invalid_options || failure.code == FailureCode::invalid_usage);
  EXPECT_THAT(failure.what, HasSubstr(GetParam().what));
  EXPECT_THAT(failure.remedy, HasSubstr(GetParam().remedy));
  EXPECT_FALSE(failure.remedy.empty());
}

std::string with_input(const std::string& rest) { return "[[input]]\nfile = \"cube.ml\"\n" + rest; }
std::string with_products(const std::string& rest) { return with_input("[output]\nproducts = [\"model\"]\n" + rest); }

INSTANTIATE_TEST_SUITE_P(
    Table, BadJobFile,
    testing::Values(
        BadJob{"empty", "", "job.toml: the job has no [[input]]", "[[input]]"},
        BadJob{"broken_syntax", "[job\n", "job.toml:1: ", "TOML"},
        BadJob{"duplicate_key", with_products("products = [\"tets\"]\n"), "job.toml:5: ", "TOML"},
        BadJob{"duplicate_section", with_products("[output]\n"), "job.toml:5: ", "TOML"},
        BadJob{"date", with_products("[job]\nname = 2024-01-01\n"), "job.toml:6: no option takes a date", "number"},
        BadJob{"unknown_section", with_products("[cutt]\n"), "job.toml:5: unknown section [cutt]",
               "did you mean 'cut'?"},
        BadJob{"unknown_key", with_products("[cut]\nmod = \"auto\"\n"), "job.toml:6: unknown key 'mod' in [cut]",
               "did you mean 'mode'?"},
        BadJob{"unknown_top_key", "products = []\n" + with_products(""), "job.toml:1: unknown key 'products'",
               "known: job"},
        BadJob{"unknown_word", with_products("[cut]\nmode = \"nver\"\n"), "job.toml:6: cut.mode: unknown word \"nver\"",
               "did you mean 'never'?"},
        BadJob{"wrong_type", with_products("[job]\nseed = \"one\"\n"),
               "job.toml:6: job.seed must be a whole number, but \"one\" is a text", "Seed"},
        BadJob{"fraction_for_whole", with_products("[job]\nseed = 1.5\n"),
               "job.toml:6: job.seed must be a whole number", "Seed"},
        BadJob{"negative_seed", with_products("[job]\nseed = -1\n"), "job.toml:6: job.seed = -1 must be ≥ 0", "Seed"},
        BadJob{"not_a_number", "[[input]]\nmodel = \"A1\"\nresolution_m = nan\n[output]\nproducts = [\"model\"]\n",
               "job.toml:3: input.resolution_m = nan must be > 0", "edges"},
        BadJob{"infinite", "[[input]]\nmodel = \"A1\"\nresolution_m = inf\n[output]\nproducts = [\"model\"]\n",
               "job.toml:3: input.resolution_m = inf", "edges"},
        BadJob{"zero_length", "[[input]]\nmodel = \"A1\"\nresolution_m = 0\n[output]\nproducts = [\"model\"]\n",
               "job.toml:3: input.resolution_m = 0 must be > 0", "edges"},
        BadJob{"section_as_value", with_input("cut = 3\n[output]\nproducts = [\"model\"]\n"),
               "job.toml:3: unknown key 'cut' in [input]", "known"},
        BadJob{"job_as_value", "job = 3\n" + with_products(""), "job.toml:1: 'job' must be a table", "[job]"},
        BadJob{"no_input", "[output]\nproducts = [\"model\"]\n", "the job has no [[input]]", "file ="},
        BadJob{"input_as_table", "[input]\nfile = \"cube.ml\"\n[output]\nproducts = [\"model\"]\n",
               "job.toml:1: the job has no [[input]]", "[[input]]"},
        BadJob{"input_without_source", "[[input]]\nname = \"F\"\n[output]\nproducts = [\"model\"]\n",
               "job.toml:1: an input needs 'file' or 'model'", "file ="},
        BadJob{"input_with_both", with_input("model = \"A1\"\n[output]\nproducts = [\"model\"]\n"),
               "job.toml:1: an input has either 'file' or 'model', not both", "file ="},
        BadJob{"resolution_of_file", with_input("resolution_m = 5\n[output]\nproducts = [\"model\"]\n"),
               "job.toml:1: resolution_m and raw_ratio are for reference models", "remove"},
        BadJob{"missing_file", "[[input]]\nfile = \"tube.ml\"\n[output]\nproducts = [\"model\"]\n",
               "job.toml:1: input file 'tube.ml' does not exist", "relative paths start at"},
        BadJob{"folder_as_file", "[[input]]\nfile = \"sub\"\n[output]\nproducts = [\"model\"]\n",
               "job.toml:1: input file 'sub' is a folder", "file"},
        BadJob{"unknown_role", with_input("role = \"falt\"\n[output]\nproducts = [\"model\"]\n"),
               "job.toml:3: input.role: unknown word \"falt\"", "did you mean 'fault'?"},
        BadJob{"no_products", with_input("[output]\nproducts = []\n"), "job.toml:4: output.products is empty",
               "products ="},
        BadJob{"products_missing", with_input(""), "output.products is empty", "products ="},
        BadJob{"product_twice", with_input("[output]\nproducts = [\"tets\", \"tets\"]\n"),
               "job.toml:4: product 'tets' is named twice", "once"},
        BadJob{"unknown_product", with_input("[output]\nproducts = [\"tet\"]\n"),
               "job.toml:4: output.products: unknown word \"tet\"", "did you mean 'tets'?"},
        BadJob{"grdecl_without_hexes", with_products("formats = [\"grdecl\"]\n"),
               "job.toml:5: format 'grdecl' is for the product 'hexes'", "remove"},
        BadJob{"resolution_that_preserves_all",
               with_input("[output]\nproducts = [\"surfaces\"]\n[remesh]\nd_resolution_m = 5.0\n"),
               "job.toml:6: d_resolution_m merges what preserve = \"all\" is to keep", "remove one"},
        BadJob{"density_without_property", with_products("[remesh]\ndensity = \"property\"\n"),
               "job.toml:6: density = \"property\" and density_property come together", "density_property"},
        BadJob{"negative_distance", with_products("[seal]\ndistance_m = -1.0\n"),
               "job.toml:6: seal.distance_m = -1.0 must be ≥ 0", "Gaps"},
        BadJob{"unknown_leak_word", with_products("[seal]\non_leak = \"wran\"\n"),
               "job.toml:6: seal.on_leak: unknown word \"wran\"", "did you mean 'warn'?"},
        BadJob{"contacts_as_text", with_products("[seal]\ncontacts = \"H1 -> F1\"\n"),
               "job.toml:6: seal.contacts must be", "Contacts"},
        BadJob{"name_with_slash", with_products("[job]\nname = \"a/b\"\n"),
               "job.toml:6: job.name \"a/b\" cannot name a folder", "letters"},
        BadJob{"control_characters", with_input("name = \"a\\nb\"\n[output]\nproducts = [\"model\"]\n"),
               "job.toml:3: input.name holds control characters", "remove"},
        BadJob{"unknown_model", "[[input]]\nmodel = \"A7\"\n[output]\nproducts = [\"model\"]\n",
               "job.toml:1: unknown reference model 'A7'", "A1"},
        BadJob{"role_of_model", "[[input]]\nmodel = \"A1\"\nrole = \"fault\"\n[output]\nproducts = [\"model\"]\n",
               "job.toml:1: name, role, sticks and traces are for files", "remove"},
        BadJob{"surfaces_format_without_model", with_input("[output]\nproducts = [\"tets\"]\nformats = [\"obj\"]\n"),
               "job.toml:5: format 'obj' is for the products 'model' and 'surfaces'", "remove"},
        BadJob{"sites_and_edge_length", with_products("[remesh]\nsites = 5\ntarget_edge_length_m = 3.0\n"),
               "job.toml:6: [remesh] has both sites and target_edge_length_m", "keep one"},
        BadJob{"name_of_parent", with_products("[job]\nname = \"..\"\n"),
               "job.toml:6: job.name \"..\" cannot name a folder", "letters"},
        BadJob{"empty_sweep", with_products("[sweep]\n\"job.seed\" = []\n"),
               "job.toml:6: sweep of 'job.seed' must be a list", "for instance"},
        BadJob{"sweep_of_value", with_products("[sweep]\n\"job.seed\" = 3\n"),
               "job.toml:6: sweep of 'job.seed' must be a list", "for instance"},
        BadJob{"sweep_of_input", with_products("[sweep]\n\"input.file\" = [\"a\"]\n"),
               "job.toml:6: 'input.file' cannot be swept", "for instance"},
        BadJob{"bad_value_in_sweep", with_products("[sweep]\n\"job.seed\" = [1, -2]\n"),
               "job.toml:6: job.seed = -2 must be ≥ 0", "Seed"},
        BadJob{"unknown_key_in_sweep", with_products("[sweep]\n\"cut.mde\" = [\"auto\"]\n"),
               "job.toml:6: unknown key 'mde' in [cut]", "mode"}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(JobFile, says_how_many_sites_lie_inside_hybrid_meshes) {
  const auto with = [&](const std::string& lines) {
    return read("[[input]]\nmodel = \"slab\"\n[output]\nproducts = [\"hybrid\"]\n[hybrid]\n" + lines);
  };
  EXPECT_FALSE(with("sites = 60\n")->front().hybrid.interior_sites);  // as many as the surfaces ask for
  EXPECT_EQ(with("interior_sites = 0\n")->front().hybrid.interior_sites, 0);
  EXPECT_EQ(with("interior_sites = 250\n")->front().hybrid.interior_sites, 250);
  for (const char* line : {"interior_sites = -1\n", "interior_sites = \"many\"\n"}) {
    const auto refused = with(line);
    ASSERT_FALSE(refused);
    EXPECT_THAT(describe(refused.failure()), HasSubstr("interior_sites")) << line;
  }
}

TEST_F(JobFile, with_several_problems_names_them_all) {
  const auto jobs = read(with_products("[cut]\nmod = \"auto\"\n[job]\nseed = -1\n"));
  ASSERT_FALSE(jobs);
  EXPECT_THAT(jobs.failure().what, HasSubstr("job.toml:6: unknown key 'mod' in [cut] (did you mean 'mode'?)"));
  EXPECT_THAT(jobs.failure().what, HasSubstr("job.toml:8: job.seed"));
}

TEST_F(JobFile, takes_settings_from_the_command_line) {
  const auto jobs = read(valid, {"job.seed=7", "job.name=other", "cut.mode=\"never\"", "output.products=[\"model\"]"});
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  EXPECT_EQ(jobs->front().header.seed, 7);
  EXPECT_EQ(jobs->front().header.name, "other");
  EXPECT_EQ(jobs->front().cut.judge.mode, "never");
  EXPECT_FALSE(jobs->front().makes("tets"));
}

TEST_F(JobFile, refuses_bad_settings_by_name) {
  for (const auto& [setting, what] : std::vector<std::pair<std::string, std::string>>{
           {"job.seed=-1", "--set job.seed=-1: job.seed = -1 must be ≥ 0"},
           {"job.sed=1", "--set job.sed=1: unknown key 'sed' in [job]"},
           {"jop.seed=1", "--set jop.seed=1: unknown section [jop]"},
           {"seed=1", "--set seed=1: not of the form"},
           {"job.seed", "--set job.seed: not of the form"},
           {"input.file=x", "--set input.file=x: not of the form"},
           {"job.seed.deep=1", "--set job.seed.deep=1: job.seed must be a whole number"},
           {"job.seed=1\ncut.mode=2", "job.seed must be a whole number"}}) {
    const auto jobs = read(valid, {setting});
    ASSERT_FALSE(jobs) << setting;
    EXPECT_THAT(jobs.failure().what, HasSubstr(what));
  }
}

TEST_F(JobFile, with_a_sweep_becomes_one_job_per_combination) {
  const auto jobs =
      read(valid + "[job]\nname = \"s\"\n[sweep]\n\"job.seed\" = [1, 2, 3]\ncut.mode = [\"auto\", \"never\"]\n");
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  std::vector<std::string> names;
  for (const Job& job : *jobs) names.push_back(job.header.name);
  EXPECT_THAT(names, testing::ElementsAre("s_cut.mode=auto_job.seed=1", "s_cut.mode=auto_job.seed=2",
                                          "s_cut.mode=auto_job.seed=3", "s_cut.mode=never_job.seed=1",
                                          "s_cut.mode=never_job.seed=2", "s_cut.mode=never_job.seed=3"));
  EXPECT_EQ((*jobs)[4].header.seed, 2);
  EXPECT_EQ((*jobs)[4].cut.judge.mode, "never");
}

TEST_F(JobFile, gives_sweep_members_that_look_alike_different_names) {
  const auto jobs = read(valid + "[job]\nname = \"s\"\n[sweep]\n\"cut.mode\" = [\"auto\", \"auto\"]\n");
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  ASSERT_EQ(jobs->size(), 2u);
  EXPECT_NE((*jobs)[0].header.name, (*jobs)[1].header.name);
}

TEST_F(JobFile, refuses_a_sweep_that_explodes) {
  std::string list = "[0";
  for (int i = 1; i < 200; ++i) list += ", " + std::to_string(i);
  list += "]";
  const auto jobs = read(valid + "[sweep]\n\"job.seed\" = " + list + "\n\"job.other\" = " + list + "\n");
  ASSERT_FALSE(jobs);
  EXPECT_THAT(jobs.failure().what, HasSubstr("more than 10000 combinations"));
}

TEST_F(JobFile, that_is_missing_or_a_folder_cannot_be_read) {
  for (const auto& path : {folder_ / "none.toml", folder_}) {
    const auto jobs = read_jobs(path);
    ASSERT_FALSE(jobs);
    EXPECT_EQ(jobs.failure().code, FailureCode::unreadable_file);
  }
}

}  // namespace
}  // namespace strataflow

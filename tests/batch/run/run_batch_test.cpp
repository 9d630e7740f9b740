#include "batch/run/run_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "batch/build_graph.h"
#include "batch/job_file/resolved_job.h"
#include "graph/stage_store.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;
using support::read_text;
using support::write_text;
using testing::HasSubstr;

/// Jobs on a coarse reference model, in a folder of their own.
class Batch : public testing::Test {
 protected:
  std::vector<Job> jobs(const std::string& name, const std::string& text) {
    write_text(scratch_.path() / name, text);
    Result<std::vector<Job>> read = read_jobs(scratch_.path() / name);
    EXPECT_TRUE(read) << describe(read.failure());
    return read ? *read : std::vector<Job>();
  }
  std::vector<Job> tets(const std::string& name) {
    return jobs(name, model + "[output]\nproducts = [\"model\", \"tets\"]\n");
  }
  fs::path out(const std::string& name) const { return scratch_.path() / "out" / name; }
  nlohmann::json report(const std::string& name) const {
    return nlohmann::json::parse(read_text(out(name) / "report.json"));
  }

  static inline const std::string model = "[[input]]\nmodel = \"A1\"\nresolution_m = 110.0\n";
  support::ScratchFolder scratch_;
};

TEST_F(Batch, writes_the_files_and_keys_of_the_contract) {
  const auto outcomes = run_batch(tets("a.toml"), {});
  ASSERT_TRUE(outcomes) << describe(outcomes.failure());
  ASSERT_EQ(outcomes->size(), 1u);
  ASSERT_FALSE((*outcomes)[0].failure) << describe(*(*outcomes)[0].failure);
  for (const char* file :
       {"report.json", "timing.json", "report.html", "job.toml", "log.txt", "model.vtp", "tets.vtu", "tets_facets.vtp"})
    EXPECT_GT(fs::file_size(out("a") / file), 0u) << file;

  const nlohmann::json json = report("a");
  EXPECT_EQ(json["format"], 1);
  EXPECT_EQ(json["job"], "a");
  EXPECT_EQ(json["status"], "ok");
  EXPECT_TRUE(json["error"].is_null());
  for (std::size_t i = 0; i < json["stages"].size(); ++i) {
    const auto& stage = json["stages"][i];
    EXPECT_EQ(stage["id"], i);
    EXPECT_EQ(stage["status"], "ok");
    EXPECT_GE(stage["digest"].get<std::string>().size(), 16u);
    EXPECT_TRUE(stage["warnings"].is_array());
  }
  const auto& built = json["model"];
  for (const char* key :
       {"corners", "lines", "surfaces", "regions", "vertices", "triangles", "sealed", "bbox_diagonal_m", "area_m2",
        "regions_list", "volumes_m3", "intersecting_triangle_pairs", "violations"})
    EXPECT_TRUE(built.contains(key)) << key;
  EXPECT_EQ(built["sealed"], true);
  EXPECT_EQ(built["regions"], 4);
  EXPECT_EQ(built["intersecting_triangle_pairs"], 0);
  const auto& cells = json["tets"];
  EXPECT_EQ(cells["inverted"], 0);
  ASSERT_EQ(cells["per_region"].size(), 4u);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(cells["per_region"][i]["volume_m3"].get<double>() / built["volumes_m3"][i].get<double>(), 1.0, 1e-9);

  const nlohmann::json timing = nlohmann::json::parse(read_text(out("a") / "timing.json"));
  for (const char* key : {"threads", "total_s", "peak_memory_mb", "stages"}) EXPECT_TRUE(timing.contains(key)) << key;
  EXPECT_GT(timing["peak_memory_mb"].get<double>(), 1.0);
  EXPECT_EQ(timing["stages"].size(), json["stages"].size());
}

TEST_F(Batch, shows_the_model_in_a_page_that_needs_nothing_else) {
  ASSERT_TRUE(run_batch(tets("a.toml"), {}));
  const std::string page = read_text(out("a") / "report.html");
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST_F(Batch, runs_common_stages_once) {
  std::vector<Job> both = tets("a.toml");
  for (const Job& job : jobs("b.toml", model + "[output]\nproducts = [\"model\"]\n")) both.push_back(job);
  StageGraph graph;
  const auto wired = build_graph(graph, both);
  EXPECT_EQ(graph.node_count(), wired[0].nodes.size());
  EXPECT_EQ(wired[0].model->node(), wired[1].model->node());
}

TEST_F(Batch, reports_a_job_alike_alone_and_in_company) {
  ASSERT_TRUE(run_batch(tets("a.toml"), {}));
  const auto alone = support::timeless_files(out("a"));
  std::vector<Job> both =
      jobs("b.toml", "[[input]]\nmodel = \"A2\"\nresolution_m = 110.0\n[output]\nproducts = [\"model\"]\n");
  for (const Job& job : tets("a.toml")) both.push_back(job);
  ASSERT_TRUE(run_batch(both, {}));
  EXPECT_EQ(support::timeless_files(out("a")), alone);
}

TEST_F(Batch, goes_on_with_the_other_jobs_when_one_fails) {
  write_text(scratch_.path() / "broken.ts", "GOCAD TSurf 1\nHEADER {\nname: x\n}\nTFACE\nVRTX 1 0 0 nan\nEND\n");
  write_text(out("a") / "report.json", "old");
  std::vector<Job> both = jobs("a.toml", "[[input]]\nfile = \"broken.ts\"\n[output]\nproducts = [\"model\"]\n");
  for (const Job& job : tets("b.toml")) both.push_back(job);
  const auto outcomes = run_batch(both, {});
  ASSERT_TRUE(outcomes);
  ASSERT_TRUE((*outcomes)[0].failure);
  EXPECT_EQ((*outcomes)[0].failure->code, FailureCode::malformed_file);
  EXPECT_THAT((*outcomes)[0].failure->what, HasSubstr("broken.ts"));
  EXPECT_FALSE((*outcomes)[1].failure);
  EXPECT_EQ(read_text(out("a") / "report.json"), "old");
  EXPECT_TRUE(fs::exists(out("b") / "report.json"));
}

TEST_F(Batch, seals_a_raw_model_and_reports_what_it_did) {
  const std::string raw = "[[input]]\nmodel = \"A2\"\nresolution_m = 110.0\nraw_ratio = ";
  for (const char* ratio : {"0.01", "-0.01"}) {
    const auto outcomes = run_batch(jobs("a.toml", raw + ratio + "\n[output]\nproducts = [\"model\"]\n"), {});
    ASSERT_TRUE(outcomes);
    ASSERT_FALSE((*outcomes)[0].failure) << describe(*(*outcomes)[0].failure);
    const nlohmann::json json = report("a");
    EXPECT_EQ(json["model"]["sealed"], true);
    EXPECT_EQ(json["model"]["regions"], 12);
    EXPECT_EQ(json["model"]["intersecting_triangle_pairs"], 0);
    EXPECT_EQ(json["cut"]["pairs_left"], 0);
    std::size_t contacts = 0;
    for (const auto& stage : json["stages"])
      for (const auto& warning : stage["warnings"]) contacts += warning["kind"] == "contact_made";
    EXPECT_GT(contacts, 0u) << "three horizons on two faults and four walls";
    std::size_t changes = 0;
    for (const auto& change : json["cut"]["changes"])
      changes += change["kind"] == "contact_made" && !change["what"].empty() && !change["why"].empty();
    EXPECT_GE(changes, contacts) << "told beside everything else that was changed";
  }
}

TEST_F(Batch, fails_on_a_raw_model_that_leaks_and_names_what_would_close_it) {
  const auto outcomes = run_batch(jobs("a.toml",
                                       "[[input]]\nmodel = \"A2\"\nresolution_m = 110.0\nraw_ratio = 0.05\n"
                                       "[output]\nproducts = [\"model\"]\n"),
                                  {});
  ASSERT_TRUE(outcomes);
  ASSERT_TRUE((*outcomes)[0].failure);
  EXPECT_EQ((*outcomes)[0].failure->code, FailureCode::invalid_input);
  EXPECT_THAT((*outcomes)[0].failure->what, HasSubstr("H1 stops "));
  EXPECT_THAT((*outcomes)[0].failure->remedy, HasSubstr("seal.distance_m"));
  EXPECT_FALSE(fs::exists(out("a")));
}

TEST_F(Batch, cuts_surfaces_without_a_box_that_need_not_be_sealed) {
  const std::string pair =
      "[[input]]\nmodel = \"horizon-fault-pair\"\nresolution_m = 100.0\n[output]\nproducts = [\"model\"]\n";
  const auto refused = run_batch(jobs("a.toml", pair), {});
  ASSERT_TRUE(refused);
  ASSERT_TRUE((*refused)[0].failure);
  EXPECT_EQ((*refused)[0].failure->code, FailureCode::invalid_input);
  const auto cut = run_batch(jobs("a.toml", pair + "[seal]\nrequired = false\n"), {});
  ASSERT_TRUE(cut);
  ASSERT_FALSE((*cut)[0].failure) << describe(*(*cut)[0].failure);
  EXPECT_EQ(report("a")["model"]["sealed"], false);
  EXPECT_GT(report("a")["cut"]["intersecting_triangle_pairs"].get<int>(), 0);
  EXPECT_EQ(report("a")["model"]["intersecting_triangle_pairs"], 0);
}

TEST_F(Batch, describes_a_raw_model_that_is_not_to_be_cut) {
  const auto outcomes = run_batch(jobs("a.toml",
                                       "[[input]]\nmodel = \"A2\"\nresolution_m = 110.0\nraw_ratio = -0.05\n"
                                       "[output]\nproducts = [\"model\"]\n[cut]\nmode = \"never\"\n"),
                                  {});
  ASSERT_TRUE(outcomes);
  ASSERT_FALSE((*outcomes)[0].failure) << describe(*(*outcomes)[0].failure);
  EXPECT_EQ(report("a")["model"]["sealed"], false);
  EXPECT_GT(report("a")["model"]["intersecting_triangle_pairs"].get<int>(), 0);
  EXPECT_GT(report("a")["model"]["violations"].size(), 0u);
}

TEST_F(Batch, stops_after_a_stage_and_marks_the_others_skipped) {
  BatchOptions options;
  options.run.stop_after = "build_model";
  const auto outcomes = run_batch(tets("a.toml"), options);
  ASSERT_TRUE(outcomes);
  ASSERT_FALSE((*outcomes)[0].failure);
  std::vector<std::string> ok, skipped;
  const nlohmann::json json = report("a");
  for (const auto& stage : json["stages"])
    (stage["status"] == "ok" ? ok : skipped).push_back(stage["stage"].get<std::string>());
  EXPECT_THAT(ok, testing::ElementsAre("generate", "combine", "judge_surfaces", "cut_constrained", "cut", "seal",
                                       "simplify_borders", "build_model"));
  EXPECT_THAT(skipped, testing::Contains("tetrahedralize"));
  EXPECT_FALSE(fs::exists(out("a") / "tets.vtu"));
}

TEST_F(Batch, refuses_an_unknown_stage_and_two_jobs_in_one_folder) {
  BatchOptions options;
  options.run.stop_after = "biuld_model";
  const auto unknown = run_batch(tets("a.toml"), options);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.failure().remedy, HasSubstr("build_model"));

  std::vector<Job> twice = tets("a.toml");
  twice.push_back(twice.front());
  const auto same = run_batch(twice, {});
  ASSERT_FALSE(same);
  EXPECT_EQ(same.failure().code, FailureCode::invalid_usage);
  EXPECT_THAT(same.failure().what, HasSubstr("would both write"));
  EXPECT_FALSE(fs::exists(out("a")));
}

TEST_F(Batch, writes_a_resolved_job_that_gives_the_same_report) {
  const std::string surface =
      "GOCAD TSurf 1\nHEADER {\nname: top\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
  write_text(scratch_.path() / "data" / "top.ts", surface);
  ASSERT_TRUE(run_batch(jobs("a.toml",
                             "[[input]]\nfile = \"data/top.ts\"\nname = \"H1\"\nrole = \"horizon\"\n[output]\n"
                             "products = [\"model\"]\n[cut]\nmode = \"never\"\n"),
                        {}));
  const Result<std::vector<Job>> again = read_jobs(out("a") / "job.toml");
  ASSERT_TRUE(again) << describe(again.failure());
  BatchOptions options;
  options.out = scratch_.path() / "elsewhere";
  ASSERT_TRUE(run_batch(*again, options));
  EXPECT_EQ(read_text(scratch_.path() / "elsewhere" / "report.json"), read_text(out("a") / "report.json"));
  EXPECT_EQ(report("a")["model"]["entities"][0]["name"], "H1");
  EXPECT_EQ(report("a")["model"]["entities"][0]["role"], "horizon");
}

TEST_F(Batch, spells_out_every_default_in_the_resolved_job) {
  const std::string text = resolved_job_text(tets("a.toml").front(), out("a"));
  for (const char* line : {"[job]", "name = \"a\"", "seed = 1", "formats = [\"vtk\"]", "[cut]", "mode = \"auto\"",
                           "[tetrahedralize]", "split_surfaces ="})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST_F(Batch, writes_the_formats_that_are_asked_for) {
  ASSERT_TRUE(run_batch(jobs("a.toml", model + "[output]\nproducts = [\"model\", \"tets\"]\n"
                                               "formats = [\"gocad\", \"medit\", \"gmsh\", \"obj\", \"abaqus\"]\n"),
                        {}));
  for (const char* file : {"model.vtp", "model.ml", "model.mesh", "model.msh", "model.obj", "model.inp", "tets.vtu",
                           "tets.so", "tets.mesh", "tets.msh", "tets.inp"})
    EXPECT_GT(fs::file_size(out("a") / file), 0u) << file;
}

TEST_F(Batch, that_is_cancelled_writes_nothing) {
  CancellationToken cancellation;
  cancellation.cancel();
  BatchOptions options;
  options.run.cancellation = &cancellation;
  const auto outcomes = run_batch(tets("a.toml"), options);
  ASSERT_TRUE(outcomes);
  ASSERT_TRUE((*outcomes)[0].failure);
  EXPECT_EQ((*outcomes)[0].failure->code, FailureCode::cancelled);
  EXPECT_FALSE(fs::exists(scratch_.path() / "out"));
}

TEST_F(Batch, quads_that_fail_leave_what_was_reached_beside_the_run_folder) {
  const std::string sharp = "B 4\n0 0\n100 0\n100 100\n0 100\nF 2\n0 50\n90 60\nF 2\n0 50\n80 48\nF 2\n40 0\n45 52\n";
  write_text(scratch_.path() / "sharp.txt", sharp);
  const std::string text =
      "[[input]]\nfile = \"sharp.txt\"\n[output]\nproducts = [\"quads\"]\n[quad]\nedge_length_m = 8\n";
  const std::vector<Job> job = jobs("q.toml", text);
  const auto good = run_batch(job, {});
  ASSERT_TRUE(good && !(*good)[0].failure) << describe(*(*good)[0].failure);
  const std::string before = read_text(out("q") / "report.json");

  const auto bad = run_batch(jobs("q.toml", text + "smoothing_rounds = 0\n"), {});
  ASSERT_TRUE(bad);
  ASSERT_TRUE((*bad)[0].failure) << "quads in a corner of 8° need smoothing";
  const fs::path left = out("q.failed");
  EXPECT_THAT((*bad)[0].failure->remedy, HasSubstr(left.string()));
  for (const char* file : {"report.json", "job.toml", "log.txt", "plan_problem.vtp", "frame_field.vtp",
                           "seamless_map.vtp", "quantize.vtp"})
    EXPECT_GT(fs::file_size(left / file), 0u) << file;
  EXPECT_EQ(nlohmann::json::parse(read_text(left / "report.json"))["status"], "failed");
  EXPECT_EQ(read_text(out("q") / "report.json"), before) << "the run folder is as it was";
  for (const fs::directory_entry& entry : fs::directory_iterator(scratch_.path() / "out"))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path() << " was left half-written";

  write_text(left / "notes.txt", "mine");
  ASSERT_TRUE(run_batch(job, {}));
  EXPECT_FALSE(fs::exists(left / "report.json")) << "a success clears it away";
  EXPECT_EQ(read_text(left / "notes.txt"), "mine");
}

TEST_F(Batch, curves_laid_into_quads_are_reported_with_what_came_of_it) {
  write_text(scratch_.path() / "cross.txt", "B 4\n0 0\n100 0\n100 100\n0 100\nF 2\n20 20\n75 66\nF 2\n0 85\n60 85\n");
  const auto made = run_batch(jobs("c.toml",
                                   "[[input]]\nfile = \"cross.txt\"\n[output]\nproducts = [\"quads\"]\n[quad]\n"
                                   "edge_length_m = 10\nloose = [\"F1\"]\n"),
                              {});
  ASSERT_TRUE(made && !(*made)[0].failure) << describe(*(*made)[0].failure);
  const auto quads = nlohmann::json::parse(read_text(out("c") / "report.json"))["quads"];
  EXPECT_EQ(quads["imprinted"], 1);
  EXPECT_EQ(quads["imprinted_curves"], nlohmann::json::array({"F1"}));
  EXPECT_EQ(quads["irregular"].size(), quads["interior_irregular"]);
  EXPECT_TRUE(quads["irregular"][0]["created"]);
  EXPECT_THAT(read_text(out("c") / "report.html"), HasSubstr("laid into the quads"));
}

TEST_F(Batch, jobs_that_fail_before_their_quads_leave_nothing) {
  write_text(scratch_.path() / "empty.pol", "0 0 0\n");
  const auto bad = run_batch(jobs("e.toml", "[[input]]\nfile = \"empty.pol\"\n[output]\nproducts = [\"quads\"]\n"), {});
  ASSERT_TRUE(bad);
  ASSERT_TRUE((*bad)[0].failure);
  EXPECT_FALSE(fs::exists(out("e.failed")));
}

TEST_F(Batch, frames_are_written_with_their_singular_curves) {
  const auto made = run_batch(jobs("f.toml",
                                   "[[input]]\nmodel = \"slab\"\nresolution_m = 125.0\n[output]\nproducts = "
                                   "[\"frames\"]\n[frames]\niterations = 2\n"),
                              {});
  ASSERT_TRUE(made) << describe(made.failure());
  ASSERT_FALSE((*made)[0].failure) << describe(*(*made)[0].failure);
  for (const char* file : {"frames.vtu", "frames_singular.vtp"}) EXPECT_GT(fs::file_size(out("f") / file), 0u) << file;
  EXPECT_GT(report("f")["frames"]["cells"], 100);
  EXPECT_THAT(read_text(out("f") / "frames.vtu"), HasSubstr("Name=\"direction_2\" NumberOfComponents=\"3\""));
  const std::string page = read_text(out("f") / "report.html");
  EXPECT_THAT(page, HasSubstr("<h2>Frames</h2>"));
  EXPECT_THAT(page, HasSubstr("angle_between_directions_deg"));
}

}  // namespace
}  // namespace strataflow

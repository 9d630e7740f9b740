#include "batch/job_file/job_file.h"

#include <gtest/gtest.h>

#include "batch/job_file/sweep.h"
#include "batch/options/job_value.h"
#include "batch/options/option_reader.h"

namespace strataflow {
namespace {

TEST(JobText, keeps_the_line_of_every_value) {
  const Result<JobValue> root = parse_job_text("a = 1\n[b]\nc = [1.5,\n \"x\"]\n", "f.toml");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->find("a")->origin, "f.toml:1");
  EXPECT_EQ(root->find("b")->origin, "f.toml:2");
  const JobValue* c = root->find("b")->find("c");
  EXPECT_EQ(c->origin, "f.toml:3");
  EXPECT_EQ((*c->array())[1].origin, "f.toml:4");
  EXPECT_EQ(c->literal(), "[1.5, \"x\"]");
  EXPECT_EQ(root->find("none"), nullptr);
}

TEST(JobText, that_nests_without_end_is_a_failure) {
  EXPECT_FALSE(parse_job_text("a = " + std::string(100000, '['), "f.toml"));
}

TEST(SettingValue, is_toml_where_it_can_be_and_a_text_otherwise) {
  EXPECT_EQ(parse_setting_value("5", "a.b=5").kind(), "a whole number");
  EXPECT_EQ(parse_setting_value("[1, 2]", "a.b").kind(), "a list");
  EXPECT_EQ(parse_setting_value("never", "a.b").kind(), "a text");
  EXPECT_EQ(parse_setting_value("1\nx = 2", "a.b").kind(), "a text");
  EXPECT_EQ(parse_setting_value("5", "a.b=5").origin, "--set a.b=5");
}

TEST(JobValue, is_set_by_its_path) {
  JobValue root;
  EXPECT_TRUE(root.set("a.b.c", JobValue{"x", std::int64_t{1}}));
  EXPECT_TRUE(root.set("a.b.d", JobValue{"x", true}));
  EXPECT_EQ(root.literal(), "{ \"a\" = { \"b\" = { \"c\" = 1, \"d\" = true } } }");
  EXPECT_FALSE(root.set("a.b.c.deeper", JobValue{"x", true}));
}

TEST(Sweep, varies_the_last_key_fastest) {
  JobValue root = *parse_job_text("[sweep]\n\"b.y\" = [1, 2]\n\"a.x\" = [\"p q\", \"r\"]\n", "f.toml");
  std::vector<Failure> problems;
  const std::vector<SweepMember> members = expand_sweep(root, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(members.size(), 4u);
  EXPECT_EQ(members[1].name_suffix, "_a.x=p_q_b.y=2");
  EXPECT_EQ(members[1].root.literal(), "{ \"a\" = { \"x\" = \"p q\" }, \"b\" = { \"y\" = 2 } }");
}

struct Sample {
  std::optional<double> length_m;
  std::map<std::string, double> by_name;
  std::vector<std::int64_t> counts;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(length_m,
          OptionField{.name = "length_m", .description = "a length", .minimum = 0, .exclusive_minimum = true});
    visit(by_name, OptionField{.name = "by_name", .description = "lengths", .minimum = 0});
    visit(counts, OptionField{.name = "counts", .description = "counts", .minimum = 1});
  }
};

TEST(OptionReader, reads_optionals_tables_and_lists) {
  const JobValue root = *parse_job_text("length_m = 2\ncounts = [3, 4]\n[by_name]\n\"a b\" = 1.5\n", "f.toml");
  std::vector<Failure> problems;
  Sample sample;
  OptionReader reader(&root, "sample", problems);
  sample.visit_fields(reader);
  reader.finish();
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(sample.length_m, 2.0);
  EXPECT_EQ(sample.by_name.at("a b"), 1.5);
  EXPECT_EQ(sample.counts, (std::vector<std::int64_t>{3, 4}));
}

TEST(OptionReader, names_the_line_inside_lists_and_tables) {
  const JobValue root = *parse_job_text("counts = [3,\n0]\n[by_name]\na = \"x\"\nb = -1\n", "f.toml");
  std::vector<Failure> problems;
  Sample sample;
  OptionReader reader(&root, "sample", problems);
  sample.visit_fields(reader);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].what, "f.toml:4: sample.by_name must be a number, but \"x\" is a text");
  EXPECT_EQ(problems[1].what, "f.toml:5: sample.by_name = -1 must be ≥ 0");
  EXPECT_EQ(problems[2].what, "f.toml:2: sample.counts = 0 must be ≥ 1");
}

}  // namespace
}  // namespace strataflow

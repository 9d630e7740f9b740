#include "io/read_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "base/atomic_file.h"
#include "io/bytes/input_file.h"
#include "io/bytes/tar_members.h"
#include "io/input_samples.h"

namespace strataflow {
namespace {

using ::testing::HasSubstr;

/// One entry of a ustar archive.
std::string tar_entry(const std::string& name, const std::string& content, char kind = '0') {
  std::string header(512, '\0');
  header.replace(0, name.size(), name);
  char size[13];
  std::snprintf(size, sizeof size, "%011o", static_cast<unsigned>(content.size()));
  header.replace(124, 11, size);
  header[156] = kind;
  header.replace(257, 6, std::string("ustar\0", 6));
  unsigned sum = 8 * ' ';
  for (const char c : header) sum += static_cast<unsigned char>(c);
  char checksum[8];
  std::snprintf(checksum, sizeof checksum, "%06o", sum);
  header.replace(148, 7, std::string(checksum, 7));
  std::string padded = content;
  padded.resize((content.size() + 511) / 512 * 512, '\0');
  return header + padded;
}

const std::string end_mark(1024, '\0');

std::string surface(const std::string& name) {
  return "GOCAD TSurf 1\nHEADER {\nname: " + name +
         "\n}\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
}

class ReadInputFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("strataflow_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path file(const std::string& name, const std::string& content) {
    EXPECT_TRUE(write_file_atomically(folder_ / name, content));
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

TEST_F(ReadInputFiles, the_ending_decides_in_any_case_and_gzipped) {
  for (const char* name : {"a.ts", "a.TS", "a.gocad"}) EXPECT_TRUE(read_input(file(name, surface("a")))) << name;
  for (const char* name : {"a.ts.gz", "a.Ts.GZ", "a.ts"}) {
    const Result<InputData> input = read_input(file(name, support::gzipped(surface("a"))));
    ASSERT_TRUE(input) << name << ": " << describe(input.failure());
    EXPECT_EQ(input->surfaces.entities[0].name, "a");
  }
}

TEST_F(ReadInputFiles, gocad_content_is_read_whatever_the_ending) {
  EXPECT_TRUE(read_input(file("model.txt", "\n" + surface("a"))));
}

TEST_F(ReadInputFiles, an_unknown_ending_says_what_is_supported) {
  for (const char* name : {"model.xyzzy", "model", "model.gz"}) {
    const Result<InputData> input = read_input(file(name, "text"));
    ASSERT_FALSE(input) << name;
    EXPECT_EQ(input.failure().code, FailureCode::unsupported);
    EXPECT_THAT(input.failure().remedy, HasSubstr(".ml"));
    EXPECT_THAT(input.failure().remedy, HasSubstr(".gz"));
  }
}

TEST_F(ReadInputFiles, messages_name_the_file_without_its_folder) {
  const Result<InputData> input = read_input(file("bad.ts", "GOCAD TSurf 1\nTRGL 1 2 3\nEND\n"));
  ASSERT_FALSE(input);
  EXPECT_EQ(input.failure().what.substr(0, 9), "bad.ts:2:");
}

TEST_F(ReadInputFiles, folders_missing_and_empty_files_are_named_for_every_format) {
  for (const InputFormat& format : input_formats()) {
    const std::string ending(format.ending);
    std::filesystem::create_directories(folder_ / ("folder." + ending));
    EXPECT_EQ(read_input(folder_ / ("folder." + ending)).failure().code, FailureCode::unreadable_file) << ending;
    EXPECT_EQ(read_input(folder_ / ("missing." + ending)).failure().code, FailureCode::unreadable_file) << ending;
    const Result<InputData> empty = read_input(file("empty." + ending, ""));
    ASSERT_FALSE(empty) << ending;
    EXPECT_EQ(empty.failure().code, FailureCode::malformed_file) << ending;
    EXPECT_THAT(empty.failure().what, HasSubstr("empty." + ending)) << ending;
    EXPECT_FALSE(empty.failure().remedy.empty()) << ending;
  }
}

TEST_F(ReadInputFiles, an_archive_is_its_members_in_archive_order) {
  const std::string tar = tar_entry("faults/", "", '5') + tar_entry("faults/z.ts", surface("z")) +
                          tar_entry("README.txt", "read me") + tar_entry("long", "faults/a_long_name.ts", 'L') +
                          tar_entry("short", surface("a")) + tar_entry("b.ts.gz", support::gzipped(surface("b"))) +
                          end_mark;
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"f.tar", tar},
                                      {"f.tar.gz", support::gzipped(tar)},
                                      {"f.tgz", support::gzipped(tar)}}) {
    const Result<InputData> input = read_input(file(name, content));
    ASSERT_TRUE(input) << describe(input.failure());
    ASSERT_EQ(input->surfaces.entities.size(), 3u);
    EXPECT_EQ(input->surfaces.entities[0].name, "z");
    EXPECT_EQ(input->surfaces.entities[1].name, "a");
    EXPECT_EQ(input->surfaces.entities[2].name, "b");
    ASSERT_EQ(input->warnings.size(), 1u);
    EXPECT_EQ(input->warnings[0].kind, "skipped_member");
    EXPECT_THAT(input->warnings[0].what, HasSubstr("README.txt"));
  }
}

TEST_F(ReadInputFiles, a_damaged_archive_is_named) {
  const std::string tar = tar_entry("a.ts", surface("a")) + end_mark;
  EXPECT_THAT(read_input_bytes(tar.substr(0, 300), "f.tar").failure().what, HasSubstr("truncated header"));
  EXPECT_THAT(read_input_bytes(tar.substr(0, 520), "f.tar").failure().what, HasSubstr("truncated member"));
  std::string flipped = tar;
  flipped[0] = 'b';
  EXPECT_THAT(read_input_bytes(flipped, "f.tar").failure().what, HasSubstr("checksum"));
  EXPECT_FALSE(read_input_bytes(end_mark, "f.tar"));
  EXPECT_FALSE(read_input_bytes("", "f.tar"));
  const Result<InputData> member = read_input_bytes(tar_entry("in/a.ts", "GOCAD TSurf 1\nEND\n") + end_mark, "f.tar");
  ASSERT_FALSE(member);
  EXPECT_THAT(member.failure().what, HasSubstr("f.tar/in/a.ts:2"));
}

TEST(TarMembers, pax_headers_give_long_names) {
  const std::string record = "23 path=deep/long_nam.ts\n";
  const std::string tar = tar_entry("pax", "25" + record.substr(2), 'x') + tar_entry("short", "x") + end_mark;
  const auto members = tar_members(tar, "f.tar");
  ASSERT_TRUE(members);
  ASSERT_EQ(members->size(), 1u);
  EXPECT_EQ((*members)[0].name, "deep/long_nam.ts");
  EXPECT_EQ((*members)[0].content, "x");
}

TEST(ReadInputRealModels, the_california_fault_archive_has_its_known_counts) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  const Result<InputData> input = read_input(support::shared_data() / "scec-cfm61/cfm61_native.tar.gz");
  ASSERT_TRUE(input) << describe(input.failure());
  EXPECT_EQ(input->surfaces.entities.size(), 443u);
  EXPECT_EQ(input->surfaces.triangles.size(), 306878u);
  EXPECT_TRUE(input->warnings.empty());
}

}  // namespace
}  // namespace strataflow

#include "io/model_file/read_model_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "base/archive.h"
#include "base/atomic_file.h"
#include "io/model_file/write_model_file.h"
#include "io/two_tetrahedra.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;

class ReadModelFile : public testing::Test {
 protected:
  ReadModelFile() {
    EXPECT_TRUE(write_model_file(file_, support::two_tetrahedra()));
    content_ = *read_file(file_);
  }
  ~ReadModelFile() override { fs::remove(file_); }

  Result<StructuralModel> read(const std::string& content) {
    EXPECT_TRUE(write_file_atomically(file_, content));
    return read_model_file(file_);
  }

  fs::path file_ = fs::temp_directory_path() / ("strataflow_" + std::to_string(::getpid()) + "_read.sfm");
  std::string content_;
};

TEST_F(ReadModelFile, every_truncation_is_noticed) {
  for (std::size_t length = 0; length < content_.size(); ++length) {
    const auto model = read(content_.substr(0, length));
    ASSERT_FALSE(model) << length << " bytes";
    ASSERT_EQ(model.failure().code, FailureCode::malformed_file);
  }
  EXPECT_FALSE(read(content_ + '\0'));
}

TEST_F(ReadModelFile, every_flipped_bit_is_noticed_unless_it_is_in_one_copy_of_the_counter) {
  const std::vector<std::byte> expected = archived(support::two_tetrahedra());
  for (std::size_t position = 0; position < content_.size(); ++position) {
    std::string damaged = content_;
    damaged[position] ^= static_cast<char>(1 << (position % 8));
    const auto model = read(damaged);
    const bool is_counter = position >= 16 && position < 48;
    ASSERT_EQ(static_cast<bool>(model), is_counter) << "byte " << position;
    if (model) {
      ASSERT_EQ(archived(*model), expected);
    }
  }
}

TEST_F(ReadModelFile, a_damaged_section_is_named) {
  content_.back() ^= 1;
  const auto model = read(content_);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.failure().what, file_.string() + ": section 17 (layer) is damaged: its checksum is wrong");
}

TEST_F(ReadModelFile, what_is_no_model_file_is_said_to_be_none) {
  EXPECT_EQ(read("").failure().what, file_.string() + ": is not a strataflow model file");
  EXPECT_EQ(read("GOCAD Model3d 1\r\n" + std::string(500, ' ')).failure().code, FailureCode::malformed_file);
  EXPECT_EQ(read_model_file("/nowhere/model.sfm").failure().code, FailureCode::unreadable_file);
  EXPECT_EQ(read_model_file(fs::temp_directory_path()).failure().code, FailureCode::unreadable_file);
}

TEST_F(ReadModelFile, a_foreign_byte_order_is_not_supported) {
  std::reverse(content_.begin() + 12, content_.begin() + 16);
  EXPECT_EQ(read(content_).failure().code, FailureCode::unsupported);
}

}  // namespace
}  // namespace strataflow

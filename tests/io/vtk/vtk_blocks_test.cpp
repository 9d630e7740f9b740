#include "io/vtk/vtk_blocks.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "io/bytes/byte_order.h"

namespace strataflow {
namespace {
constexpr VtkPacking packed_64{true, true, false};

TEST(VtkBlocks, what_is_packed_unpacks) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{1} << 20,
                                 (std::size_t{1} << 20) + 1, std::size_t{3000000}}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i / 7);
    const Result<std::string> again = unpack_vtk_array(pack_vtk_array(bytes) + "what follows", false, packed_64, "a");
    ASSERT_TRUE(again) << size;
    EXPECT_EQ(*again, bytes) << size;
  }
}

TEST(VtkBlocks, base64_may_pad_between_header_and_data_or_not) {
  const VtkPacking plain{};
  const Result<std::string> apart = unpack_vtk_array("AwAAAA==\n YWJj", true, plain, "a");
  ASSERT_TRUE(apart);
  EXPECT_EQ(*apart, "abc");
  const Result<std::string> joint = unpack_vtk_array("AwAAAGFiYw==", true, plain, "a");
  ASSERT_TRUE(joint);
  EXPECT_EQ(*joint, "abc");
  EXPECT_FALSE(unpack_vtk_array("AwAAAGFi!w==", true, plain, "a"));
}

TEST(VtkBlocks, an_impossible_inflation_is_refused_before_memory_is_taken) {
  std::string bomb;
  store_number<std::uint64_t>(bomb, 1);
  store_number<std::uint64_t>(bomb, std::uint64_t{1} << 50);
  store_number<std::uint64_t>(bomb, 0);
  store_number<std::uint64_t>(bomb, 10);
  bomb += "0123456789";
  const Result<std::string> result = unpack_vtk_array(bomb, false, packed_64, "a.vtp: array 'x'");
  ASSERT_FALSE(result);
  EXPECT_NE(result.failure().what.find("a.vtp: array 'x': compressed block 1 claims an impossible size"),
            std::string::npos);
}

TEST(VtkBlocks, one_large_block_of_zeros_packed_as_small_as_it_gets_is_legal) {
  const std::string zeros(std::size_t{1} << 24, '\0');
  uLongf size = ::compressBound(zeros.size());
  std::string packed(size, '\0');
  ASSERT_EQ(::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(zeros.data()),
                        zeros.size(), 9),
            Z_OK);
  std::string array;
  store_number<std::uint64_t>(array, 1);
  store_number<std::uint64_t>(array, zeros.size());
  store_number<std::uint64_t>(array, 0);
  store_number<std::uint64_t>(array, size);
  array.append(packed, 0, size);
  EXPECT_GT(zeros.size() / size, 1000u);
  const Result<std::string> again = unpack_vtk_array(array, false, packed_64, "a");
  ASSERT_TRUE(again) << describe(again.failure());
  EXPECT_EQ(*again, zeros);
}

TEST(VtkBlocks, counts_larger_than_the_data_are_refused) {
  std::string header;
  store_number<std::uint64_t>(header, std::uint64_t{1} << 60);
  header += std::string(100, 'x');
  EXPECT_FALSE(unpack_vtk_array(header, false, packed_64, "a"));
  EXPECT_FALSE(unpack_vtk_array(header, false, VtkPacking{false, true, false}, "a"));
  EXPECT_FALSE(unpack_vtk_array("abc", false, packed_64, "a"));
}

TEST(VtkBlocks, a_flipped_byte_is_noticed) {
  std::string packed = pack_vtk_array(std::string(5000, 'a') + "b");
  packed[packed.size() - 2] ^= 1;  // the checksum
  EXPECT_FALSE(unpack_vtk_array(packed, false, packed_64, "a"));
}

}  // namespace
}  // namespace strataflow

#include "store/file/store_rows.hpp"

#include <atomic>
#include <cstdint>
#include <gmock/gmock.h>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "libitin/store/random_points.hpp"
#include "store/codec/byte_stream.hpp"
#include "support/row_bytes.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using Row = std::vector<std::uint8_t>;

class StoreRowsTest : public testing::Test {
 protected:
  void SetUp() override { test::random_store(3, 20000).write(path_); }

  std::map<std::uint64_t, Row> read_all(const StoreRows& rows) const {
    std::map<std::uint64_t, Row> all;
    rows.for_each_key(BlobKind::Block,
                      [&](std::uint64_t key) { all.emplace(key, test::bytes_of(rows, BlobKind::Block, key)); });
    return all;
  }

  const test::TemporaryDirectory directory_;
  const std::string path_ = directory_.file("store.itin");
};

/// More threads than connections are kept for, each of which also asks for rows that are not there.
TEST_F(StoreRowsTest, ManyThreadsReadWhatOneReads) {
  const StoreRows rows(path_);
  const std::map<std::uint64_t, Row> expected = read_all(rows);
  ASSERT_GT(expected.size(), 10U);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (std::uint64_t t = 0; t < 40; ++t) {
    threads.emplace_back([&, random = std::mt19937_64(test::seed() + t)]() mutable {
      for (int i = 0; i < 100; ++i) {
        auto row = expected.begin();
        std::advance(row, static_cast<std::ptrdiff_t>(random() % expected.size()));
        if (test::bytes_of(rows, BlobKind::Block, row->first) != row->second) ++wrong;
        if (random() % 8 != 0 || expected.contains(row->first + 1)) continue;
        try {
          rows.read(BlobKind::Block, row->first + 1, [](StoreRows::Bytes) {});
          ++wrong;
        } catch (const CorruptStore& e) {
          if (std::string(e.what()).find("is missing") == std::string::npos) ++wrong;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST_F(StoreRowsTest, ARowIsThereWhileAnotherIsRead) {
  const StoreRows rows(path_);
  const std::map<std::uint64_t, Row> expected = read_all(rows);
  const auto first = expected.begin(), last = std::prev(expected.end());
  rows.read(BlobKind::Block, first->first, [&](StoreRows::Bytes bytes) {
    EXPECT_EQ(test::bytes_of(rows, BlobKind::Block, last->first), last->second);
    EXPECT_THAT(bytes, testing::ElementsAreArray(first->second));
  });
}

TEST_F(StoreRowsTest, WhatCannotBeDecodedNamesItsRow) {
  const StoreRows rows(path_);
  const std::uint64_t key = read_all(rows).begin()->first;
  try {
    rows.read(BlobKind::Block, key, [](StoreRows::Bytes) { throw DecodeError("makes no sense"); });
    FAIL();
  } catch (const CorruptStore& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("makes no sense"));
    EXPECT_THAT(e.place(), testing::StartsWith("block "));
  }
  EXPECT_FALSE(test::bytes_of(rows, BlobKind::Block, key).empty());
}

}  // namespace
}  // namespace itin

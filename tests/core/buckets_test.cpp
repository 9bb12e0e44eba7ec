#include "core/buckets.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace meshgraft {
namespace {

constexpr std::array<std::pair<std::size_t, char>, 5> kItems{{{2, 'a'}, {0, 'b'}, {2, 'c'}, {4, 'd'}, {0, 'e'}}};

Buckets<char> bucketed() {
  return Buckets<char>(6, [](auto&& add) {
    for (const auto& [key, item] : kItems) add(key, item);
  });
}

TEST(Buckets, HoldTheItemsOfEachKeyInTheirOrder) {
  const Buckets<char> buckets = bucketed();
  ASSERT_EQ(buckets.size(), 6);
  std::vector<std::string> lists;
  for (std::size_t key = 0; key < buckets.size(); ++key) lists.emplace_back(buckets[key].begin(), buckets[key].end());
  EXPECT_EQ(lists, (std::vector<std::string>{"be", "", "ac", "", "d", ""}));
  EXPECT_EQ(buckets.first(2), 2);
  EXPECT_EQ(buckets.first(5), 5);
}

TEST(Buckets, GiveTheirItemsAwayByKey) {
  const std::vector<char> all = bucketed().take_all();
  EXPECT_EQ(std::string(all.begin(), all.end()), "beacd");
}

TEST(Buckets, AreNoneWithoutKeys) { EXPECT_EQ(Buckets<char>().size(), 0); }

}  // namespace
}  // namespace meshgraft

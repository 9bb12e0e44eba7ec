// Parts of the program that its outside does not show.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>

#include "cli/deferred_signals.hpp"
#include "cli/nearest.hpp"

namespace meshgraft::cli {
namespace {

TEST(DeferredSignals, TakeEffectAtTheEndOfTheScope) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto interrupted_work = [] {
    const DeferredSignals deferred;
    std::raise(SIGINT);
    std::fputs("finished", stderr);
  };
  EXPECT_EXIT(interrupted_work(), testing::KilledBySignal(SIGINT), "finished");
}

TEST(DeferredSignals, ThatAreIgnoredStayIgnored) {
  const auto old = std::signal(SIGHUP, SIG_IGN);
  {
    const DeferredSignals deferred;
    std::raise(SIGHUP);
  }
  std::raise(SIGHUP);
  std::signal(SIGHUP, old);
}

TEST(EditDistance, CountsInsertedRemovedReplacedAndSwappedLetters) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("merge", "merge"), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("merge", "mrge"), 1u);
  EXPECT_EQ(edit_distance("mege", "merge"), 1u);
  EXPECT_EQ(edit_distance("marge", "merge"), 1u);
  EXPECT_EQ(edit_distance("mrege", "merge"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
}

TEST(Nearest, IsNothingWhenAllAreFar) {
  const std::vector<std::string> names{"merge", "check", "info", "convert"};
  EXPECT_EQ(nearest("weld", names), std::nullopt);
  EXPECT_EQ(nearest("x", names), std::nullopt);
  EXPECT_EQ(nearest("conv", names), "convert");
  EXPECT_EQ(nearest("chekc", names), "check");
}

}  // namespace
}  // namespace meshgraft::cli

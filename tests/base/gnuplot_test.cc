// SPDX-License-Identifier: BSD-3-Clause
#include "base/gnuplot.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tests/support/refusal.h"

namespace strainwave {
namespace {

std::string refusal(const std::string& script) {
  return testing::refusal_of<std::runtime_error>([&] { run_gnuplot(script); });
}

TEST(Gnuplot, SaysWhatGnuplotSaid) {
  EXPECT_EQ(refusal("x = 1\n"), "accepted");
  EXPECT_NE(refusal("plot nonsense(\n").find("nonsense"), std::string::npos);
}

TEST(Gnuplot, NamesThePackageWhenThereIsNone) {
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nonexistent", 1);
  const std::string said = refusal("x = 1\n");
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(said.find("gnuplot-nox"), std::string::npos) << said;
}

TEST(Gnuplot, TakesNoTextForACommand) {
  EXPECT_EQ(gnuplot_quoted("it's `x` \\ \n\x1b[2J"), "'it''s `x` \\ [2J'");
}

}  // namespace
}  // namespace strainwave

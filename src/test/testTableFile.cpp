// Tables are read as they were written; what a killed run left of a row is not taken for one.
#include <gtest/gtest.h>

#include <cmath>

#include "output/PathTable.hpp"
#include "output/TableFile.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

TEST(TableFile, RowsComeBack) {
  const TemporaryFolder folder;
  PointRow limit{2, 1, 0.1, 1.0 / 3, "maximum"};
  limit.monitors = {-0.0, 1e-300};
  PointRow fork{3, 1, 0.2, 0.5, "pitchfork", 1, 1};
  fork.monitors = {1, 2};
  writeFile(folder / "points.csv",
            pointHeader({"a", "b"}) + "\n" + text(limit) + "\n" + text(fork) + "\n3,1,0.2,0.7,mini");
  const TableFile table((folder / "points.csv").string());
  ASSERT_EQ(table.numRows(), 2u);
  EXPECT_EQ(table.numbers("load_factor"), (std::vector<double>{1.0 / 3, 0.5}));
  EXPECT_EQ(table.texts("kind"), (std::vector<std::string>{"maximum", "pitchfork"}));
  EXPECT_TRUE(std::isnan(table.numbers("kind")[0]));
  EXPECT_THROW(table.place("c"), std::invalid_argument);
  const auto limits = limitPointsOf((folder / "points.csv").string());
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].loadFactor, 1.0 / 3);
  EXPECT_EQ(limits[0].monitors, limit.monitors);
}

TEST(TableFile, DamageIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THROW(TableFile((folder / "none.csv").string()), std::invalid_argument);
  writeFile(folder / "t.csv", "a,b\n1,2\n3,4.5\n");
  EXPECT_EQ(TableFile((folder / "t.csv").string()).integers("a"), (std::vector<int>{1, 3}));
  EXPECT_THROW(TableFile((folder / "t.csv").string()).integers("b"), std::invalid_argument);
  writeFile(folder / "t.csv", "a,b\n1,2\n3\n");
  try {
    TableFile table((folder / "t.csv").string());
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("t.csv: row 2 has 1 cells, the header 2"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace atrapos::test

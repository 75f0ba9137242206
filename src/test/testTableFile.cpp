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

TEST(TableFile, PointsWithoutWholeNumbersAreRefused) {
  const TemporaryFolder folder;
  const std::string file = (folder / "points.csv").string();
  writeFile(file, pointHeader({}) + "\n2,1,0.1,0.3,maximum,/,0,0,1e-9\n");
  EXPECT_THROW(limitPointsOf(file), std::invalid_argument);
  writeFile(file, pointHeader({}) + "\n1e300,1,0.1,0.3,hopf,1,0,0,1e-9\n");
  EXPECT_THROW(hopfPointsOf(file), std::invalid_argument);
}

// What a header holds is shown without what moves the cursor, and not at any length.
TEST(TableFile, OtherColumnsAreNamedInOneLine) {
  const TemporaryFolder folder;
  const std::string file = (folder / "path.csv").string();
  writeFile(file, "step,\x1b[2J\r" + std::string(5000, 'x') + "\n");
  try {
    Table((folder / "new.csv").string(), pathHeader({})).copyFrom(file, {0, 1}, {});
    FAIL() << "not refused";
  } catch (const std::invalid_argument& e) {
    const std::string line = e.what();
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
    EXPECT_EQ(line.find('\r'), std::string::npos);
    EXPECT_LT(line.size(), 1000u);
    EXPECT_NE(line.find("has the columns step,"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace atrapos::test

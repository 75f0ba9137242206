#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {

/// What check prints of a deck that generates its mesh; both are made in the folder, as m.yaml.
inline std::string checkedDeck(const TemporaryFolder& folder, const std::string& deck) {
  writeFile(folder / "m.yaml", deck);
  EXPECT_EQ(runAtrapos({"mesh", "-q", "m.yaml"}, folder.path()).exitCode, 0);
  const CommandResult check = runAtrapos({"check", "m.yaml"}, folder.path());
  EXPECT_EQ(check.exitCode, 0) << check.err;
  return check.out;
}

}  // namespace atrapos::test

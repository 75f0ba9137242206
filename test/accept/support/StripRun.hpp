#pragma once

#include "support/ExampleRun.hpp"

namespace atrapos::test {

/// ExampleFolder and ExampleRun of a deck in examples/strip_roll.
struct StripFolder : ExampleFolder {
  explicit StripFolder(const std::string& name, const Edits& edits = {})
      : ExampleFolder("strip_roll/" + name, edits) {}
};

struct StripRun : ExampleRun {
  explicit StripRun(const std::string& name, const Edits& edits = {},
                    const std::vector<std::string>& arguments = {})
      : ExampleRun("strip_roll/" + name, edits, arguments) {}
};

}  // namespace atrapos::test

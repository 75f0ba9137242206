#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace atrapos::contact::test {

/// f throws std::invalid_argument, whose one line has these words.
template <class F>
void expectRefused(const F& f, const std::string& words) {
  try {
    f();
    ADD_FAILURE() << "accepted where expected: " << words;
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

}  // namespace atrapos::contact::test

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

namespace atrapos::test {

/// Texts with changes at random (TextMutator.hpp): each is read, or refused with one line, within 10 s.
class TextMutants {
 public:
  /// As many as ATRAPOS_MUTANTS asks for (scripts/fuzz), else so many.
  explicit TextMutants(int usual) : number_(usual) {
    if (const char* const asked = std::getenv("ATRAPOS_MUTANTS")) number_ = std::atoi(asked);
  }

  /// `make(m)` is the m-th text; `read(m, text, line)` reads it, or puts the line with which it is refused
  /// into `line`. Ends at the first that fails.
  template <class Make, class Read>
  void tryAll(const std::string& of, const Make& make, const Read& read) {
    for (int m = 0; m < number_; ++m) {
      const std::string text = make(m);
      std::optional<std::string> line;
      const auto start = std::chrono::steady_clock::now();
      try {
        read(m, text, line);
      } catch (const std::exception& e) {
        FAIL() << "mutant " << m << ": " << e.what() << "\n" << text;
      }
      if (testing::Test::HasFatalFailure()) return;
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      slowest_ = std::max(slowest_, time.count());
      ASSERT_LT(slowest_, 10) << text;
      ASSERT_EQ(line.value_or("").find('\n'), std::string::npos) << *line << "\n" << text;
      ++(line ? refused_ : read_);
    }
    std::cout << number_ << " mutants of " << of << ": " << read_ << " read, " << refused_
              << " refused, the slowest in " << slowest_ << " s\n";
  }

  int number() const { return number_; }
  int read() const { return read_; }
  int refused() const { return refused_; }

 private:
  int number_, read_ = 0, refused_ = 0;
  double slowest_ = 0;
};

}  // namespace atrapos::test

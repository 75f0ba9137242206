// What formulas mean, and what is said about those that mean nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "atrapos/formula/Parse.hpp"

using namespace atrapos::formula;

namespace {

constexpr double u = 0.7, lambda = 1.3, x = 0.4;

/// The value at u, lambda (inputs), grad(u) = (1, 2, 3) and grad(w) = (-1, 0.5, 2) (inputs), x (a datum).
double valueOf(const std::string& text) {
  Builder builder;
  Symbols symbols;
  symbols.scalars = {{"u", builder.input(0)},
                     {"lambda", builder.input(1)},
                     {"x", builder.datum(0)},
                     {"w", builder.input(8)}};
  symbols.gradients = {{"u", {builder.input(2), builder.input(3), builder.input(4)}},
                       {"w", {builder.input(5), builder.input(6), builder.input(7)}}};
  const Program program = builder.program({parse(text, symbols, builder)});
  const double in[] = {u, lambda, 1, 2, 3, -1, 0.5, 2, 0.2}, data[] = {x};
  double value = 0;
  evaluate<double>(program, in, data, &value);
  return value;
}

std::string refusalOf(const std::string& text) {
  try {
    valueOf(text);
  } catch (const FormulaError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST(Parse, Precedence) {
  EXPECT_EQ(valueOf("1 + 2*3"), 7);
  EXPECT_EQ(valueOf(" 8 - 3 - 2 "), 3);
  EXPECT_EQ(valueOf("8/4/2"), 1);
  EXPECT_EQ(valueOf("-2^2"), -4);
  EXPECT_EQ(valueOf("(-2)^2"), 4);
  EXPECT_EQ(valueOf("2^3^2"), 512);
  EXPECT_EQ(valueOf("2**-1"), 0.5);
  EXPECT_EQ(valueOf("2*-3"), -6);
  EXPECT_EQ(valueOf("- -3"), 3);
  EXPECT_EQ(valueOf("1.5e-3"), 1.5e-3);
  EXPECT_EQ(valueOf(".5E+1"), 5);
  EXPECT_EQ(valueOf("3."), 3);
}

TEST(Parse, FunctionsAndNames) {
  EXPECT_DOUBLE_EQ(valueOf("lambda*exp(u)"), lambda * std::exp(u));
  EXPECT_DOUBLE_EQ(valueOf("log(u) + log10(u)"), std::log(u) + std::log10(u));
  EXPECT_DOUBLE_EQ(valueOf("sqrt(x)"), std::sqrt(x));
  EXPECT_DOUBLE_EQ(valueOf("sin(u)*cos(x) - tan(u)"), std::sin(u) * std::cos(x) - std::tan(u));
  EXPECT_DOUBLE_EQ(valueOf("asin(u) + acos(u) + atan(u)"), std::asin(u) + std::acos(u) + std::atan(u));
  EXPECT_DOUBLE_EQ(valueOf("sinh(u) + cosh(u) + tanh(u)"), std::sinh(u) + std::cosh(u) + std::tanh(u));
  EXPECT_DOUBLE_EQ(valueOf("erf(u)"), std::erf(u));
  EXPECT_DOUBLE_EQ(valueOf("pow(u, 2.5)"), std::pow(u, 2.5));
  EXPECT_DOUBLE_EQ(valueOf("pow(u, lambda)"), std::pow(u, lambda));
  EXPECT_DOUBLE_EQ(valueOf("pi"), std::acos(-1.0));
  EXPECT_DOUBLE_EQ(valueOf("dot(grad(u), grad(w))"), 1 * -1 + 2 * 0.5 + 3 * 2);
  EXPECT_DOUBLE_EQ(valueOf("x*dot(grad(u), grad(u))"), x * 14);
}

TEST(Parse, WhatCannotBeReadIsNamed) {
  EXPECT_EQ(refusalOf(""), "is empty; expected a formula");
  EXPECT_EQ(refusalOf("1 +"), "is no formula: it ends too early");
  EXPECT_EQ(refusalOf("(u"), "is no formula: it ends too early");
  EXPECT_EQ(refusalOf("+u"), "is no formula: it cannot begin with '+'");
  EXPECT_EQ(refusalOf("u*)"), "is no formula: it cannot go on with ')' after 'u*'");
  EXPECT_EQ(refusalOf("u $ 2"), "is no formula: it cannot go on with '$' after 'u '");
  EXPECT_EQ(refusalOf("1 2"), "is no formula: it cannot go on with '2' after '1 '");
  EXPECT_EQ(refusalOf("v + 1"), "does not know 'v'; known are lambda, u, w, x, pi");
  EXPECT_NE(refusalOf("foo(u)").find("does not know the function 'foo'; known are acos, asin"),
            std::string::npos);
  EXPECT_EQ(refusalOf("exp(u, 1)"), "calls exp with 2 arguments; expected 1");
  EXPECT_EQ(refusalOf("pow(u)"), "calls pow with 1 arguments; expected 2");
  EXPECT_EQ(refusalOf("grad(u)"), "has a gradient where a number must be; expected dot(grad(a), grad(b))");
  EXPECT_EQ(refusalOf("dot(u, w)"), "has dot of numbers; expected dot(grad(a), grad(b))");
  EXPECT_EQ(refusalOf("dot(grad(x), grad(u))"), "has grad of something that is no field; expected u, w");
  EXPECT_EQ(refusalOf("u + 1/0"), "has a constant part whose value is infinite");
  EXPECT_EQ(refusalOf("log(-1)"), "has a constant part whose value is no number");
  EXPECT_EQ(refusalOf("1e999"), "has a number that is too large: 1e999");
  EXPECT_EQ(refusalOf(std::string(3000, '1')), "is longer than 2000 characters");
}

TEST(Parse, LongFormulasAreRefusedAndDeepOnesRead) {
  std::string sum = "u";
  for (int i = 2; i < 120; ++i) sum += "+u^" + std::to_string(i);
  EXPECT_EQ(refusalOf(sum), "is too long: formulas that act together may have 96 operations");
  EXPECT_EQ(valueOf(std::string(900, '(') + "u" + std::string(900, ')')), u);
}

/// Whatever stands in a deck: a formula, or one line that says why not.
TEST(Parse, StrangeTextsAreRefusedInOneLine) {
  const std::vector<std::string> pieces{"u",
                                        "lambda",
                                        "(",
                                        ")",
                                        "+",
                                        "-",
                                        "*",
                                        "/",
                                        "^",
                                        "**",
                                        ",",
                                        "exp(",
                                        "dot(",
                                        "grad(",
                                        "pow(",
                                        "1",
                                        "2.5e3",
                                        ".",
                                        "e",
                                        " ",
                                        "\n",
                                        "\t",
                                        "x",
                                        "`",
                                        "$(",
                                        "\"",
                                        "\\",
                                        "\xc3\xa4",
                                        std::string(1, '\0'),
                                        "pi",
                                        "1e400",
                                        "[",
                                        "}"};
  std::mt19937 random(7);
  int read = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text;
    for (std::size_t i = random() % 12 + 1; i > 0; --i) text += pieces[random() % pieces.size()];
    try {
      valueOf(text);
      ++read;
    } catch (const FormulaError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  }
  EXPECT_GT(read, 100);
}

TEST(Builder, SharesCommonParts) {
  Builder builder;
  const Symbols symbols{{{"u", builder.input(0)}}, {}};
  const int a = parse("exp(u)*(1 + u)", symbols, builder), b = parse("(u + 1)*exp(u)", symbols, builder);
  EXPECT_EQ(a, b);
  const Program program = builder.program({a, parse("exp(u)", symbols, builder)});
  EXPECT_EQ(program.numSteps, 5);  // u, 1, exp(u), 1 + u, the product
  EXPECT_EQ(builder.inputsOf(a), std::vector<int>{0});
  EXPECT_TRUE(builder.inputsOf(parse("0*u", symbols, builder)).empty());
}

/// What a formula is the sum of does not cancel.
TEST(Builder, Magnitudes) {
  Builder builder;
  const Symbols symbols{{{"u", builder.input(0)}, {"w", builder.input(1)}}, {}};
  const auto magnitude = [&](const std::string& text) {
    const Program program = builder.program({builder.magnitude(parse(text, symbols, builder))});
    const double in[] = {2, 3};
    double value = 0;
    evaluate<double>(program, in, nullptr, &value);
    return value;
  };
  EXPECT_EQ(magnitude("u - 2"), 4);
  EXPECT_EQ(magnitude("5*(w - 3)/(-u)"), 15);
  EXPECT_EQ(magnitude("-(u*w - 6) + sqrt(u - 2)"), 12);
}

TEST(Names, OfOnesOwn) {
  EXPECT_TRUE(isName("T_0"));
  for (const char* name : {"", "0a", "a-b", "exp", "pi", "grad"}) EXPECT_FALSE(isName(name)) << name;
}

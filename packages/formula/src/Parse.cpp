#include "atrapos/formula/Parse.hpp"

#include <Teuchos_Language.hpp>
#include <Teuchos_Parser.hpp>
#include <Teuchos_Reader.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace atrapos::formula {
namespace {

constexpr std::size_t mostCharacters = 2000;

const std::map<std::string, Operation>& functions() {
  static const std::map<std::string, Operation> all{
      {"exp", Operation::exp},   {"log", Operation::log},   {"log10", Operation::log10},
      {"sqrt", Operation::sqrt}, {"sin", Operation::sin},   {"cos", Operation::cos},
      {"tan", Operation::tan},   {"asin", Operation::asin}, {"acos", Operation::acos},
      {"atan", Operation::atan}, {"sinh", Operation::sinh}, {"cosh", Operation::cosh},
      {"tanh", Operation::tanh}, {"erf", Operation::erf}};
  return all;
}

enum Token { name, number, plus, minus, times, over, power, open, close, comma, numTokens };

enum Production {
  formulaIsSum,
  sumIsProduct,
  sumAdds,
  sumSubtracts,
  productIsUnary,
  productMultiplies,
  productDivides,
  unaryIsPower,
  unaryNegates,
  powerIsAtom,
  powerRaises,
  atomIsNumber,
  atomIsName,
  atomIsCall,
  atomIsSum,
  argumentsBegin,
  argumentsGoOn,
  numProductions
};

/// The tables of the parser; spaces belong to the token before them.
Teuchos::ReaderTablesPtr readerTables() {
  static const Teuchos::ReaderTablesPtr made = [] {
    Teuchos::Language l;
    l.tokens.resize(numTokens);
    const std::string space = "[ \t\r\n]*";
    l.tokens[name]("name", "[_a-zA-Z][_a-zA-Z0-9]*" + space);
    l.tokens[number]("number", "([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][\\+\\-]?[0-9]+)?" + space);
    l.tokens[plus]("+", "\\+" + space);
    l.tokens[minus]("-", "\\-" + space);
    l.tokens[times]("*", "\\*" + space);
    l.tokens[over]("/", "/" + space);
    l.tokens[power]("^", "(\\^|\\*\\*)" + space);
    l.tokens[open]("(", "\\(" + space);
    l.tokens[close](")", "\\)" + space);
    l.tokens[comma](",", "," + space);
    l.productions.resize(numProductions);
    auto& p = l.productions;
    p[formulaIsSum]("formula") >> "sum";
    p[sumIsProduct]("sum") >> "product";
    p[sumAdds]("sum") >> "sum", "+", "product";
    p[sumSubtracts]("sum") >> "sum", "-", "product";
    p[productIsUnary]("product") >> "unary";
    p[productMultiplies]("product") >> "product", "*", "unary";
    p[productDivides]("product") >> "product", "/", "unary";
    p[unaryIsPower]("unary") >> "power";
    p[unaryNegates]("unary") >> "-", "unary";
    p[powerIsAtom]("power") >> "atom";
    p[powerRaises]("power") >> "atom", "^", "unary";
    p[atomIsNumber]("atom") >> "number";
    p[atomIsName]("atom") >> "name";
    p[atomIsCall]("atom") >> "name", "(", "arguments", ")";
    p[atomIsSum]("atom") >> "(", "sum", ")";
    p[argumentsBegin]("arguments") >> "sum";
    p[argumentsGoOn]("arguments") >> "arguments", ",", "sum";
    return Teuchos::make_reader_tables(l);
  }();
  return made;
}

/// A part of a formula for a message of one line; no formula has other characters than those of ASCII that
/// show.
std::string shown(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = c == '\t' || c == '\r' || c == '\n' ? ' ' : '?';
  return text;
}

/// "a, b, c", the keys of a map.
template <class Map>
std::string namesIn(const Map& map) {
  std::string all;
  for (const auto& entry : map) all += (all.empty() ? "" : ", ") + entry.first;
  return all;
}

/// Builds steps as the parser reduces. Values on the parser's stack are numbers of operands_ (sums and
/// their parts), of texts_ (names, numbers), or of lists_ (arguments).
class FormulaReader final : public Teuchos::Reader {
 public:
  FormulaReader(const Symbols& symbols, Builder& builder)
      : Teuchos::Reader(readerTables()), symbols_(symbols), builder_(builder) {}

  int stepOf(int operand) const { return scalar(operands_[operand]); }
  /// How far the text was understood.
  std::size_t read() const { return read_; }

 private:
  /// A number, or the gradient of a field.
  struct Operand {
    int step = -1;
    const std::vector<int>* gradient = nullptr;
  };

  void at_shift(Teuchos::any& result, int, std::string& text) override {
    read_ += text.size();
    texts_.push_back(text.substr(0, text.find_last_not_of(" \t\r\n") + 1));
    result = static_cast<int>(texts_.size()) - 1;
  }

  void at_reduce(Teuchos::any& result, int production, std::vector<Teuchos::any>& rhs) override {
    const auto at = [&](std::size_t i) { return Teuchos::any_cast<int>(rhs[i]); };
    const auto binary = [&](Operation operation) {
      return put(builder_.binary(operation, scalar(operands_[at(0)]), scalar(operands_[at(2)])));
    };
    switch (production) {
      case sumAdds:
        result = binary(Operation::add);
        return;
      case sumSubtracts:
        result = binary(Operation::subtract);
        return;
      case productMultiplies:
        result = binary(Operation::multiply);
        return;
      case productDivides:
        result = binary(Operation::divide);
        return;
      case powerRaises:
        result = binary(Operation::powerOf);
        return;
      case unaryNegates:
        result = put(builder_.unary(Operation::negate, scalar(operands_[at(1)])));
        return;
      case atomIsNumber:
        result = put(builder_.number(numberOf(texts_[at(0)])));
        return;
      case atomIsName:
        result = variable(texts_[at(0)]);
        return;
      case atomIsCall:
        result = call(texts_[at(0)], lists_[at(2)]);
        return;
      case atomIsSum:
        result = at(1);
        return;
      case argumentsBegin:
        lists_.push_back({at(0)});
        result = static_cast<int>(lists_.size()) - 1;
        return;
      case argumentsGoOn:
        lists_[at(0)].push_back(at(2));
        result = at(0);
        return;
      default:
        result = at(0);
    }
  }

  int put(int step) {
    operands_.push_back({step, nullptr});
    return static_cast<int>(operands_.size()) - 1;
  }

  static double numberOf(const std::string& text) {
    const double value = std::strtod(text.c_str(), nullptr);
    if (!std::isfinite(value)) throw FormulaError("has a number that is too large: " + text);
    return value;
  }

  int scalar(const Operand& operand) const {
    if (operand.gradient != nullptr)
      throw FormulaError("has a gradient where a number must be; expected dot(grad(a), grad(b))");
    return operand.step;
  }

  int variable(const std::string& text) {
    if (const auto known = symbols_.scalars.find(text); known != symbols_.scalars.end())
      return put(known->second);
    if (text == "pi") return put(builder_.number(std::acos(-1.0)));
    throw FormulaError("does not know '" + text + "'; known are " + namesIn(symbols_.scalars) + ", pi");
  }

  int call(const std::string& function, const std::vector<int>& arguments) {
    const auto require = [&](std::size_t count) {
      if (arguments.size() != count)
        throw FormulaError("calls " + function + " with " + std::to_string(arguments.size()) +
                           " arguments; expected " + std::to_string(count));
    };
    if (function == "pow") {
      require(2);
      return put(builder_.binary(Operation::powerOf, scalar(operands_[arguments[0]]),
                                 scalar(operands_[arguments[1]])));
    }
    if (function == "grad") {
      require(1);
      const int step = operands_[arguments[0]].step;
      for (const auto& [field, gradient] : symbols_.gradients)
        if (step >= 0 && symbols_.scalars.at(field) == step) {
          operands_.push_back({-1, &gradient});
          return static_cast<int>(operands_.size()) - 1;
        }
      throw FormulaError(symbols_.gradients.empty() ? "has grad where no field has a gradient"
                                                    : "has grad of something that is no field; expected " +
                                                          namesIn(symbols_.gradients));
    }
    if (function == "dot") {
      require(2);
      const auto *a = operands_[arguments[0]].gradient, *b = operands_[arguments[1]].gradient;
      if (a == nullptr || b == nullptr)
        throw FormulaError("has dot of numbers; expected dot(grad(a), grad(b))");
      int sum = builder_.number(0);
      for (std::size_t i = 0; i < a->size(); ++i)
        sum = builder_.binary(Operation::add, sum, builder_.binary(Operation::multiply, (*a)[i], (*b)[i]));
      return put(sum);
    }
    const auto known = functions().find(function);
    if (known == functions().end())
      throw FormulaError("does not know the function '" + function + "'; known are " + namesIn(functions()) +
                         ", pow, dot, grad");
    require(1);
    return put(builder_.unary(known->second, scalar(operands_[arguments[0]])));
  }

  const Symbols& symbols_;
  Builder& builder_;
  std::vector<Operand> operands_;
  std::vector<std::string> texts_;
  std::vector<std::vector<int>> lists_;
  std::size_t read_ = 0;
};

}  // namespace

int parse(const std::string& text, const Symbols& symbols, Builder& builder) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) throw FormulaError("is empty; expected a formula");
  if (text.size() > mostCharacters)
    throw FormulaError("is longer than " + std::to_string(mostCharacters) + " characters");
  const std::string all = text.substr(begin);
  FormulaReader reader(symbols, builder);
  Teuchos::any result;
  try {
    reader.read_string(result, all, "formula");
  } catch (const Teuchos::ParserFail&) {
    const std::size_t at = std::min(reader.read(), all.size());
    if (at == all.size()) throw FormulaError("is no formula: it ends too early");
    if (at == 0) throw FormulaError("is no formula: it cannot begin with '" + shown(all.substr(0, 1)) + "'");
    throw FormulaError("is no formula: it cannot go on with '" + shown(all.substr(at, 1)) + "' after '" +
                       shown(all.substr(0, at)) + "'");
  }
  return reader.stepOf(Teuchos::any_cast<int>(result));
}

bool isName(const std::string& name) {
  const auto letter = [](char c) { return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inside = [&](char c) { return letter(c) || (c >= '0' && c <= '9'); };
  return !name.empty() && letter(name.front()) && std::all_of(name.begin(), name.end(), inside) &&
         functions().count(name) == 0 && name != "pow" && name != "dot" && name != "grad" && name != "pi";
}

}  // namespace atrapos::formula

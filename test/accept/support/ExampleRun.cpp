#include "support/ExampleRun.hpp"

#include <stdexcept>

namespace atrapos::test {
namespace {

void mustEndWell(const CommandResult& r) {
  if (r.exitCode != 0) throw std::runtime_error("exit code " + std::to_string(r.exitCode) + ": " + r.err);
}

/// The deck with output/residuals: points, so that the residual is judged inside steps too.
std::string withAllResiduals(std::string text) {
  if (text.find("residuals:") != std::string::npos) return text;
  const std::size_t output = text.find("\noutput:");
  if (output == std::string::npos) return text + "\noutput: {residuals: points}\n";
  const std::size_t value = output + std::string("\noutput:").size();
  return text[value] == '\n' ? text.insert(value, "\n  residuals: points")
                             : text.insert(text.find('{', value) + 1, "residuals: points, ");
}

}  // namespace

ExampleFolder::ExampleFolder(const std::string& name, const Edits& edits) {
  std::string text = readFile(std::filesystem::path(ATRAPOS_EXAMPLES) / name);
  for (const auto& [from, to] : edits) text = edited(text, from, to);
  writeFile(deck(), withAllResiduals(text));
  // Model problems need no mesh.
  if (text.find("generate:") != std::string::npos)
    mustEndWell(runAtrapos({"mesh", "-q", "deck.yaml"}, path()));
  const auto model = (std::filesystem::path(ATRAPOS_EXAMPLES) / name).replace_extension("inp");
  if (std::filesystem::exists(model)) {
    const std::string file = model.filename().string(), mesh = model.stem().string() + ".exo";
    writeFile(path() / file, readFile(model));
    mustEndWell(runAtrapos({"import", "-q", file, "-o", mesh}, path()));
  }
}

std::vector<std::string> ExampleFolder::run(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run", "-q", "deck.yaml", "-o", "results"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

ExampleRun::ExampleRun(const std::string& name, const Edits& edits, const std::vector<std::string>& arguments)
    : folder(name, edits) {
  // Under sanitizers or without optimisation a run takes twenty times as long as in the release build.
  constexpr double limit = 1200;
  mustEndWell(runAtrapos(ExampleFolder::run(arguments), folder.path(), limit));
  path = std::make_unique<Table>(folder.results("path.csv"));
  summary = nlohmann::json::parse(readFile(folder.results("summary.json")));
}

}  // namespace atrapos::test

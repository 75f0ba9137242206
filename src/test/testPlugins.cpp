// Physics from shared libraries: what they compute, and that nothing but the command line loads one.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/Command.hpp"
#include "support/Folder.hpp"

using namespace atrapos::test;

namespace {

const std::string exampleDeck = readFile(std::string(ATRAPOS_EXAMPLES) + "/embedding/plugin/film.yaml");

/// A folder with a deck and its mesh.
struct Film {
  TemporaryFolder folder;

  explicit Film(const std::string& deck = exampleDeck) {
    // Of the whole deck's divisions; the deck itself may be one that is refused.
    const std::string divisions =
        deck.substr(deck.find("divisions: "), deck.find(", lengths") - deck.find("divisions: "));
    writeFile(folder / "mesh.yaml", edited(exampleDeck, "divisions: [32, 1]", divisions));
    EXPECT_EQ(runAtrapos({"mesh", "-q", "mesh.yaml"}, folder.path()).exitCode, 0);
    writeFile(folder / "film.yaml", deck);
  }
  CommandResult run(const std::vector<std::string>& plugins, int ranks = 1) const {
    std::vector<std::string> words{"run", "-q", "-o", "results", "film.yaml"};
    for (const std::string& file : plugins) words.insert(words.end(), {"--plugin", file});
    return ranks == 1 ? runAtrapos(words, folder.path()) : runAtraposOnRanks(ranks, words, folder.path());
  }
  nlohmann::json summary() const { return nlohmann::json::parse(readFile(folder / "results/summary.json")); }
  /// [row][column] of path.csv: load factor and the monitor.
  std::vector<std::pair<double, double>> path() const {
    std::vector<std::pair<double, double>> rows;
    std::istringstream text(readFile(folder / "results/path.csv"));
    std::string line;
    std::getline(text, line);
    while (std::getline(text, line)) {
      double length = 0, load = 0, value = 0;
      int step = 0;
      EXPECT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &step, &length, &load, &value), 4) << line;
      rows.emplace_back(load, value);
    }
    return rows;
  }
};

/// One line, exit code 2, and no results.
void expectRefused(const std::string& deck, const std::vector<std::string>& plugins,
                   const std::string& words) {
  const Film film(deck);
  const CommandResult r = film.run(plugins);
  EXPECT_EQ(r.exitCode, 2) << r.out << r.err;
  ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
  EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
  EXPECT_FALSE(std::filesystem::exists(film.folder / "results"));
}

std::string changed(const std::string& from, const std::string& to) { return edited(exampleDeck, from, to); }

}  // namespace

/// An arc of radius 1/lambda between wires at a distance of 1: its middle is R - sqrt(R^2 - 1/4) high. The
/// mesh's error falls like that of a functional of quadratic cells.
TEST(Plugins, FilmBetweenWires) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const Film film(changed("[32, 1]", i == 0 ? "[8, 1]" : "[16, 1]"));
    const CommandResult r = film.run({PLUGIN_soap});
    ASSERT_EQ(r.exitCode, 0) << r.err;
    error[i] = 0;
    for (const auto& [load, middle] : film.path()) {
      const double arc = load == 0 ? 0 : 1 / load - std::sqrt(1 / (load * load) - 0.25);
      error[i] = std::max(error[i], std::abs(middle - arc));
    }
    EXPECT_EQ(film.summary().at("plugins").at(0).at("name"), "soap");
    EXPECT_LE(film.summary().at("steps"), 8);
  }
  EXPECT_LT(error[1], 1e-4);
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5);
}

/// Without pressure the film is straight: sin of its angle is the force at its free side by the tension.
TEST(Plugins, LoadOnASide) {
  std::string deck = changed("parameters: {pressure: 1}", "parameters: {tension: 2}");
  deck = edited(deck, "  wires_right: {set: x_max, field: u, value: 0}\n", "");
  deck = edited(
      deck, "path:\n",
      "loads:\n  edge: {type: plugin, law: pull, set: x_max, fields: [u], parameters: {force: 1}}\npath:\n");
  deck = edited(deck, "set: y_min, near: [0.5, 0, 0]", "set: x_max");
  const Film film(deck);
  const CommandResult r = film.run({PLUGIN_soap});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  for (const auto& [load, edge] : film.path()) {
    const double sine = load / 2;
    // Linear: the cells have it; a residual within 1e-6 of the forces, by a stiffness that falls like cos^3.
    EXPECT_NEAR(edge, sine / std::sqrt(1 - sine * sine), 1e-5);
  }
}

TEST(Plugins, OnSeveralRanks) {
  const Film film;
  ASSERT_EQ(film.run({PLUGIN_soap}).exitCode, 0);
  const auto one = film.path();
  const CommandResult r = film.run({PLUGIN_soap}, 2);
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const auto two = film.path();
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i].second, two[i].second, 1e-10);
}

/// A deck that comes by mail cannot load anything: neither by a name with the library beside it, nor by a
/// file.
TEST(Plugins, NothingButTheCommandLineLoadsOne) {
  const Film film;
  for (const char* name : {"soap.so", "soap", "libsoap.so"})
    std::filesystem::copy_file(PLUGIN_soap, film.folder / name);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", "-q", "film.yaml"},
                                                {"check", "film.yaml"},
                                                {"map", "-q", "film.yaml"}}) {
    const CommandResult r = runAtrapos(words, film.folder.path());
    EXPECT_EQ(r.exitCode, 2) << words[0] << r.out;
    EXPECT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find("film.yaml:4:"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("needs the plug-in 'soap', which is a program, not data"), std::string::npos)
        << r.err;
    EXPECT_NE(r.err.find("say where it is with --plugin FILE"), std::string::npos) << r.err;
  }
  const std::string file = "is no name of a plug-in; expected a name, whose file the command line says";
  for (const char* bad : {"./soap.so", "/tmp/soap.so", "soap.so"}) {
    writeFile(film.folder / "film.yaml", changed("[soap]", std::string("[") + bad + "]"));
    const CommandResult r =
        runAtrapos({"run", "-q", "film.yaml", "--plugin", PLUGIN_soap}, film.folder.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.err.find(file), std::string::npos) << r.err;
  }
}

/// With consent `check` and `map` take it, too.
TEST(Plugins, CheckAndMap) {
  const Film film;
  EXPECT_EQ(runAtrapos({"check", "film.yaml", "--plugin", PLUGIN_soap}, film.folder.path()).exitCode, 0);
  EXPECT_EQ(
      runAtrapos({"map", "-q", "film.yaml", "--orders", "10", "--deltas", "1e-6", "--plugin", PLUGIN_soap},
                 film.folder.path())
          .exitCode,
      0);
}

TEST(Plugins, LibrariesThatDoNotFit) {
  expectRefused(exampleDeck, {"nowhere.so"}, "atrapos: --plugin nowhere.so: there is no such file");
  expectRefused(exampleDeck, {"film.yaml"}, "--plugin film.yaml: cannot be loaded: ");
  expectRefused(exampleDeck, {PLUGIN_noPlugin}, "is no plug-in of Atrapos, it has no 'atrapos_plugin'");
  expectRefused(exampleDeck, {PLUGIN_otherCompiler}, "was compiled with (interface 1, compiler 99.1.0, ");
  expectRefused(exampleDeck, {PLUGIN_soap, PLUGIN_soap}, "its name 'soap' is that of ");
}

TEST(Plugins, DecksThatDoNotFit) {
  expectRefused(changed("plugins: [soap]\n", ""), {PLUGIN_soap},
                "physics/film/law: needs the block plugins, with the name of the plug-in that has it");
  // Loaded, but not named: it does not serve this deck.
  expectRefused(changed("[soap]", "[wrong]"), {PLUGIN_soap, PLUGIN_wrongLaws},
                "physics/film/law: the deck's plug-ins have no 'film' here, only: short, throwing, none");
  expectRefused(changed("fields: [u]", "fields: [u, w]"), {PLUGIN_soap},
                "physics/film/fields: has 2 fields; expected 1");
  expectRefused(changed("fields: [u]", "fields: [u, u]"), {PLUGIN_soap},
                "physics/film/fields: 'u' is given twice");
  expectRefused(changed("{pressure: 1}", "{presure: 1}"), {PLUGIN_soap},
                "physics/film/parameters: 'film' has no parameter 'presure', only: pressure, tension");
  expectRefused(changed("{pressure: 1}", "{pressure: much}"), {PLUGIN_soap},
                "physics/film/parameters/pressure: expected a finite number");
  const std::string edge = "loads:\n  edge: {type: plugin, law: pull, set: x_max, fields: [u]}\npath:\n";
  expectRefused(changed("path:\n", edge), {PLUGIN_soap},
                "loads/edge: 'pull' needs parameters/force, a number");
  const auto wrong = [](const std::string& law) {
    return edited(edited(changed("[soap]", "[wrong]"), "law: film", "law: " + law),
                  ", parameters: {pressure: 1}", "");
  };
  expectRefused(wrong("short"), {PLUGIN_wrongLaws},
                "physics/film: a law with 1 inputs, 1 outputs, 0 data; expected 4");
  expectRefused(wrong("throwing"), {PLUGIN_wrongLaws}, "physics/film: tension must be positive");
  expectRefused(wrong("none"), {PLUGIN_wrongLaws}, "physics/film: 'none' makes no law");
}

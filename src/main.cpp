// The `atrapos` command: deck -> scene -> path -> results. Exit codes: 0 done, 1 internal error, 2 bad input,
// 3 the path could not be continued to a stop of the deck.

#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "Check.hpp"
#include "MapCommand.hpp"
#include "MeshCommand.hpp"
#include "ModelCase.hpp"
#include "Ranks.hpp"
#include "Run.hpp"
#include "SceneCase.hpp"
#include "Version.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/linear/BlasThreads.hpp"

namespace {

constexpr int kBadInput = 2, kCannotContinue = 3, kInternalError = 1;

/// MPI, Kokkos and Tpetra for as long as it lives.
class Runtime {
 public:
  explicit Runtime(int threads) {
    // Without it Kokkos warns at every start; binding is the user's choice.
    setenv("OMP_PROC_BIND", "false", 0);
    MPI_Init(nullptr, nullptr);
    Kokkos::InitArguments arguments;
    arguments.disable_warnings = true;
    if (threads > 0) arguments.num_threads = threads;
    Kokkos::initialize(arguments);
    Tpetra::initialize(nullptr, nullptr);
    // Small fronts: a threaded BLAS costs more than it gives (docs/install.md).
    atrapos::linear::setBlasThreads(1);
    atrapos::ranks::open();
  }
  ~Runtime() {
    atrapos::ranks::close();
    Tpetra::finalize();
    Kokkos::finalize();
    MPI_Finalize();
  }
};

/// The exit code of f, or what its error means; its one line has been told to the user then.
template <class F>
int reported(const std::string& named, const F& f) {
  const auto fail = [](const std::string& line, int code) {
    atrapos::ranks::fail(line, code);
    return code;
  };
  try {
    return f();
  } catch (const atrapos::deck::DeckError& e) {
    return fail(e.what(), kBadInput);
  } catch (const atrapos::exodus::Error& e) {
    return fail(e.what(), kBadInput);
  } catch (const std::invalid_argument& e) {
    return fail(named + e.what(), kBadInput);
  } catch (const std::exception& e) {
    return fail(named + e.what(), kInternalError);
  }
}

/// The same with MPI and Kokkos, which must still be there for errors of several ranks.
template <class F>
int withRuntime(int threads, const std::string& named, const F& f) {
  Runtime runtime(threads);
  return reported(named, f);
}

void requireOneRank(const std::string& what) {
  if (atrapos::ranks::count() > 1)
    throw atrapos::deck::DeckError(fmt::format("atrapos: {} on one rank only: start without mpirun", what));
}

std::string defaultDirectory(const std::string& deck) {
  return std::filesystem::path(deck).stem().string() + "_results";
}

struct RunWords {
  std::string deck, output, restart;
  int fromStep = -1;  ///< -1: not given
  int threads = 0;
  bool quiet = false;
};

int run(const RunWords& words) {
  const int threads = words.threads;
  const auto deck = atrapos::deck::readDeck(words.deck);
  if (threads > 1 && !(Kokkos::DefaultExecutionSpace::concurrency() > 1))
    throw atrapos::deck::DeckError(fmt::format("atrapos: --threads {}: this build runs on {} (one thread)",
                                               threads, Kokkos::DefaultExecutionSpace::name()));
  atrapos::RunOptions options;
  options.restart = words.restart;
  if (words.fromStep >= 0) options.fromStep = words.fromStep;
  options.directory = !words.output.empty()    ? words.output
                      : !words.restart.empty() ? words.restart
                                               : defaultDirectory(words.deck);
  const bool quiet = words.quiet || !atrapos::ranks::isFirst();
  options.progress = quiet ? nullptr : &std::cout;
  const auto follow = [&](atrapos::PathCase& pathCase, const std::string& about) {
    if (!quiet) std::cout << fmt::format("{}\n{}\n", deck.title, about);
    const auto result = atrapos::runPath(pathCase, options);
    if (!quiet || (!result.reachedStop && atrapos::ranks::isFirst()))
      (result.reachedStop ? std::cout : std::cerr)
          << fmt::format("{}\nresults in {}\n", result.text, options.directory);
    return result.reachedStop ? 0 : kCannotContinue;
  };
  if (deck.problem) {
    requireOneRank("problem: model problems run");
    atrapos::ModelCase model(deck);
    return follow(model, model.about());
  }
  atrapos::Scene scene(deck, atrapos::readDeckMesh(deck));
  atrapos::SceneCase pathCase(scene);
  return follow(pathCase, atrapos::describeMesh(scene.mesh()));
}

int map(const atrapos::MapWords& words) {
  atrapos::MapOptions options = atrapos::mapOptions(words);
  options.progress = words.quiet ? nullptr : &std::cout;
  std::vector<atrapos::deck::Deck> decks;
  for (const std::string& deck : words.decks) decks.push_back(atrapos::deck::readDeck(deck));
  requireOneRank("map runs");
  std::vector<std::unique_ptr<atrapos::Scene>> scenes;
  std::vector<std::unique_ptr<atrapos::PathCase>> cases;
  for (const auto& deck : decks) {
    if (deck.problem) {
      cases.push_back(std::make_unique<atrapos::ModelCase>(deck));
      continue;
    }
    scenes.push_back(std::make_unique<atrapos::Scene>(deck, atrapos::readDeckMesh(deck)));
    cases.push_back(std::make_unique<atrapos::SceneCase>(*scenes.back()));
  }
  atrapos::writeMap(cases, options);
  return 0;
}

int makeMesh(const std::string& deckFile, const std::string& output, bool quiet) {
  const auto deck = atrapos::deck::readDeck(deckFile);
  const auto mesh = atrapos::generateMesh(deck);
  const std::string file = output.empty() ? deck.mesh.path : output;
  atrapos::exodus::writeMesh(mesh, file);
  if (!quiet) std::cout << fmt::format("{}: {}\n", file, atrapos::describeMesh(mesh));
  return 0;
}

int check(const std::string& deckFile) {
  const auto deck = atrapos::deck::readDeck(deckFile);
  requireOneRank("check runs");
  if (deck.problem) {
    atrapos::printCheck(atrapos::ModelCase(deck), std::cout);
    return 0;
  }
  atrapos::Scene scene(deck, atrapos::readDeckMesh(deck));
  atrapos::printCheck(scene, std::cout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Traces solution paths of nonlinear finite-element problems with high-order Taylor series"};
  app.set_version_flag("--version", std::string("atrapos ") + atrapos::kVersion);
  // A missing command and stray words are found below: CLI11 would not name them.
  app.require_subcommand(0, 1);
  app.allow_extras();
  std::string deck, output;
  int threads = 0;
  bool quiet = false;
  RunWords words;

  auto* runCommand = app.add_subcommand("run", "follow the path of a deck");
  runCommand->add_option("DECK", deck, "YAML deck (docs/deck.md)")->required();
  runCommand->add_option("-o,--output", output, "folder for the results (default: <deck>_results here)");
  runCommand->add_option("-t,--threads", threads, "threads of the element loops (default: OMP_NUM_THREADS)")
      ->check(CLI::Range(1, 4096));
  runCommand->add_flag("-q,--quiet", quiet, "no progress lines");
  auto* restartOption = runCommand->add_option(
      "--restart", words.restart, "go on with the run whose results are in this folder (default output)");
  runCommand->add_option("--from", words.fromStep, "with --restart: behind this step (default: its last)")
      ->check(CLI::Range(1, 1000000000))
      ->needs(restartOption);

  auto* meshCommand = app.add_subcommand("mesh", "make the mesh file that a deck describes");
  meshCommand->add_option("DECK", deck, "YAML deck with mesh/generate")->required();
  meshCommand->add_option("-o,--output", output, "Exodus file (default: the deck's mesh/file)");
  meshCommand->add_flag("-q,--quiet", quiet, "print nothing");

  auto* checkCommand =
      app.add_subcommand("check", "validate a deck and its mesh, print what would be solved");
  checkCommand->add_option("DECK", deck, "YAML deck")->required();

  atrapos::MapWords mapWords;
  auto* mapCommand =
      app.add_subcommand("map", "follow decks' paths under many settings: where do runs fail?");
  mapCommand->add_option("DECK", mapWords.decks, "YAML decks")->required();
  mapCommand->add_option("--orders", mapWords.orders, "orders, or auto (default: 5,10,15,20,30,40)")
      ->delimiter(',')
      ->expected(1)
      ->take_all();
  mapCommand->add_option("--deltas", mapWords.deltas, "accuracies (default: 1e-2,1e-4,1e-6,1e-8,1e-10)")
      ->delimiter(',')
      ->expected(1)
      ->take_all();
  mapCommand->add_option("--pade", mapWords.pades, "off, automatic, on (default: off,automatic)")
      ->delimiter(',')
      ->expected(1)
      ->take_all();
  mapCommand->add_option("-o,--output", mapWords.output, "table (default: map.csv)");
  mapCommand->add_flag("-q,--quiet", mapWords.quiet, "print nothing");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    std::cerr << fmt::format("atrapos: {} (see atrapos --help)\n", e.what());
    return kBadInput;
  }

  const bool hasCommand = !app.get_subcommands().empty();
  const auto extras = app.remaining(true);
  if (!hasCommand || !extras.empty()) {
    std::cerr << (extras.empty() ? "atrapos: a command is needed: run, mesh, check or map"
                  : hasCommand   ? fmt::format("atrapos: '{}' is not expected", extras.front())
                                 : fmt::format("atrapos: '{}' is not a command: run, mesh, check or map",
                                               extras.front()))
              << " (see atrapos --help)\n";
    return kBadInput;
  }
  const std::string named = deck.empty() ? "atrapos: " : deck + ": ";
  return reported(named, [&] {
    if (*runCommand) {
      words.deck = deck;
      words.output = output;
      words.threads = threads;
      words.quiet = quiet;
      return withRuntime(threads, named, [&] { return run(words); });
    }
    if (*meshCommand) return makeMesh(deck, output, quiet);
    if (*checkCommand) return withRuntime(0, named, [&] { return check(deck); });
    if (*mapCommand) return withRuntime(0, named, [&] { return map(mapWords); });
    return kInternalError;
  });
}

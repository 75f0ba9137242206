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

#include "Check.hpp"
#include "MeshCommand.hpp"
#include "Run.hpp"
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
  }
  ~Runtime() {
    Tpetra::finalize();
    Kokkos::finalize();
    MPI_Finalize();
  }
};

std::string defaultDirectory(const std::string& deck) {
  return std::filesystem::path(deck).stem().string() + "_results";
}

int run(const std::string& deckFile, const std::string& output, int threads, bool quiet) {
  const auto deck = atrapos::deck::readDeck(deckFile);
  Runtime runtime(threads);
  if (threads > 1 && !(Kokkos::DefaultExecutionSpace::concurrency() > 1))
    throw atrapos::deck::DeckError(fmt::format("atrapos: --threads {}: this build runs on {} (one thread)",
                                               threads, Kokkos::DefaultExecutionSpace::name()));
  atrapos::Scene scene(deck, atrapos::readDeckMesh(deck));
  atrapos::RunOptions options;
  options.directory = output.empty() ? defaultDirectory(deckFile) : output;
  options.progress = quiet ? nullptr : &std::cout;
  if (!quiet) std::cout << fmt::format("{}\n{}\n", deck.title, atrapos::describeMesh(scene.mesh()));
  const auto result = atrapos::runScene(scene, options);
  if (!quiet || !result.reachedStop)
    (result.reachedStop ? std::cout : std::cerr)
        << fmt::format("{}\nresults in {}\n", result.text, options.directory);
  return result.reachedStop ? 0 : kCannotContinue;
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
  Runtime runtime(0);
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

  auto* runCommand = app.add_subcommand("run", "follow the path of a deck");
  runCommand->add_option("DECK", deck, "YAML deck (docs/deck.md)")->required();
  runCommand->add_option("-o,--output", output, "folder for the results (default: <deck>_results here)");
  runCommand->add_option("-t,--threads", threads, "threads of the element loops (default: OMP_NUM_THREADS)")
      ->check(CLI::Range(1, 4096));
  runCommand->add_flag("-q,--quiet", quiet, "no progress lines");

  auto* meshCommand = app.add_subcommand("mesh", "make the mesh file that a deck describes");
  meshCommand->add_option("DECK", deck, "YAML deck with mesh/generate")->required();
  meshCommand->add_option("-o,--output", output, "Exodus file (default: the deck's mesh/file)");
  meshCommand->add_flag("-q,--quiet", quiet, "print nothing");

  auto* checkCommand =
      app.add_subcommand("check", "validate a deck and its mesh, print what would be solved");
  checkCommand->add_option("DECK", deck, "YAML deck")->required();

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
    std::cerr << (extras.empty() ? "atrapos: a command is needed: run, mesh or check"
                  : hasCommand
                      ? fmt::format("atrapos: '{}' is not expected", extras.front())
                      : fmt::format("atrapos: '{}' is not a command: run, mesh or check", extras.front()))
              << " (see atrapos --help)\n";
    return kBadInput;
  }
  try {
    if (*runCommand) return run(deck, output, threads, quiet);
    if (*meshCommand) return makeMesh(deck, output, quiet);
    if (*checkCommand) return check(deck);
  } catch (const atrapos::deck::DeckError& e) {
    std::cerr << e.what() << '\n';
    return kBadInput;
  } catch (const atrapos::exodus::Error& e) {
    std::cerr << e.what() << '\n';
    return kBadInput;
  } catch (const std::invalid_argument& e) {
    std::cerr << deck << ": " << e.what() << '\n';
    return kBadInput;
  } catch (const std::exception& e) {
    std::cerr << deck << ": " << e.what() << '\n';
    return kInternalError;
  }
  return kInternalError;
}

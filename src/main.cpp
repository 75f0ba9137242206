// The `atrapos` command: deck -> scene -> path -> results. Exit codes: 0 done, 1 internal error, 2 bad input,
// a file that cannot be written or too little memory, 3 the path could not be continued to a stop of the
// deck.

#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <Kokkos_Core.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

#include "Version.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/fem/Processor.hpp"
#include "atrapos/linear/NoMemory.hpp"
#include "commands/ChartCommand.hpp"
#include "commands/FollowDeck.hpp"
#include "commands/ImportCommand.hpp"
#include "commands/JoinCommand.hpp"
#include "commands/MapCommand.hpp"
#include "commands/PlotCommand.hpp"
#include "commands/ReportCommand.hpp"
#include "commands/SplitCommand.hpp"
#include "import/Import.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "machine/Runtime.hpp"
#include "machine/Threads.hpp"
#include "output/Files.hpp"
#include "output/RunLog.hpp"
#include "plugin/Plugins.hpp"

namespace {

constexpr int kBadInput = 2, kCannotContinue = 3, kInternalError = 1;

/// Made before memory is lacking, and told once: what runs out of it may do so again on its way out.
std::string noMemory = "atrapos: out of memory";
bool noMemoryTold = false;
std::terminate_handler otherTermination = nullptr;

/// Where there was no memory even for what an error does on its way up: the same line, the same exit code.
[[noreturn]] void onTermination() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::exception& e) {
    if (atrapos::linear::isNoMemory(e)) {
      if (!noMemoryTold) std::fprintf(stderr, "%s\n", noMemory.c_str());
      std::_Exit(kBadInput);
    }
  } catch (...) {  // whatever it is, it is told below
  }
  otherTermination();
  std::abort();
}

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
  } catch (const atrapos::importer::Error& e) {
    return fail(e.what(), kBadInput);
  } catch (const atrapos::FileError& e) {
    return fail(e.what(), kBadInput);
  } catch (const std::filesystem::filesystem_error& e) {
    return fail(fmt::format("{}: {}", e.path1().empty() ? named : e.path1().string(), e.code().message()),
                kBadInput);
  } catch (const std::invalid_argument& e) {
    return fail(named + e.what(), kBadInput);
  } catch (const std::exception& e) {
    if (atrapos::linear::isNoMemory(e)) {
      if (!std::exchange(noMemoryTold, true)) fail(noMemory, kBadInput);
      return kBadInput;
    }

    return fail(named + e.what(), kInternalError);
  }
}

/// The same with MPI and Kokkos, which must still be there for errors of several ranks.
template <class F>
int withRuntime(int threads, const std::string& named, const F& f) {
  atrapos::Runtime runtime(threads);
  return reported(named, f);
}

std::string defaultDirectory(const std::string& deck) {
  return std::filesystem::path(deck).stem().string() + "_results";
}

/// They are code, and loaded because the command line says so, before any deck is read.
void loadPlugins(const std::vector<std::string>& files) {
  for (const std::string& file : files) try {
      atrapos::plugins::load(file);
    } catch (const std::invalid_argument& e) {
      throw atrapos::deck::DeckError(fmt::format("atrapos: --plugin {}", e.what()));
    }
}

struct RunWords {
  std::string deck, output, restart;
  std::string from;  ///< STEP or BRANCH:STEP; empty: not given
  int threads = 0;
  bool quiet = false;
};

atrapos::RestartPlace placeOf(const std::string& word) {
  atrapos::RestartPlace place;
  int end = 0;
  const char* text = word.c_str();
  const bool onBranch = std::sscanf(text, "%d:%d%n", &place.branch, &place.step, &end) == 2;
  if (!onBranch) {
    place.branch = end = 0;
    if (std::sscanf(text, "%d%n", &place.step, &end) != 1) place.step = 0;
  }
  if (end != static_cast<int>(word.size()) || place.branch < 0 || place.step < 1)
    throw atrapos::deck::DeckError(
        fmt::format("atrapos: --from '{}': expected a step from 1, or branch:step", word));
  return place;
}

int run(const RunWords& words) {
  const int threads = words.threads;
  const auto deck = atrapos::deck::readDeck(words.deck);
  atrapos::plugins::require(deck);
  if (threads > 1 && !(Kokkos::DefaultExecutionSpace::concurrency() > 1))
    throw atrapos::deck::DeckError(fmt::format("atrapos: --threads {}: this build runs on {} (one thread)",
                                               threads, Kokkos::DefaultExecutionSpace::name()));
  atrapos::RunOptions options;
  options.restart = words.restart;
  if (!words.from.empty()) options.from = placeOf(words.from);
  options.directory = !words.output.empty()    ? words.output
                      : !words.restart.empty() ? words.restart
                                               : defaultDirectory(words.deck);
  const bool quiet = words.quiet || !atrapos::ranks::isFirst();
  options.progress = quiet ? nullptr : &std::cout;
  const auto follow = [&] {
    const auto result = atrapos::followDeck(deck, options, [&](const std::string& line) {
      if (!quiet) std::cout << line << std::endl;
    });
    const std::string page = options.directory + "/report.html";
    const bool toOpen = !quiet && std::filesystem::exists(page);
    if (!quiet || (!result.reachedStop && atrapos::ranks::isFirst()))
      (result.reachedStop ? std::cout : std::cerr)
          << fmt::format("{}\nresults in {}\n", result.text, options.directory)
          << (toOpen ? fmt::format("open {} in a browser\n", page) : "");
    return result.reachedStop ? 0 : kCannotContinue;
  };
  if (deck.problem)  // small: one rank follows it
    return atrapos::ranks::onFirst([&] { return reported(words.deck + ": ", follow); });
  return follow();
}

int map(const atrapos::MapWords& words) {
  // Many short runs, one after another: one rank makes them.
  return atrapos::ranks::onFirst([&] {
    return reported("atrapos: ", [&] {
      atrapos::makeMap(words);
      return 0;
    });
  });
}

int makeMesh(const std::string& deckFile, const std::string& output, bool quiet) {
  const std::string line = atrapos::writeDeckMesh(atrapos::deck::readDeck(deckFile), output);
  if (!quiet) std::cout << line << '\n';
  return 0;
}

void printKeys(const std::string& under) {
  std::stringstream all;
  atrapos::deck::describeKeys(all);
  bool any = false;
  for (std::string line; std::getline(all, line);) {
    if (line.compare(0, under.size(), under) != 0) continue;
    std::cout << line << '\n';
    any = true;
  }
  if (!any)
    throw atrapos::deck::DeckError(fmt::format(
        "atrapos: keys '{}': no key has such a path; expected the beginning of one, as path/stop or tools",
        under));
}

int check(const std::string& deckFile) {
  std::ostream nowhere(nullptr);
  const auto deck = atrapos::deck::readDeck(deckFile);
  atrapos::plugins::require(deck);
  atrapos::checkDeck(deck, atrapos::ranks::isFirst() ? std::cout : nowhere);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  otherTermination = std::set_terminate(onTermination);
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of its size is an error of its writer
  CLI::App app{"Traces solution paths of nonlinear finite-element problems with high-order Taylor series"};
  bool version = false, verbose = false;
  auto* versionFlag = app.add_flag("--version", version, "print the version");
  app.add_flag("--verbose", verbose, "with --version: libraries, ranks and threads too")->needs(versionFlag);
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
  runCommand
      ->add_option(
          "-t,--threads", threads,
          "threads of the element loops a rank (default: OMP_NUM_THREADS, or the rank's share of the "
          "processors)")
      ->check(CLI::Range(1, 4096));
  runCommand->add_flag("-q,--quiet", quiet, "no progress lines");
  auto* restartOption = runCommand->add_option(
      "--restart", words.restart, "go on with the run whose results are in this folder (default output)");
  runCommand
      ->add_option("--from", words.from,
                   "with --restart: behind this STEP, or BRANCH:STEP (default: its last)")
      ->needs(restartOption);

  runCommand->footer("\n" + atrapos::RunLog::columns());

  auto* meshCommand = app.add_subcommand("mesh", "make the mesh file that a deck describes");
  meshCommand->add_option("DECK", deck, "YAML deck with mesh/generate")->required();
  meshCommand->add_option("-o,--output", output, "Exodus file (default: the deck's mesh/file)");
  meshCommand->add_flag("-q,--quiet", quiet, "print nothing");

  atrapos::ImportWords importWords;
  auto* importCommand =
      app.add_subcommand("import",
                         "make a mesh, and a deck, of a file of Abaqus, CalculiX (.inp), Gmsh (.msh) or "
                         "another program that writes Exodus; of STL the surface of a tool; docs/import.md");
  importCommand
      ->add_option("FILE", importWords.file,
                   ".inp of Abaqus or CalculiX, .msh of Gmsh, .exo, .e, .ex2, .g, .gen of Exodus, .stl")
      ->required();
  importCommand->add_option(
      "-o,--output", importWords.output,
      "Exodus file, of STL a YAML file (default: FILE's name with .exo or .yaml, here)");
  importCommand->add_flag("--deck", importWords.deck,
                          "of .inp: write a deck of the same problem beside the mesh, with .yaml; says line "
                          "by line what it leaves out");
  importCommand->add_flag("--shells", importWords.shells,
                          "Gmsh: quadrilaterals in z = 0 are shells (default: a plane body)");
  importCommand->add_option(
      "--along", importWords.along,
      "STL: heights along x, y, z, -x, -y or -z, the free side of the tool (default: z)");
  importCommand
      ->add_option("--cells", importWords.cells,
                   "STL: pieces of the smooth surface in its two directions (default: by the facets)")
      ->expected(2);
  importCommand->add_flag("-q,--quiet", importWords.quiet, "print nothing");

  std::string meshFile;
  int parts = 0;
  auto* splitCommand = app.add_subcommand("split", "cut a mesh into part files for several ranks");
  splitCommand->add_option("MESH", meshFile, "Exodus file")->required();
  splitCommand->add_option("PARTS", parts, "number of parts: that of the ranks")
      ->required()
      ->check(CLI::Range(1, 1000000));
  splitCommand->add_option("-o,--output", output, "name before the parts' numbers (default: MESH)");
  splitCommand->add_flag("-q,--quiet", quiet, "print nothing");

  std::vector<std::string> partFiles;
  auto* joinCommand = app.add_subcommand("join", "make one file of the part files of a mesh or of results");
  joinCommand->add_option("FILE", partFiles, "part files, as results.exo.4.*, or results.exo")->required();
  joinCommand->add_option("-o,--output", output, "Exodus file (default: the parts' name without numbers)");
  joinCommand->add_flag("-q,--quiet", quiet, "print nothing");

  auto* checkCommand =
      app.add_subcommand("check", "validate a deck and its mesh, print what would be solved");
  checkCommand->add_option("DECK", deck, "YAML deck")->required();

  std::string keysUnder;
  auto* keysCommand =
      app.add_subcommand("keys", "print the keys of decks: what each accepts, its default and meaning");
  keysCommand->add_option("PATH", keysUnder,
                          "those whose path begins so, as path/stop or tools (default: all)");

  atrapos::PlotWords plotWords;
  auto* plotCommand = app.add_subcommand("plot", "draw the paths in a folder of results as PNG and SVG");
  plotCommand->add_option("RESULTS", plotWords.folder, "folder that `atrapos run` wrote")->required();
  plotCommand->add_option("-o,--output", plotWords.output,
                          "name of the pictures without .png and .svg (default: path in RESULTS)");
  plotCommand->add_option("-x", plotWords.x, "what to draw over: a monitor, 'load factor' or 'path length'");
  plotCommand->add_option("-y", plotWords.y, "what to draw, in one panel: the same, several with commas")
      ->delimiter(',')
      ->expected(1)
      ->take_all();
  plotCommand->add_flag("-q,--quiet", quiet, "print nothing");

  std::string results;
  auto* reportCommand = app.add_subcommand("report", "make one HTML page of a folder of results");
  reportCommand->add_option("RESULTS", results, "folder that `atrapos run` wrote")->required();
  reportCommand->add_option("-o,--output", output, "the page (default: report.html in RESULTS)");
  reportCommand->add_flag("-q,--quiet", quiet, "print nothing");

  std::string chartFile;
  auto* chartCommand = app.add_subcommand(
      "chart", "make runs of a deck with other values and draw their errors over their work; docs/chart.md");
  chartCommand->add_option("CHART", chartFile, "YAML file that says which deck, runs and reference")
      ->required();
  chartCommand->add_option("-o,--output", output, "folder for the chart (default: <chart>_chart here)");
  chartCommand->add_flag("-q,--quiet", quiet, "print nothing");

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
  mapCommand
      ->add_option("--vary", mapWords.vary,
                   "KEY=LIST: values of a key of the decks, as path/direction=[1, -1]; may be repeated")
      ->expected(1)
      ->take_all();
  mapCommand->add_option("-o,--output", mapWords.output, "table (default: map.csv)");
  mapCommand->add_flag("-q,--quiet", mapWords.quiet, "print nothing");

  std::vector<std::string> pluginFiles;
  for (auto* const command : {runCommand, checkCommand, mapCommand})
    command
        ->add_option("--plugin", pluginFiles,
                     "load this library with physics for decks that name it: a program, which you trust "
                     "(docs/plugins.md); may be said more than once")
        ->expected(1)
        ->take_all();

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);  // --help
  } catch (const CLI::ParseError& e) {
    std::cerr << fmt::format("atrapos: {} (see atrapos --help)\n", e.what());
    return kBadInput;
  }

  if (version && !verbose) {
    std::cout << fmt::format("atrapos {}\n", atrapos::kVersion);
    return 0;
  }
  if (version)
    return withRuntime(0, "atrapos: ", [] {
      const std::string text = atrapos::threads::describeAll(MPI_COMM_WORLD);
      if (atrapos::ranks::isFirst()) std::cout << text;
      return 0;
    });
  const bool hasCommand = !app.get_subcommands().empty();
  const auto extras = app.remaining(true);
  if (!hasCommand || !extras.empty()) {
    std::cerr << (extras.empty() ? "atrapos: a command is needed: run, plot, report, chart, mesh, import, "
                                   "split, join, check, keys or map"
                  : hasCommand   ? fmt::format("atrapos: '{}' is not expected", extras.front())
                                 : fmt::format("atrapos: '{}' is not a command: run, plot, report, chart, "
                                                 "mesh, import, split, join, check, keys or map",
                                               extras.front()))
              << " (see atrapos --help)\n";
    return kBadInput;
  }
  // Before anything is read: a level that is not there is no deck's fault.
  if (const int code =
          reported("atrapos: ", [] { return atrapos::fem::processorLanes() > 0 ? 0 : kInternalError; }))
    return code;
  const std::string named = deck.empty() ? "atrapos: " : deck + ": ";
  noMemory = named + "out of memory";
  return reported(named, [&] {
    if (*runCommand) {
      words.deck = deck;
      words.output = output;
      words.threads = threads;
      words.quiet = quiet;
      return withRuntime(threads, named, [&] {
        loadPlugins(pluginFiles);
        return run(words);
      });
    }
    if (*meshCommand) return makeMesh(deck, output, quiet);
    std::ostream* const progress = quiet ? nullptr : &std::cout;
    if (*importCommand) {
      atrapos::importFile(importWords, std::cout);
      return 0;
    }
    if (*splitCommand) {
      atrapos::splitMesh(meshFile, parts, output, progress);
      return 0;
    }
    if (*joinCommand) {
      atrapos::joinParts(partFiles, output, progress);
      return 0;
    }
    if (*reportCommand) {
      atrapos::reportResults(results, output, progress);
      return 0;
    }
    if (*keysCommand) {
      printKeys(keysUnder);
      return 0;
    }
    if (*plotCommand) {
      atrapos::plotResults(plotWords, progress);
      return 0;
    }
    if (*chartCommand) {
      const std::string stem = std::filesystem::path(chartFile).stem().string();
      atrapos::writeChart(chartFile, output.empty() ? stem + "_chart" : output, progress);
      return 0;
    }
    if (*checkCommand)
      return withRuntime(0, named, [&] {
        loadPlugins(pluginFiles);
        return check(deck);
      });
    if (*mapCommand)
      return withRuntime(0, named, [&] {
        loadPlugins(pluginFiles);
        return map(mapWords);
      });
    return kInternalError;
  });
}

#include "commands/ImportCommand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "commands/GmshProgram.hpp"
#include "commands/MeshCommand.hpp"
#include "deck/Characters.hpp"
#include "deck/Deck.hpp"
#include "deck/Fields.hpp"
#include "import/FitHeights.hpp"
#include "import/Import.hpp"
#include "import/ReadStl.hpp"
#include "import/UsedNodes.hpp"
#include "output/Files.hpp"

namespace atrapos {
namespace {

std::string endingOf(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void requirePlaceForMesh(const std::string& file, const std::string& input) {
  requireOwn(file, Made::mesh, {input});
  std::error_code error;
  if (std::filesystem::exists(file, error) && exodus::ResultReader(file).numSteps() > 0)
    throw std::invalid_argument(fmt::format("{} holds results, which the mesh would replace", file));
}

std::string count(std::size_t n, const std::string& what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string summary(const std::string& file, const fem::Mesh& mesh) {
  return fmt::format("{}: {}, {}, {}\n", file, describeMesh(mesh), count(mesh.nodeSets.size(), "node set"),
                     count(mesh.sideSets.size(), "side set"));
}

void importInp(const ImportWords& words, const std::string& mesh, std::ostream& out) {
  const std::string deckFile = std::filesystem::path(mesh).replace_extension(".yaml").string();
  if (words.deck && deckFile == mesh)
    throw std::invalid_argument(
        fmt::format("{}: is the deck's name, not the mesh's; expected --output as mesh.exo", mesh));
  if (words.deck && std::filesystem::exists(deckFile))
    throw std::invalid_argument(
        fmt::format("{} is there already, and decks are not replaced; expected another --output", deckFile));
  const importer::Model model =
      importer::readInp(words.file, words.deck ? importer::Deck::yes : importer::Deck::no);
  std::string text;
  if (words.deck) {
    text = fmt::format("# Made by atrapos import of {}\nmesh: {{file: {}}}\n{}", deck::plainLine(words.file),
                       deck::yaml(std::filesystem::path(mesh).filename().string()), model.deck);
    deck::readDeckText(text, deckFile);  // constants that no law takes, say
  }
  exodus::writeMesh(model.mesh, mesh);
  if (words.deck) replaceFile(deckFile, text);
  if (words.quiet) return;
  out << summary(mesh, model.mesh);
  if (words.deck) out << fmt::format("{}: a deck, for atrapos run\n", deckFile);
  for (const std::string& remark : model.remarks) out << deck::plainLine(remark) << '\n';
}

void importExodus(const ImportWords& words, const std::string& mesh, std::ostream& out) {
  exodus::ForeignMesh read = exodus::readForeignMesh(words.file);
  const int dropped = importer::dropUnusedNodes(read.mesh);
  exodus::writeMesh(read.mesh, mesh);
  if (words.quiet) return;
  out << summary(mesh, read.mesh);
  for (const std::string& remark : read.remarks) out << deck::plainLine(remark) << '\n';
  if (dropped > 0)
    out << fmt::format("{}: {} left out that no element has\n", words.file,
                       count(static_cast<std::size_t>(dropped), "node"));
}

importer::FitWishes wishes(const ImportWords& words) {
  importer::FitWishes asked;
  if (!words.along.empty()) {
    const bool against = words.along[0] == '-';
    const std::string axis = words.along.substr(against ? 1 : 0);
    if (axis != "x" && axis != "y" && axis != "z")
      throw std::invalid_argument(
          fmt::format("{}: --along {}: expected x, y, z, -x, -y or -z", words.file, words.along));
    asked.along = {};
    asked.along[static_cast<std::size_t>(axis[0] - 'x')] = against ? -1 : 1;
  }
  if (!words.cells.empty()) asked.cells = {words.cells[0], words.cells[1]};
  return asked;
}

std::string yamlText(const importer::FittedSurface& surface, const ImportWords& words) {
  std::string text =
      fmt::format("# Made by atrapos import of {}\nsurfaces:\n  fitted:\n    degree: [3, 3]\n    points:\n",
                  deck::plainLine(words.file));
  for (const auto& point : surface.points) text += fmt::format("      - {}\n", deck::yamlList(point));
  for (std::size_t d = 0; d < 2; ++d)
    text += fmt::format("    knots_{}: {}\n", d + 1, deck::yamlList(surface.knots[d]));
  return text;
}

void importStl(const ImportWords& words, std::ostream& out) {
  const std::string file =
      words.output.empty() ? std::filesystem::path(words.file).stem().string() + ".yaml" : words.output;
  if (std::filesystem::exists(file))
    throw std::invalid_argument(
        fmt::format("{} is there already, and surfaces are not replaced; expected another --output", file));
  const auto surface = importer::fitHeights(importer::readStl(words.file), wishes(words), words.file);
  replaceFile(file, yamlText(surface, words));
  if (words.quiet) return;
  out << fmt::format("{}: a surface of {} x {} cells for a tool: {{type: patches, file: {}}}\n", file,
                     surface.knots[0].size() - 7, surface.knots[1].size() - 7, deck::yaml(file));
  out << fmt::format("{}: corners of {} facets are at most {:.3g} off it, middles {:.3g}\n", words.file,
                     surface.facets, surface.fromCorners, surface.fromFacets);
  if (surface.turnedAway > 0)
    out << fmt::format("{}: {} left out that do not face the axis\n", words.file,
                       count(surface.turnedAway, "facet"));
  if (surface.empty > 0)
    out << fmt::format(
        "{}: over {:.0f} % of the cells there are no facets: the surface goes on smoothly there\n",
        words.file, std::ceil(100 * surface.empty));
}

}  // namespace

void importFile(const ImportWords& words, std::ostream& out) {
  const std::string mesh =
      words.output.empty() ? std::filesystem::path(words.file).stem().string() + ".exo" : words.output;
  const std::string ending = endingOf(words.file);
  const auto refuse = [&](const std::string& what) { throw std::invalid_argument(words.file + ": " + what); };
  const bool isExodus =
      ending == ".exo" || ending == ".e" || ending == ".ex2" || ending == ".g" || ending == ".gen";
  const bool isStl = ending == ".stl";
  if (ending != ".inp" && ending != ".msh" && !isExodus && !isStl)
    refuse(
        "its ending says no format; expected .inp (Abaqus, CalculiX), .msh (Gmsh), or .exo, .e, .ex2, .g, "
        ".gen (Exodus), .stl (tools); others, as .vtu and .vtk, by python3 -m atrapos.from_meshio");
  if (!isStl && (!words.along.empty() || !words.cells.empty()))
    refuse("--along and --cells are for surfaces of tools; expected a file .stl");
  if ((ending == ".msh" || isStl) && words.deck)
    refuse("--deck: a mesh has no materials and no loads; expected a file .inp");
  if (ending != ".msh" && words.shells) refuse("--shells: elements say what they are; expected a file .msh");
  if (isStl) return importStl(words, out);
  requirePlaceForMesh(mesh, words.file);
  if (ending == ".inp") return importInp(words, mesh, out);
  if (isExodus) return importExodus(words, mesh, out);
  runGmshProgram(words.file, mesh, words.shells, words.quiet);
  if (!words.quiet) out << summary(mesh, exodus::readMesh(mesh));
}

}  // namespace atrapos

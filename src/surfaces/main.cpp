// The `atrapos-surfaces` command: faces of a STEP or IGES file -> the YAML file of a deck's tool of type
// patches. Exit codes: 0 done, 2 bad input.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "atrapos/cad/ReadFaces.hpp"

namespace {

using atrapos::cad::Face;

constexpr int kBadInput = 2;

void list(const std::vector<Face>& faces) {
  fmt::print("{:>5}  {:<9} {:<8} {:<8} {:<8} {}\n", "face", "is a", "degree", "points", "edges",
             "box of its points");
  for (const Face& face : faces) {
    const auto& s = face.surface;
    fmt::print("{:>5}  {:<9} {:<8} {:<8} {:<8} [{:.6g}] to [{:.6g}]\n", face.number, face.kind,
               fmt::format("{} x {}", s.degree[0], s.degree[1]),
               fmt::format("{} x {}", s.count[0], s.count[1]), face.trimmed ? "trimmed" : "its own",
               fmt::join(face.box[0], ", "), fmt::join(face.box[1], ", "));
  }
}

void write(const std::vector<Face>& faces, const std::string& file) {
  fmt::print("# Faces of {}\nsurfaces:\n", file);
  for (const Face& face : faces) {
    const auto& s = face.surface;
    fmt::print("  face_{}:  # {}\n    degree: [{}]\n    points:\n", face.number, face.kind,
               fmt::join(s.degree, ", "));
    for (const auto& point : s.points) fmt::print("      - [{}]\n", fmt::join(point, ", "));
    if (!s.weights.empty()) fmt::print("    weights: [{}]\n", fmt::join(s.weights, ", "));
    fmt::print("    knots_1: [{}]\n    knots_2: [{}]\n", fmt::join(s.knots[0], ", "),
               fmt::join(s.knots[1], ", "));
  }
}

/// Those of `all` that are asked for, in the order of the file; throws where one is not there or is trimmed.
std::vector<Face> chosen(const std::vector<Face>& all, const std::vector<int>& numbers, bool whole,
                         const std::string& file) {
  for (const int n : numbers)
    if (n < 1 || n > static_cast<int>(all.size()))
      throw atrapos::cad::Error(fmt::format("{}: has no face {}, only 1 to {}", file, n, all.size()));
  std::vector<Face> faces;
  for (const Face& face : all) {
    if (!numbers.empty() && std::find(numbers.begin(), numbers.end(), face.number) == numbers.end()) continue;
    if (face.trimmed && !whole)
      throw atrapos::cad::Error(
          fmt::format("{}: face {} is trimmed by edges that are not lines of its parameters; choose others "
                      "with --faces, or "
                      "take the whole rectangle of parameters around its edges with --whole",
                      file, face.number));
    faces.push_back(face);
  }
  return faces;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes the faces of a STEP or IGES file as the surfaces of a deck's tool of type patches"};
  std::string file;
  double scale = 1;
  std::vector<int> numbers;
  bool listed = false, whole = false;
  app.add_option("file", file, ".step, .stp, .iges or .igs")->required();
  app.add_option("--faces", numbers, "numbers of faces, e.g. 1,3 (default: all)")->delimiter(',');
  app.add_option("--scale", scale, "the deck's units in a millimetre, e.g. 0.001 for metres")
      ->capture_default_str();
  app.add_flag("--list", listed, "print a table of the faces instead");
  app.add_flag("--whole", whole,
               "take trimmed faces with the whole rectangle of parameters around their edges");
  app.footer(
      "atrapos-surfaces roll.step --faces 1 > roll.yaml, then in the deck: {type: patches, file: roll.yaml}");
  try {
    app.parse(argc, argv);
    const auto faces = atrapos::cad::readFaces(file, scale);
    if (listed)
      list(faces);
    else
      write(chosen(faces, numbers, whole, file), file);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "atrapos-surfaces: error: {}\n", error.what());
    return kBadInput;
  }
}

#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// Nodes that a part has in common with another one.
struct PartBorder {
  int part = 0;            ///< the other one
  std::vector<int> nodes;  ///< of this part, by ascending id: both parts list them in the same order
};

/// How much the whole mesh has of what a part has some of.
struct WholeSizes {
  long long nodes = 0, elements = 0;
  std::vector<long long> blocks;          ///< [block] elements
  std::vector<long long> nodeSets;        ///< [node set] nodes
  std::vector<long long> nodeSetFactors;  ///< [node set] distribution factors
  std::vector<long long> sideSets;        ///< [side set] sides
};

/// What one of several ranks has of a decomposed mesh: some elements and their nodes.
struct MeshPart {
  int part = 0, parts = 1;
  /// The part's own nodes and elements, numbered from 0; nodeIds and elementIds are those of the whole mesh
  /// and never left out. It has all blocks and sets of the whole in the same order, empty ones too (the
  /// topology of an empty block that was read is not known).
  fem::Mesh mesh;
  std::vector<PartBorder> borders;  ///< by ascending part
  WholeSizes whole;
};

/// The name of a part file as SEACAS writes it, with as many digits as the last part needs: part 3 of 16 of
/// mesh.exo is mesh.exo.16.03.
std::string partName(const std::string& file, int parts, int part);

/// A part file's name taken apart.
struct PartName {
  std::string file;
  int parts = 0, part = 0;
};

/// Throws Error where this is not the name of a part file.
PartName parsePartName(const std::string& name);

/// The numbers of parts, ascending, for which files of this name's first or other parts are in its folder.
std::vector<int> findParts(const std::string& file);

/// Reads a part file: a mesh as readMesh does, which may be without elements here, with its ids, sizes and
/// node communication maps (Nemesis). Its number is that in its name. Throws Error as readMesh and
/// parsePartName do, and where the file is not one of as many parts as its name says.
MeshPart readPart(const std::string& name);

/// Writes the part as partName(file, parts, part); throws Error as writeMesh does.
void writePart(const MeshPart& part, const std::string& file);

}  // namespace atrapos::exodus

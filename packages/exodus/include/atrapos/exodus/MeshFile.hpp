#pragma once

#include <string>
#include <vector>

#include "atrapos/exodus/Error.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// Reads the mesh of an Exodus II file (NetCDF classic, 64-bit offset, or NetCDF-4).
///
/// Element types are told by the beginning of their name (HEX, TET, WEDGE or PENTA, SHELL or QUAD; any case)
/// and their node count; quadrilaterals are shells, and their attributes the thickness (fem::shellThickness);
/// BAR and TRUSS are bars.
/// Ids, names, attributes and title are kept; sides become 0-based. Blocks without elements are left out.
/// Node sets have their distribution factors where the file has some. Edge and face blocks, edge, face and
/// element sets, and distribution factors of sides are not read, nor are results (see ResultReader).
///
/// Throws Error where the file is missing, not Exodus, cut short, without nodes or elements, not
/// three-dimensional, of an unsupported element type, or refers to nodes, elements or sides that it does not
/// have. Nothing is printed.
fem::Mesh readMesh(const std::string& file);

/// A mesh with blocks that this program does not compute with.
struct ForeignMesh {
  fem::Mesh mesh;
  std::vector<std::string> remarks;  ///< one line each: what has become of them
};

/// readMesh, where blocks of lines and points (BAR, BEAM, TRUSS, SPHERE, ...) become node sets of their
/// names.
ForeignMesh readForeignMesh(const std::string& file);

/// Writes a mesh as an Exodus II file (NetCDF 64-bit offset; shells as TRISHELL3, TRISHELL6, SHELL4, SHELL8,
/// SHELL9), whole or not at all: a file with that name is replaced only once the new one is complete.
///
/// Throws Error where the file cannot be written or the mesh not be held by it: ids that are negative, of
/// nodes and elements 0 too, not unique or over 2^31 - 1; a title over 80 characters; a name over 255; lists
/// that do not fit.
void writeMesh(const fem::Mesh& mesh, const std::string& file);

}  // namespace atrapos::exodus

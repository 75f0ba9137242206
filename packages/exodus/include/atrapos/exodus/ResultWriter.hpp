#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/exodus/Error.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// A program that had a hand in the results; each entry at most 32 characters.
struct QaRecord {
  std::string code;
  std::string version;
  std::string date;  ///< as 2024/12/31
  std::string time;  ///< as 23:59:59
};

/// What a result file holds beside the mesh. Names are unique within a list and not empty; those that share
/// a stem and end in _x _y _z (or _xx _yy _zz _xy _yz _zx) should be adjacent for viewers to join them.
struct ResultNames {
  std::vector<std::string> nodal;
  std::vector<std::string> element;
  std::vector<std::string> global;
  std::vector<std::string> info;  ///< lines of any length, see toInfoRecords
  std::vector<QaRecord> qa;       ///< earlier programs; the writer's own record is added after them
};

/// Numbers in a row that someone else owns.
struct ConstSpan {
  const double* data = nullptr;
  std::size_t size = 0;

  ConstSpan() = default;
  ConstSpan(const double* first, std::size_t count) : data(first), size(count) {}
  ConstSpan(const std::vector<double>& values) : data(values.data()), size(values.size()) {}
};

/// Writes results step by step. The file appears, whole with mesh and names, when the writer is
/// made (replacing one with that name), and each writeStep has handed its step to the operating system when
/// it returns: whatever then happens to this process, the step can be read. Keeps no copy of the mesh.
///
/// Every element variable lives on every block.
class ResultWriter {
 public:
  /// Throws Error as writeMesh does, and where names are empty or not unique.
  ResultWriter(const std::string& file, const fem::Mesh& mesh, const ResultNames& names);
  /// Writes the part file partName(file, part.parts, part.part); steps hold the part's own values. A part
  /// without nodes or elements has none of their variables.
  ResultWriter(const std::string& file, const MeshPart& part, const ResultNames& names);
  ~ResultWriter();
  ResultWriter(ResultWriter&&) noexcept;
  ResultWriter& operator=(ResultWriter&&) noexcept;

  /// Appends a step. `nodal` is [variable][node], `element` [variable][element over all blocks],
  /// `global` [variable].
  /// Throws Error where `time` is not finite or not above the last one, a span has not the length that the
  /// names ask for, or writing fails (full disk): the steps before can be read then, and no others written.
  void writeStep(double time, ConstSpan nodal, ConstSpan element, ConstSpan global);

  int numSteps() const;

  /// The file has another name now (of a part: its own).
  void moved(const std::string& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace atrapos::exodus

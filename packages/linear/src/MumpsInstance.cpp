#include "MumpsInstance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "atrapos/linear/BlasThreads.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

bool mpiIsRunning() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started && !ended;
}

const char* meaning(int code) {
  switch (code) {
    case -5:
    case -7:
    case -13:
      return "out of memory";
    case -6:
      return "the matrix is structurally singular";
    case -8:
    case -9:
    case -17:
    case -20:
      return "its work space stayed too small after repeated enlargement";
    case -10:
      return "the matrix is numerically singular";
    case -19:
      return "the memory allowed to it is too small";
    case -38:
      return "the parallel analysis needs an ordering that is not there";
    case -51:
    case -52:
      return "an ordering needs 64-bit integers for a graph of this size";
    default:
      return "see the MUMPS users' guide";
  }
}

}  // namespace

MumpsInstance::MumpsInstance(MPI_Comm comm, int sym) {
  if (!mpiIsRunning()) throw SolverError("MUMPS: MPI is not running (MPI_Init comes first)");
  data_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
  data_.par = 1;
  data_.sym = sym;
  if (run(-1) < 0) fail("initialisation");
  for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;
  icntl(4) = 0;
  icntl(16) = std::max(1, blasThreads());  // of its own OpenMP regions, where it has any
}

MumpsInstance::~MumpsInstance() {
  if (mpiIsRunning()) run(-2);
}

int MumpsInstance::run(int job) {
  data_.job = job;
  dmumps_c(&data_);
  return infog(1);
}

void MumpsInstance::fail(const char* phase) const {
  const int code = infog(1);
  const auto line =
      fmt::format("MUMPS: {} failed: {} (INFOG(1)={}, INFOG(2)={})", phase, meaning(code), code, infog(2));
  if (code == -6 || code == -10) throw SingularTangentError(line, 0);
  throw SolverError(line);
}

}  // namespace atrapos::linear

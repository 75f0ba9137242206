#pragma once

#include <string>

/// The ranks of the program: those of MPI_COMM_WORLD, one where MPI does not run.
namespace atrapos::ranks {

int count();
/// Whether this is the rank that writes files and speaks to the user.
bool isFirst();

// Collective.
bool any(bool here);
int sum(int here);
void wait();  ///< until all are here

/// MPI's part of the runtime: between open and close an error of some ranks can end them all.
void open();
void close();

/// Tells the user what went wrong, once, where it went wrong on all ranks. Where others go on and would wait
/// for this one, ends them all with the exit code; returns otherwise. Not collective.
void fail(const std::string& line, int exitCode);

}  // namespace atrapos::ranks

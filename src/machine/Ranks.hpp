#pragma once

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

/// The ranks of the program: those of MPI_COMM_WORLD, one where MPI does not run or the rank works alone.
namespace atrapos::ranks {

int count();
/// Of all that work together: MPI_COMM_WORLD, or MPI_COMM_SELF where this rank works alone.
MPI_Comm communicator();
int own();  ///< this one, from 0
/// Whether this is the rank that writes files and speaks to the user.
bool isFirst();

// Collective.
bool any(bool here);
int sum(int here);
double sum(double here);
/// What all ranks have, on every rank.
std::vector<std::string> gather(const std::string& here);
void wait();  ///< until all are here

/// What one rank is enough for: f on the first rank, for which there are no others meanwhile. They wait,
/// without taking its processors, for what it returns. Collective; f does not throw.
int onFirst(const std::function<int()>& f);

/// MPI's part of the runtime: between open and close an error of some ranks can end them all.
void open();
void close();

/// Tells the user what went wrong, once, where it went wrong on all ranks. Where others go on and would wait
/// for this one, ends them all with the exit code; returns otherwise. Not collective.
void fail(const std::string& line, int exitCode);

}  // namespace atrapos::ranks

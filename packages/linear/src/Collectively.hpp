#pragma once

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <cctype>
#include <exception>
#include <new>
#include <string>

#include "atrapos/linear/Error.hpp"
#include "atrapos/linear/NoMemory.hpp"

namespace atrapos::linear {

/// Runs a phase of a Trilinos solver; an exception on any rank becomes a SolverError of one line on all,
/// std::bad_alloc itself on all.
template <class Phase>
void collectively(const Teuchos::Comm<int>& comm, const std::string& solver, const char* what,
                  const Phase& phase) {
  std::string message;
  constexpr int error = 1, noMemory = 2;
  int failed = 0, any = 0;
  try {
    phase();
  } catch (const std::exception& e) {
    failed = isNoMemory(e) ? noMemory : error;
    message = e.what();
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &failed, &any);
  if (!any) return;
  if (any == noMemory) throw std::bad_alloc();
  // Teuchos' messages span lines; the last one that says something is the reason.
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.pop_back();
  message = message.substr(message.rfind('\n') + 1);
  throw SolverError(fmt::format("{}: {} failed{}{}", solver, what, failed ? ": " : "", message));
}

}  // namespace atrapos::linear

#pragma once

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <cctype>
#include <exception>
#include <string>

#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

/// Runs a phase of a Trilinos solver; an exception on any rank becomes a SolverError of one line on all.
template <class Phase>
void collectively(const Teuchos::Comm<int>& comm, const std::string& solver, const char* what,
                  const Phase& phase) {
  std::string message;
  int failed = 0, any = 0;
  try {
    phase();
  } catch (const std::exception& e) {
    failed = 1;
    message = e.what();
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &failed, &any);
  if (!any) return;
  // Teuchos' messages span lines; the last one that says something is the reason.
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back()))) message.pop_back();
  message = message.substr(message.rfind('\n') + 1);
  throw SolverError(fmt::format("{}: {} failed{}{}", solver, what, failed ? ": " : "", message));
}

}  // namespace atrapos::linear

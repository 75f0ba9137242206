#include "Interrupt.hpp"

#include <atomic>
#include <csignal>

namespace atrapos {
namespace {

std::atomic<bool> noted{false};
void onSignal(int) { noted = true; }

}  // namespace

Interrupt::Interrupt() {
  noted = false;
  interrupt_ = std::signal(SIGINT, onSignal);
  terminate_ = std::signal(SIGTERM, onSignal);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, interrupt_);
  std::signal(SIGTERM, terminate_);
}

bool Interrupt::came() { return noted; }

}  // namespace atrapos

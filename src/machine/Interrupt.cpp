#include "machine/Interrupt.hpp"

#include <atomic>
#include <csignal>

#include "machine/Ranks.hpp"

namespace atrapos {
namespace {

std::atomic<bool> noted{false};
bool agreed = false;
void onSignal(int) { noted = true; }

}  // namespace

Interrupt::Interrupt() {
  noted = agreed = false;
  interrupt_ = std::signal(SIGINT, onSignal);
  terminate_ = std::signal(SIGTERM, onSignal);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, interrupt_);
  std::signal(SIGTERM, terminate_);
}

void Interrupt::ask() { noted = true; }

bool Interrupt::agree() { return agreed = ranks::any(noted); }

bool Interrupt::came() { return agreed; }

}  // namespace atrapos

#pragma once

namespace atrapos {

/// While one lives, SIGINT and SIGTERM are noted instead of ending the process: a path ends after the step
/// under way, with all results in order.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// As if a signal had come.
  static void ask();
  /// Whether a signal has come on any rank; what came() says from then on, alike on all. Collective.
  static bool agree();
  static bool came();

 private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
};

}  // namespace atrapos

#pragma once

#include <cstddef>

namespace atrapos::bench {

/// Memory in large pages, once for all methods; doubles aligned to a cache line. Throws std::bad_alloc.
class Arena {
 public:
  explicit Arena(std::size_t bytes);
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  std::size_t bytes() const { return bytes_; }
  /// The first `doubles` doubles, zeroed where they have not been handed out before; throws
  /// std::length_error.
  double* get(std::size_t doubles);

 private:
  std::size_t bytes_, touched_ = 0;
  double* data_;
};

/// What one core can do at best, measured.
struct Peaks {
  double gflops = 0;    ///< chains of fused multiply-adds in registers
  double readGBs = 0;   ///< sum over an array that no cache holds
  double triadGBs = 0;  ///< STREAM triad a = b + s c there, 24 bytes an entry
};

/// Doubles of the arena that measurePeaks uses: three arrays of four times the last cache each.
std::size_t peakDoubles();

/// seconds: about how long each of the three is measured.
Peaks measurePeaks(Arena& arena, double seconds);

/// Size of the last cache level; 32 MiB where the system does not say.
std::size_t lastCacheBytes();

/// Memory that can be had without swapping (MemAvailable); 0 where the system does not say.
std::size_t availableBytes();

}  // namespace atrapos::bench

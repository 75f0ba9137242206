#include "Machine.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::bench {

namespace {

using Vector = taylor::Lanes<taylor::nativeLanes>;

/// Seconds that this thread has been running.
double now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Best rate of `work` per second in repetitions over the given time, at least three.
template <class F>
double bestRate(double seconds, double work, const F& f) {
  double best = 0;
  const double end = now() + seconds;
  for (int r = 0; r < 3 || now() < end; ++r) {
    const double start = now();
    f();
    best = std::max(best, work / (now() - start));
  }
  return best;
}

volatile double sink;

double fmaRate(double seconds) {
  // Latency times throughput needs 8 to 10 chains, and 12 with x and y fit into the 16 registers of AVX2.
  constexpr int chains = 12, count = 1000000;
  Vector a[chains];
  for (int i = 0; i < chains; ++i) a[i] = 1.0 + i;
  const Vector x = 0.999, y = 1e-3;
  const double rate = bestRate(seconds, 2.0 * Vector::size * chains * count, [&] {
    Vector b[chains];
    for (int i = 0; i < chains; ++i) b[i] = a[i];
    for (int n = 0; n < count; ++n) {
#pragma GCC unroll 12
      for (int i = 0; i < chains; ++i) b[i] = b[i] * x + y;
    }
    for (int i = 0; i < chains; ++i) a[i] = b[i];
  });
  for (int i = 0; i < chains; ++i) sink = a[i][0];
  return rate * 1e-9;
}

}  // namespace

Arena::Arena(std::size_t bytes) : bytes_(bytes) {
  void* p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (p == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<double*>(p);
#ifdef MADV_HUGEPAGE
  madvise(p, bytes, MADV_HUGEPAGE);  // a hint: small pages work too
#endif
}

Arena::~Arena() { munmap(data_, bytes_); }

double* Arena::get(std::size_t doubles) {
  const std::size_t wanted = doubles * sizeof(double);
  if (wanted > bytes_) throw std::length_error("Arena: more memory asked for than it has");
  if (wanted > touched_) {
    std::memset(reinterpret_cast<char*>(data_) + touched_, 0, wanted - touched_);
    touched_ = wanted;
  }
  return data_;
}

std::size_t peakDoubles() { return 3 * (4 * lastCacheBytes() / 512 * 64); }

Peaks measurePeaks(Arena& arena, double seconds) {
  const std::size_t n = peakDoubles() / 3;
  double *a = arena.get(3 * n), *b = a + n, *c = b + n;
  Peaks peaks;
  peaks.gflops = fmaRate(seconds);
  peaks.triadGBs = 1e-9 * bestRate(seconds, 24.0 * n, [&] {
                     for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3 * c[i];
                   });
  peaks.readGBs = 1e-9 * bestRate(seconds, 24.0 * n, [&] {
                    constexpr int chains = 8;
                    Vector sum[chains] = {};
                    for (std::size_t i = 0; i < 3 * n; i += chains * Vector::size)
#pragma GCC unroll 8
                      for (int j = 0; j < chains; ++j) sum[j] += Vector::load(a + i + j * Vector::size);
                    for (int j = 1; j < chains; ++j) sum[0] += sum[j];
                    sink = sum[0][0];
                  });
  return peaks;
}

std::size_t lastCacheBytes() {
  // sysconf adds up the caches of a socket, also those that no core of this machine uses.
  std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index3/size");
  std::size_t size = 0;
  char unit = 0;
  file >> size >> unit;
  if (size > 0 && unit == 'K') return size << 10;
  if (size > 0 && unit == 'M') return size << 20;
  return std::size_t{32} << 20;
}

std::size_t availableBytes() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  std::size_t value;
  while (file >> key >> value) {
    if (key == "MemAvailable:") return value * 1024;
    std::getline(file, unit);
  }
  return 0;
}

}  // namespace atrapos::bench

// Preloaded into the command by testFaults: makes the n-th call of a kind fail, or kills the process there.
//
//   ATRAPOS_FAULT=KIND:N[:once|on|kill]  the N-th call (from 1) fails; `on`: that one and all behind it;
//   `kill`: SIGKILL ATRAPOS_FAULT_FOLDER=PATH  calls on files below it count, and no others (pipes of MPI,
//   devices) ATRAPOS_FAULT_RANK=R       only rank R of mpirun ATRAPOS_FAULT_COUNTS=FILE  at the end: "KIND
//   COUNT" of every kind ATRAPOS_FAULT_CLOCK=back|jump  the time of day goes back by a minute, or to and fro
//   by a year, at every call,
//                            from the first file opened below the folder
//
// Kinds: open (for writing), write, sync, close (of what was open for writing), rename, remove; new (operator
// new) and malloc (what is no operator new: libraries in C), both from the first file opened below the
// folder.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Kind { opening, writing, syncing, closing, renaming, removing, newing, mallocing, kinds };
constexpr const char* kNames[kinds] = {"open", "write", "sync", "close", "rename", "remove", "new", "malloc"};
constexpr int kErrors[kinds] = {EACCES, ENOSPC, EIO, EIO, EACCES, EACCES, ENOMEM, ENOMEM};

enum class How { once, on, kill };

std::atomic<long> counts[kinds];
std::atomic<bool> filesSeen{false};
bool active = false;
const char* folder = nullptr;
const char* countsFile = nullptr;
const char* clockWay = nullptr;
int faultKind = kinds;
long faultAt = 0;
How how = How::once;

__attribute__((constructor)) void begin() {
  const char* const rank = std::getenv("ATRAPOS_FAULT_RANK");
  const char* const own = std::getenv("OMPI_COMM_WORLD_RANK");
  if (std::strcmp(program_invocation_short_name, "atrapos") != 0) return;  // mpirun, gnuplot
  if (rank && (!own || std::strcmp(rank, own) != 0)) return;
  folder = std::getenv("ATRAPOS_FAULT_FOLDER");
  countsFile = std::getenv("ATRAPOS_FAULT_COUNTS");
  clockWay = std::getenv("ATRAPOS_FAULT_CLOCK");
  if (const char* const fault = std::getenv("ATRAPOS_FAULT"))
    for (int k = 0; k < kinds; ++k) {
      const std::size_t length = std::strlen(kNames[k]);
      if (std::strncmp(fault, kNames[k], length) != 0 || fault[length] != ':') continue;
      char* rest = nullptr;
      faultKind = k;
      faultAt = std::strtol(fault + length + 1, &rest, 10);
      how = std::strcmp(rest, ":kill") == 0 ? How::kill : std::strcmp(rest, ":on") == 0 ? How::on : How::once;
    }
  active = folder != nullptr;
}

__attribute__((destructor)) void end() {
  if (!active || !countsFile) return;
  active = false;
  char text[512];
  int size = 0;
  for (int k = 0; k < kinds; ++k)
    size += std::snprintf(text + size, sizeof text - size, "%s %ld\n", kNames[k], counts[k].load());
  const long file = syscall(SYS_openat, AT_FDCWD, countsFile, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file >= 0) syscall(SYS_write, file, text, size);
}

/// Whether this call is to fail; errno says why then.
bool fails(Kind kind) {
  const long n = ++counts[kind];
  if (kind != faultKind || n < faultAt || (n > faultAt && how != How::on)) return false;
  if (how == How::kill) kill(getpid(), SIGKILL);
  errno = kErrors[kind];
  return true;
}

bool below(const char* path) {
  if (!active || !path) return false;
  char whole[4096];
  if (path[0] != '/') {
    if (!getcwd(whole, sizeof whole)) return false;
    path = whole;
  }
  return std::strncmp(path, folder, std::strlen(folder)) == 0;
}

/// Whether a descriptor is open for writing on a file below the folder.
bool below(int descriptor) {
  if (!active) return false;
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size <= 0) return false;
  path[size] = 0;
  // A pipe's or socket's is no path.
  return path[0] == '/' && below(path) && (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

bool failsToOpen(const char* path, bool toWrite) {
  if (!below(path)) return false;
  filesSeen = true;
  return toWrite && fails(opening);
}

bool failsToAllocate(Kind kind) { return active && filesSeen.load(std::memory_order_relaxed) && fails(kind); }

template <class F>
F* next(F*, const char* name) {
  return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

void* made(std::size_t size, std::size_t alignment) {
  if (failsToAllocate(newing)) return nullptr;
  return alignment ? __libc_memalign(alignment, size) : __libc_malloc(size ? size : 1);
}

void* orThrow(void* memory) {
  if (!memory) throw std::bad_alloc();
  return memory;
}

constexpr long kMinute = 60, kYear = 365 * 24 * 3600L;

/// What is added to the time of day, s.
long shift() {
  static std::atomic<long> calls{0};
  if (!active || !clockWay || !filesSeen) return 0;
  const long n = ++calls;
  return std::strcmp(clockWay, "back") == 0 ? -kMinute * n : (n % 2 ? kYear : -kYear);
}

}  // namespace

#define NEXT(name) static const auto real = next(&::name, #name)

void* operator new(std::size_t size) { return orThrow(made(size, 0)); }
void* operator new[](std::size_t size) { return orThrow(made(size, 0)); }
void* operator new(std::size_t size, std::align_val_t a) { return orThrow(made(size, std::size_t(a))); }
void* operator new[](std::size_t size, std::align_val_t a) { return orThrow(made(size, std::size_t(a))); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return made(size, 0); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return made(size, 0); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

extern "C" {

void* malloc(std::size_t size) noexcept { return failsToAllocate(mallocing) ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) noexcept {
  return failsToAllocate(mallocing) ? nullptr : __libc_calloc(n, size);
}
void* realloc(void* old, std::size_t size) noexcept {
  return size > 0 && failsToAllocate(mallocing) ? nullptr : __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return failsToAllocate(mallocing) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  if (failsToAllocate(mallocing)) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

#define OPEN(name)                                                                                         \
  int name(const char* path, int flags, ...) {                                                             \
    static const auto real = reinterpret_cast<int (*)(const char*, int, mode_t)>(dlsym(RTLD_NEXT, #name)); \
    va_list more;                                                                                          \
    va_start(more, flags);                                                                                 \
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;                                        \
    va_end(more);                                                                                          \
    return failsToOpen(path, (flags & O_ACCMODE) != O_RDONLY) ? -1 : real(path, flags, mode);              \
  }
OPEN(open)
OPEN(open64)

std::FILE* fopen(const char* path, const char* mode) {
  NEXT(fopen);
  return failsToOpen(path, std::strpbrk(mode, "wa+")) ? nullptr : real(path, mode);
}
std::FILE* fopen64(const char* path, const char* mode) {
  NEXT(fopen64);
  return failsToOpen(path, std::strpbrk(mode, "wa+")) ? nullptr : real(path, mode);
}
ssize_t write(int file, const void* bytes, std::size_t size) {
  NEXT(write);
  return below(file) && fails(writing) ? -1 : real(file, bytes, size);
}
ssize_t writev(int file, const iovec* blocks, int n) {
  NEXT(writev);
  return below(file) && fails(writing) ? -1 : real(file, blocks, n);
}
ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t place) {
  NEXT(pwrite);
  return below(file) && fails(writing) ? -1 : real(file, bytes, size, place);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t size, off64_t place) {
  NEXT(pwrite64);
  return below(file) && fails(writing) ? -1 : real(file, bytes, size, place);
}
std::size_t fwrite(const void* bytes, std::size_t size, std::size_t n, std::FILE* file) {
  NEXT(fwrite);
  return below(fileno(file)) && fails(writing) ? 0 : real(bytes, size, n, file);
}
int ftruncate(int file, off_t size) noexcept {
  NEXT(ftruncate);
  return below(file) && fails(writing) ? -1 : real(file, size);
}
int ftruncate64(int file, off64_t size) noexcept {
  NEXT(ftruncate64);
  return below(file) && fails(writing) ? -1 : real(file, size);
}
int fsync(int file) {
  NEXT(fsync);
  // Of what is open for reading too: folders and files that another hand has written.
  const int flags = fcntl(file, F_GETFL);
  return active && flags >= 0 && fails(syncing) ? -1 : real(file);
}
int fdatasync(int file) {
  NEXT(fdatasync);
  return below(file) && fails(syncing) ? -1 : real(file);
}
int close(int file) {
  NEXT(close);
  if (!below(file) || !fails(closing)) return real(file);
  real(file);  // closed all the same, as Linux does
  errno = kErrors[closing];
  return -1;
}
int rename(const char* from, const char* to) noexcept {
  NEXT(rename);
  return below(to) && fails(renaming) ? -1 : real(from, to);
}
int remove(const char* path) noexcept {
  NEXT(remove);
  return below(path) && fails(removing) ? -1 : real(path);
}
int unlink(const char* path) noexcept {
  NEXT(unlink);
  return below(path) && fails(removing) ? -1 : real(path);
}

int clock_gettime(clockid_t clock, timespec* t) noexcept {
  NEXT(clock_gettime);
  const int status = real(clock, t);
  if (clock == CLOCK_REALTIME && status == 0) t->tv_sec += shift();
  return status;
}
std::time_t time(std::time_t* t) noexcept {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (t) *t = now.tv_sec;
  return now.tv_sec;
}
int gettimeofday(timeval* t, void*) noexcept {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  *t = {now.tv_sec, now.tv_nsec / 1000};
  return 0;
}
}

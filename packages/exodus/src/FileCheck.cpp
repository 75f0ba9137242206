#include "FileCheck.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {

namespace {

// Reads the header of a NetCDF classic file (NetCDF user guide, "NetCDF classic file format
// specification"): all numbers are big-endian, lists carry a tag and a length.
class ClassicHeader {
 public:
  ClassicHeader(std::ifstream& stream, const std::string& file, std::uint64_t fileSize)
      : stream_(stream), file_(file), fileSize_(fileSize) {}

  /// Length that the file must have to hold all announced values.
  std::uint64_t requiredSize() {
    std::array<char, 4> magic{};
    stream_.read(magic.data(), 4);
    here_ = 4;
    version_ = static_cast<unsigned char>(magic[3]);
    const std::uint64_t numRecords = count();
    // All bits set: a writer that streams does not know the number of records.
    const bool streaming = numRecords == (version_ == 5 ? ~std::uint64_t{0} : 0xFFFFFFFFu);
    readDimensions();
    readAttributes();
    return readVariables(streaming ? 0 : numRecords);
  }

 private:
  [[noreturn]] void damaged() const {
    throw Error(file_ + ": the file is cut short or damaged (its NetCDF header cannot be read)");
  }

  std::uint64_t number(int bytes) {
    std::array<unsigned char, 8> raw{};
    if (!stream_.read(reinterpret_cast<char*>(raw.data()), bytes)) damaged();
    here_ += static_cast<std::uint64_t>(bytes);
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | raw[i];
    return value;
  }

  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }

  // A number of things that each take at least one byte of the file.
  std::uint64_t boundedCount() {
    const std::uint64_t n = count();
    if (n > fileSize_) damaged();
    return n;
  }

  void skip(std::uint64_t bytes) {
    const std::uint64_t padded = (bytes + 3) / 4 * 4;
    if (padded > fileSize_ || here_ > fileSize_ - padded) damaged();
    here_ += padded;
    // A stream that seeks reads its buffer anew: not for a name.
    if (padded <= 4096)
      stream_.ignore(static_cast<std::streamsize>(padded));
    else
      stream_.seekg(static_cast<std::streamoff>(here_));
  }

  /// NetCDF copies names into rows of 257 characters, however long they are.
  void skipName() {
    constexpr std::uint64_t longest = 256;
    const std::uint64_t n = boundedCount();
    if (n > longest) damaged();
    skip(n);
  }

  std::uint64_t listLength(std::uint64_t expectedTag) {
    const std::uint64_t tag = number(4);
    const std::uint64_t n = boundedCount();
    if (tag != expectedTag && !(tag == 0 && n == 0)) damaged();
    return n;
  }

  std::uint64_t typeSize() {
    static constexpr std::array<std::uint64_t, 12> sizes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const std::uint64_t type = number(4);
    if (type < 1 || type > (version_ == 5 ? 11u : 6u)) damaged();
    return sizes[type];
  }

  // Sizes over 2^60 do not occur in files; products and sums are held there so that nothing overflows.
  static constexpr std::uint64_t limit = std::uint64_t{1} << 60;
  static std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    return b != 0 && a > limit / b ? limit : std::min(limit, a * b);
  }
  static std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
    return std::min(limit, std::min(limit, a) + std::min(limit, b));
  }

  void readDimensions() {
    for (std::uint64_t n = listLength(10); n > 0; --n) {
      skipName();
      dimensions_.push_back(count());
    }
  }

  void readAttributes() {
    for (std::uint64_t n = listLength(12); n > 0; --n) {
      skipName();
      const std::uint64_t size = typeSize();
      skip(product(boundedCount(), size));
    }
  }

  std::uint64_t readVariables(std::uint64_t numRecords) {
    struct RecordVariable {
      std::uint64_t begin, size;
    };
    std::vector<RecordVariable> recordVariables;
    std::uint64_t required = 0;
    for (std::uint64_t n = listLength(11); n > 0; --n) {
      skipName();
      bool record = false;
      std::uint64_t values = 1;
      const std::uint64_t rank = boundedCount();
      for (std::uint64_t d = 0; d < rank; ++d) {
        const std::uint64_t dimension = count();
        if (dimension >= dimensions_.size()) damaged();
        const std::uint64_t length = dimensions_[dimension];
        if (length == 0 && d > 0) damaged();  // only the first dimension of a variable may be unlimited
        if (length == 0)
          record = true;
        else
          values = product(values, length);
      }
      readAttributes();
      const std::uint64_t size = product(values, typeSize());
      count();  // the padded size, which overflows for large variables: computed here instead
      const std::uint64_t begin = number(version_ == 1 ? 4 : 8);
      if (record)
        recordVariables.push_back({begin, size});
      else
        required = std::max(required, sum(begin, size));
    }
    required = std::max(required, here_);
    if (numRecords == 0) return required;
    // A single record variable is packed without padding.
    std::uint64_t stride = 0;
    for (const auto& v : recordVariables)
      stride = sum(stride, recordVariables.size() == 1 ? v.size : (v.size + 3) / 4 * 4);
    for (const auto& v : recordVariables)
      required = std::max(required, sum(sum(v.begin, product(numRecords - 1, stride)), v.size));
    return required;
  }

  std::ifstream& stream_;
  const std::string& file_;
  std::uint64_t fileSize_;
  int version_ = 0;
  std::uint64_t here_ = 0;  ///< bytes read or left out so far
  std::vector<std::uint64_t> dimensions_;
};

struct Sizes {
  Format format = Format::Classic;
  std::uint64_t actual = 0, required = 0;
};

Sizes sizesOf(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw Error(file + ": no such file");
  if (!std::filesystem::is_regular_file(status)) throw Error(file + ": not a regular file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(file + ": the file cannot be opened for reading");
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw Error(file + ": the length of the file cannot be found");
  if (size == 0) throw Error(file + ": the file is empty");

  std::array<char, 8> magic{};
  stream.read(magic.data(), magic.size());
  stream.clear();
  stream.seekg(0);
  static const std::array<char, 8> hdf5 = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  if (magic == hdf5) return {Format::Hdf5, size, 0};
  const bool classic = magic[0] == 'C' && magic[1] == 'D' && magic[2] == 'F';
  if (!classic || (magic[3] != 1 && magic[3] != 2 && magic[3] != 5))
    throw Error(file + ": not an Exodus file (neither NetCDF nor HDF5)");
  return {Format::Classic, size, ClassicHeader(stream, file, size).requiredSize()};
}

}  // namespace

Format checkFile(const std::string& file) {
  const Sizes sizes = sizesOf(file);
  if (sizes.actual < sizes.required)
    throw Error(file + ": the file is cut short: it has " + std::to_string(sizes.actual) +
                " bytes, its header asks for " + std::to_string(sizes.required));
  return sizes.format;
}

void padFile(const std::string& file) {
  const Sizes sizes = sizesOf(file);
  if (sizes.actual >= sizes.required) return;
  std::error_code error;
  std::filesystem::resize_file(file, sizes.required, error);
  if (error) throw Error(file + ": writing failed (" + error.message() + ")");
}

void cutRecords(const std::string& file, std::uint32_t records) {
  {
    // Behind the magic number; big-endian in 32 bits, as in all files that this package makes.
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(4);
    for (int shift = 24; shift >= 0; shift -= 8) stream.put(static_cast<char>(records >> shift));
  }
  const Sizes sizes = sizesOf(file);
  std::error_code ignored;  // on the way out with another error
  if (sizes.actual > sizes.required) std::filesystem::resize_file(file, sizes.required, ignored);
}

}  // namespace atrapos::exodus

#include "machine/PartExchange.hpp"

#include <cstring>
#include <type_traits>
#include <vector>

namespace atrapos {
namespace {

class Writer {
 public:
  explicit Writer(std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void plain(T* first, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(first), count * sizeof(T));
  }
  std::size_t size(std::size_t size) {
    plain(&size, 1);
    return size;
  }

 private:
  std::string& bytes_;
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void plain(T* first, std::size_t count) {
    if (count > 0) std::memcpy(first, bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  std::size_t size(std::size_t /*unknown*/) {
    std::size_t size = 0;
    plain(&size, 1);
    return size;
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

// One list of members for both directions; the writer leaves them as they are.

template <class Archive, class T, std::enable_if_t<std::is_trivially_copyable_v<T>, int> = 0>
void pass(Archive& a, T& x) {
  a.plain(&x, 1);
}

template <class Archive>
void pass(Archive& a, std::string& text) {
  text.resize(a.size(text.size()));
  a.plain(text.data(), text.size());
}

template <class Archive>
void pass(Archive& a, fem::Block& b);
template <class Archive>
void pass(Archive& a, fem::NodeSet& s);
template <class Archive>
void pass(Archive& a, fem::SideSet& s);
template <class Archive>
void pass(Archive& a, exodus::PartBorder& b);

template <class Archive, class T>
void pass(Archive& a, std::vector<T>& list) {
  list.resize(a.size(list.size()));
  if constexpr (std::is_trivially_copyable_v<T>)
    a.plain(list.data(), list.size());
  else
    for (T& item : list) pass(a, item);
}

template <class Archive, class... Items>
void passAll(Archive& a, Items&... items) {
  (pass(a, items), ...);
}

template <class Archive>
void pass(Archive& a, fem::Block& b) {
  passAll(a, b.name, b.id, b.topology, b.nodes, b.attributeNames, b.attributes);
}

template <class Archive>
void pass(Archive& a, fem::NodeSet& s) {
  passAll(a, s.name, s.id, s.nodes, s.factors);
}

template <class Archive>
void pass(Archive& a, fem::SideSet& s) {
  passAll(a, s.name, s.id, s.sides);
}

template <class Archive>
void pass(Archive& a, exodus::PartBorder& b) {
  passAll(a, b.part, b.nodes);
}

template <class Archive>
void passPart(Archive& a, exodus::MeshPart& p) {
  fem::Mesh& m = p.mesh;
  passAll(a, p.part, p.parts, p.borders);
  passAll(a, p.whole.nodes, p.whole.elements, p.whole.blocks, p.whole.nodeSets, p.whole.nodeSetFactors,
          p.whole.sideSets);
  passAll(a, m.title, m.dimension, m.coordinates, m.blocks, m.nodeSets, m.sideSets, m.nodeIds, m.elementIds);
}

}  // namespace

std::string packed(const exodus::MeshPart& part) {
  std::string bytes;
  Writer writer(bytes);
  exodus::MeshPart copy = part;
  passPart(writer, copy);
  return bytes;
}

exodus::MeshPart unpacked(const std::string& bytes) {
  exodus::MeshPart part;
  Reader reader(bytes);
  passPart(reader, part);
  return part;
}

}  // namespace atrapos

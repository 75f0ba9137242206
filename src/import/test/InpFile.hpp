#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "import/Import.hpp"

namespace atrapos::importer {

/// model.inp in a folder of its own, which goes with it.
class InpFile {
 public:
  explicit InpFile(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "atrapos-inp-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test");
    folder_ = name;
    beside("model.inp", text);
  }
  ~InpFile() { std::filesystem::remove_all(folder_); }
  InpFile(const InpFile&) = delete;
  InpFile& operator=(const InpFile&) = delete;

  std::string path() const { return (folder_ / "model.inp").string(); }
  void beside(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

 private:
  std::filesystem::path folder_;
};

inline Model readText(const std::string& text, Deck deck = Deck::no) {
  const InpFile file(text);
  return readInp(file.path(), deck);
}

/// One line, which begins with the file's name and has these words.
inline void expectRefused(const std::string& text, Deck deck, const std::string& words) {
  const InpFile file(text);
  try {
    readInp(file.path(), deck);
    ADD_FAILURE() << "not refused, expected: " << words;
  } catch (const Error& e) {
    const std::string line = e.what();
    EXPECT_EQ(line.rfind(file.path(), 0), 0u) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_NE(line.find(words), std::string::npos) << line << "\nexpected: " << words;
  }
}

template <class Items>
std::vector<std::string> namesOf(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

}  // namespace atrapos::importer
